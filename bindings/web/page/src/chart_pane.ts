// SPDX-License-Identifier: GPL-3.0-or-later
// The script's own charts, and charts of any columns of one unit. A choice stays with the chart's name from
// run to run. The drawing library is loaded with the first chart.

import type { Tried } from './chart';
import { chartsOf, columnsLike, fitted, type ChartChoice, type RunChart } from './chart_choice';
import { inkNow, lightInk } from './colour';
import { Choice, h, saveAs } from './dom';
import { valuesText } from './knobs';
import { columnsAlong, numericColumns, type Run } from './run';

type Drawing = typeof import('./chart');

const most = 40; // runs

/** Runs of a script at the knob values tried before. */
class Trail {
  private runs: Run[] = [];

  /** Another script starts another trail. */
  add(run: Run): void {
    if (run.status !== 'done' || run === this.runs.at(-1)) return;
    if (run.script !== this.runs[0]?.script) this.runs = [];
    this.runs = [...this.runs, run].slice(-most);
  }

  clear(): void {
    this.runs = [];
  }

  /** Runs of this script at other values, with this notebook; the last of equal values. */
  before(run: Run, notebook: string): Tried[] {
    const known = new Map<string, Tried>();
    for (const one of this.runs) {
      const found = one.notebooks.get(notebook);
      const values = valuesText(one.knobs);
      if (one.script === run.script && values && found) known.set(values, { notebook: found, values });
    }
    known.delete(valuesText(run.knobs));
    return [...known.values()];
  }
}

const several = '\n'; // y: all columns

export class ChartPane {
  private run: Run | undefined;
  private asked = ''; // by hand
  private drawing: Drawing | undefined;
  private readonly choices = new Map<string, ChartChoice>();
  private readonly which = new Choice('Chart', (name) => {
    this.asked = name;
    this.draw();
  });
  private readonly x = new Choice('x', (x) => this.set({ x }));
  private readonly y = new Choice('y', (y) => y !== several && this.set({ y: [y] }));
  private readonly more = new Choice('and', (y) => y && this.set({ y: [...this.shown()!.choice.y, y] }));
  private readonly per = new Choice('One line per', (per) => this.set({ per }));
  private readonly logX = h('input', { type: 'checkbox', onchange: () => this.set({ log_x: this.logX.checked }) });
  private readonly logY = h('input', { type: 'checkbox', onchange: () => this.set({ log_y: this.logY.checked }) });
  private readonly empty = h('p.empty');
  private readonly frame = h('div.chart');
  private readonly note = h('p.caption');
  private readonly trail = new Trail();
  private readonly forget = h('button', { hidden: true, onclick: () => this.clear() }, 'Clear trail');
  private readonly body: HTMLElement;

  constructor(
    readonly element: HTMLElement,
    private readonly failed: (error: unknown) => void,
  ) {
    const save = h('button', { onclick: () => this.save() }, 'Save SVG');
    this.body = h('div.charts',
      this.which.element,
      this.frame,
      h('div.below',
        this.note,
        this.forget,
        h('details.view',
          h('summary', 'View'),
          h('div.choices',
            this.x.element,
            this.y.element,
            this.more.element,
            this.per.element,
            h('span.pair', h('label', this.logX, ' log x'), h('label', this.logY, ' log y')),
            save,
          ),
        ),
      ),
    );
    element.append(this.empty, this.body);
    new ResizeObserver(() => this.draw()).observe(this.frame);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.draw());
  }

  show(run: Run | undefined): void {
    this.run = run;
    const any = this.charts().length > 0;
    this.empty.hidden = any;
    this.body.hidden = !any;
    this.empty.textContent = run?.active ? 'No row yet.' : 'Columns of a notebook are drawn here against each other.';
    if (any) this.draw();
  }

  /** Stays in the chart, faint, while other values of the knobs are tried. */
  tried(run: Run): void {
    this.trail.add(run);
  }

  private clear(): void {
    this.trail.clear();
    if (this.run) this.trail.add(this.run);
    this.draw();
    this.element.querySelector('summary')!.focus();
  }

  async library(): Promise<Drawing> {
    return (this.drawing ??= await import('./chart'));
  }

  chartsFor(run: Run): RunChart[] {
    return chartsOf(run).map((chart) => {
      const known = this.choices.get(chart.name);
      return { ...chart, choice: (known && fitted(known, chart.notebook)) ?? chart.choice };
    });
  }

  private charts(): RunChart[] {
    return this.run ? this.chartsFor(this.run) : [];
  }

  private shown(): RunChart | undefined {
    const charts = this.charts();
    return charts.find((c) => c.name === this.asked) ?? charts[0];
  }

  private set(change: Partial<ChartChoice>): void {
    const present = this.shown();
    const words = { ...(change.x && { x_label: '' }), ...(change.y && { y_label: '' }) };
    if (present) this.choices.set(present.name, { ...present.choice, ...words, ...change });
    this.draw();
  }

  private draw(): void {
    const shown = this.shown();
    if (!shown || this.element.offsetParent === null) return;
    const { notebook, choice } = shown;
    const charts = this.charts();
    const columns = numericColumns(notebook);
    this.which.element.hidden = charts.length < 2;
    this.which.choose(charts.map((c) => ({ value: c.name, text: c.title })), shown.name);
    this.x.choose(columnsAlong(notebook), choice.x);
    const together = choice.y.length > 1 ? [{ value: several, text: choice.y.join(', ') }] : [];
    this.y.choose([...together, ...columns], choice.y.length > 1 ? several : choice.y[0]);
    const other = (c: string): boolean => c !== choice.x && !choice.y.includes(c);
    const more = columnsLike(notebook, choice.y[0]).filter(other);
    this.more.element.hidden = more.length === 0;
    this.more.choose([{ value: '', text: '(no other)' }, ...more], '');
    this.per.choose([{ value: '', text: '(one line)' }, ...notebook.columns.filter(other)], choice.per);
    this.logX.disabled = !columns.includes(choice.x); // not for names
    this.logX.checked = choice.log_x && !this.logX.disabled;
    this.logY.checked = choice.log_y;
    if (!this.drawing) {
      this.library().then(() => this.draw(), this.failed);
      return;
    }
    const [width, height] = [Math.max(280, this.frame.clientWidth), Math.max(220, this.frame.clientHeight)];
    const before = this.trail.before(this.run!, notebook.name);
    this.forget.hidden = before.length === 0;
    const { element, summary, left } = this.drawing.drawChart(notebook, choice, width, height, inkNow(), before);
    this.frame.replaceChildren(element);
    const why = choice.log_x || choice.log_y ? ', or none above zero for a logarithmic axis' : ' in both columns';
    const rows = left ? ` ${left} ${left === 1 ? 'row is' : 'rows are'} left out: no number${why}.` : '';
    this.note.textContent = `${summary}.${rows}${triedText(before)}`;
  }

  private save(): void {
    const shown = this.shown();
    if (!shown || !this.drawing) return;
    const { notebook, choice } = shown;
    const before = this.trail.before(this.run!, notebook.name);
    const { element } = this.drawing.drawChart(notebook, choice, 900, 560, lightInk, before);
    const name = `${notebook.name} ${choice.y.join(' ')} against ${choice.x}.svg`.replace(/[^\w .-]/g, '_');
    saveAs(name, new Blob([new XMLSerializer().serializeToString(element)], { type: 'image/svg+xml' }));
  }
}

function triedText(before: Tried[]): string {
  const last = before.at(-1)?.values;
  return last ? ` Faint: ${before.length > 1 ? `${before.length} values tried before, the last ${last}` : last}.` : '';
}
