// SPDX-License-Identifier: GPL-3.0-or-later
// Notebook rows. A column has one unit and prefix; a cell's title has the exact value. Long notebooks show
// their last rows.

import { Choice, h, table } from './dom';
import { numericColumns, type Notebook, type Run } from './run';
import { greatestOf, label, numberText, scaleFor, type Scale } from './units';
import type { Cell } from './api';

const shownRows = 500;
const longName = 24; // characters; then wrapped
const longText = 60;

function cellText(value: Cell | undefined, scale: Scale | undefined): string {
  if (value === undefined || value === null) return '';
  if (typeof value === 'number') return numberText(value / (scale?.factor ?? 1), 5);
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  return value;
}

export function tableOf(notebook: Notebook, most = Infinity): HTMLTableElement {
  const greatest = (c: string): number => greatestOf(notebook.rows.map((row) => row[c]));
  const scales = new Map(numericColumns(notebook).map((c) => [c, scaleFor(notebook.units[c], greatest(c))]));
  const count = notebook.rows.length;
  const from = Math.max(0, count - most);
  const words = from ? `the last ${most} of ${count} rows` : `${count} ${count === 1 ? 'row' : 'rows'}`;
  const classes = (column: string, long: boolean): string => (scales.has(column) ? 'number' : '') + (long ? ' long' : '');
  const head = notebook.columns.map((c) => {
    const className = classes(c, c.length > longName);
    return h('th', { scope: 'col', className }, label(c, scales.get(c) ?? { factor: 1, unit: '' }));
  });
  const rows = notebook.rows.slice(from).map((row, k) => {
    const cells = notebook.columns.map((c) => {
      const className = classes(c, String(row[c] ?? '').length > longText);
      const title = typeof row[c] === 'number' ? String(row[c]) : undefined;
      return h('td', { className, title }, cellText(row[c], scales.get(c)));
    });
    return [h('td.index', from + k + 1), ...cells];
  });
  const caption = h('caption', `${notebook.name}: ${words}`);
  return table([h('th.index', { scope: 'col' }, '#'), ...head], rows, caption);
}

/** As in the run's file: comma-separated, SI, units in brackets. */
export function csvOf(notebook: Notebook): string {
  const quoted = (text: string): string => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
  const head = notebook.columns.map((c) => quoted(notebook.units[c] ? `${c} [${notebook.units[c]}]` : c)).join(',');
  const rows = notebook.rows.map((row) =>
    notebook.columns.map((c) => quoted(row[c] === undefined || row[c] === null ? '' : String(row[c]))).join(','),
  );
  return [head, ...rows, ''].join('\n');
}

export class TablePane {
  private chosen = '';
  private run: Run | undefined;
  private drawn: { notebook: Notebook | undefined; rows: number; of: string } = { notebook: undefined, rows: -1, of: '' };
  private readonly which = new Choice('Notebook', (name) => {
    this.chosen = name;
    this.show(this.run);
  });
  private readonly empty = h('p.empty');
  private readonly table = h('div.scroll.table',
    { tabIndex: 0, role: 'region', 'aria-label': 'Rows of the notebook' },
  );

  constructor(readonly element: HTMLElement) {
    this.which.element.hidden = true;
    element.append(this.empty, this.which.element, this.table);
  }

  show(run: Run | undefined): void {
    this.run = run;
    const names = [...(run?.notebooks.keys() ?? [])];
    this.empty.hidden = names.length > 0;
    this.empty.textContent = run?.active
      ? 'No row yet.'
      : 'Rows that a script writes into a notebook appear here, as they come.';
    this.table.hidden = names.length === 0;
    this.which.element.hidden = names.length < 2;
    if (names.length === 0) return;
    if (!names.includes(this.chosen)) this.chosen = names[0];
    this.which.choose(names, this.chosen);
    const notebook = run!.notebooks.get(this.chosen)!;
    if (this.drawn.notebook === notebook && this.drawn.rows === notebook.rows.length) return;
    if (this.element.offsetParent === null) return;
    const of = `${notebook.name}\n${run!.script}`;
    const whole = !run!.active && of !== this.drawn.of;
    const atEnd = this.table.scrollHeight - this.table.scrollTop - this.table.clientHeight < 40;
    this.drawn = { notebook, rows: notebook.rows.length, of };
    this.table.replaceChildren(tableOf(notebook, shownRows));
    if (whole) this.table.scrollTop = 0;
    else if (atEnd) this.table.scrollTop = this.table.scrollHeight;
  }
}
