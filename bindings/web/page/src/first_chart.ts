// SPDX-License-Identifier: GPL-3.0-or-later
// The charts of a run: the script's own, from its text or its file names; otherwise the first varying columns
// of a notebook.

import type { ChartChoice } from './chart_choice';
import type { Charted } from './charted';
import { columnsAlong, numericColumns, type Notebook, type Run } from './run';
import { sameToRounding, scaleFor } from './units';

export interface RunChart {
  name: string; // stable from run to run
  title: string;
  notebook: Notebook;
  choice: ChartChoice;
  asked: boolean; // by the script
}

/** The script's own first. */
export function chartsOf(run: Run): RunChart[] {
  const found: RunChart[] = [];
  const drawable = [...run.notebooks.values()].filter(
    (n) => numericColumns(n).length >= 1 && columnsAlong(n).length >= 2,
  );
  for (const charted of run.charted) {
    for (const notebook of drawable) {
      const choice = asCharted(charted, notebook);
      if (!choice) continue;
      const title = charted.title || `${choice.y.join(', ')} against ${choice.x}`;
      if (found.some((c) => c.name === `${notebook.name}: ${title}`)) break;
      found.push({ name: `${notebook.name}: ${title}`, title, notebook, choice, asked: true });
      break;
    }
  }
  for (const notebook of drawable) {
    const known = found.filter((c) => c.notebook === notebook).map((c) => c.choice);
    const drawn = byFiles(run, notebook).filter((f) => !known.some((k) => k.x === f.x && k.y.includes(f.y)));
    const per = known.length > 0 ? known[0].per : partedBy(notebook);
    drawn.forEach(({ x, y }, k) => {
      const first = k === 0 && known.length === 0;
      const title = first ? notebook.name : `${y} against ${x}`;
      const name = first ? notebook.name : `${notebook.name}: ${title}`;
      const choice = { x, y: [y], per: per === x ? '' : per, logX: false, logY: false };
      found.push({ name, title, notebook, choice, asked: true });
    });
    if (known.length + drawn.length > 0) continue;
    found.push({ name: notebook.name, title: notebook.name, notebook, choice: firstChoice(run, notebook), asked: false });
  }
  return found;
}

/** Columns of the same unit. */
export function columnsLike(notebook: Notebook, column: string): string[] {
  const dimension = (c: string): string => scaleFor(notebook.units[c], 0).unit;
  return numericColumns(notebook).filter((c) => dimension(c) === dimension(column));
}

function firstChoice(run: Run, notebook: Notebook): ChartChoice {
  const columns = numericColumns(notebook);
  const written = (c: string): number => {
    const at = run.keys.indexOf(c);
    return at < 0 ? run.keys.length : at;
  };
  const varied = columns.filter((c) => varies(notebook, c)).sort((a, b) => written(a) - written(b));
  const per = partedBy(notebook);
  if (columns.length < 2) {
    const x = columnsAlong(notebook).find((c) => c !== columns[0])!;
    return { x, y: [columns[0]], per: per === x ? '' : per, logX: false, logY: false };
  }
  const x = varied[0] ?? columns[0];
  const y = varied[1] ?? columns.find((c) => c !== x)!;
  return { x, y: [y], per, logX: false, logY: false };
}

/** The first column of texts with two to eight values; else empty. */
function partedBy(notebook: Notebook): string {
  const columns = numericColumns(notebook);
  const parts = notebook.columns.find((c) => {
    const values = columns.includes(c) ? 0 : distinct(notebook, c);
    return values > 1 && values <= 8;
  });
  return parts ?? '';
}

function asCharted(charted: Charted, notebook: Notebook): ChartChoice | undefined {
  const columns = numericColumns(notebook);
  if (charted.notebook && charted.notebook !== notebook.name) return undefined;
  if (!columnsAlong(notebook).includes(charted.x)) return undefined;
  const known = charted.y.filter((c) => columns.includes(c));
  if (known.length === 0) return undefined;
  const alike = columnsLike(notebook, known[0]);
  const per = notebook.columns.includes(charted.per) ? charted.per : '';
  const { x, logX, logY, xLabel, yLabel, where, points, spread } = charted;
  return { x, y: known.filter((c) => alike.includes(c)), per, logX, logY, xLabel, yLabel, where, points, spread };
}

/** Unnamed charts: <notebook>-<y>-<x>.svg, further y columns in between. */
function byFiles(run: Run, notebook: Notebook): { x: string; y: string }[] {
  const columns = numericColumns(notebook);
  const along = columnsAlong(notebook);
  const found: { x: string; y: string }[] = [];
  for (const file of run.files.keys()) {
    for (const y of columns) {
      const begin = `${fileName(`${notebook.name}-${y}`)}-`;
      if (!file.startsWith(begin)) continue;
      const x = along.find((c) => c !== y && `-${file.slice(begin.length)}`.endsWith(`-${fileName(c)}.svg`));
      if (x === undefined) continue;
      found.push({ x, y });
      break;
    }
  }
  return found;
}

/** As in the engine. */
function fileName(text: string): string {
  return text.replace(/[^\w.\u0080-\uffff]+/g, '-').replace(/^[.-]+|-+$/g, '');
}

/** Beyond rounding. */
function varies(notebook: Notebook, column: string): boolean {
  let low = Infinity;
  let high = -Infinity;
  for (const row of notebook.rows) {
    const value = row[column];
    if (typeof value !== 'number' || !Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return high > low && !sameToRounding(low, high);
}

function distinct(notebook: Notebook, column: string): number {
  return new Set(notebook.rows.map((r) => r[column]).filter((v) => v !== undefined && v !== null)).size;
}
