// SPDX-License-Identifier: GPL-3.0-or-later
// The charts of a run: the script's own, from check or run; otherwise the first varying columns of a
// notebook. Lines: for each y column and each value of a grouping column.

import type { Cell, Charted, ChartEvent } from './api';
import { columnsAlong, namesIn, numericColumns, type Notebook, type Run } from './run';
import { extentOf, grouped, numberText, sameToRounding, scaleFor } from './units';

/** The script's chart, or one chosen by hand. */
export type ChartChoice = Pick<Charted, 'x' | 'y' | 'per' | 'log_x' | 'log_y'> & Partial<Charted>;

export interface Point {
  x: number;
  y: number;
}

export interface Mean extends Point {
  deviation: number; // of the sample
}

export interface Line {
  name: string;
  column: string;
  points: Point[];
  means: Mean[];
}

/** In row order; empty for a numeric column. */
export function namesAlong(notebook: Notebook, choice: ChartChoice): string[] {
  if (numericColumns(notebook).includes(choice.x)) return [];
  return namesIn({ ...notebook, rows: rowsOf(notebook, choice) }, choice.x);
}

function rowsOf(notebook: Notebook, choice: ChartChoice): Notebook['rows'] {
  const wanted = Object.entries(choice.where ?? {});
  return notebook.rows.filter((row) => wanted.every(([column, values]) => values.includes(row[column])));
}

/** The lines, and the number of rows without a point. For names, x is the index of the name, from 0. */
export function linesOf(notebook: Notebook, choice: ChartChoice): { lines: Line[]; left: number } {
  const names = namesAlong(notebook, choice);
  const along = (given: Cell | undefined): Cell | undefined =>
    names.length === 0 ? given : typeof given === 'string' && names.includes(given) ? names.indexOf(given) : null;
  let left = 0;
  const all: { name: string; column: string; point: Point }[] = [];
  for (const row of rowsOf(notebook, choice)) {
    const x = along(row[choice.x]);
    const before = all.length;
    for (const column of choice.y) {
      const y = row[column];
      if (!shown(x, choice.log_x && names.length === 0) || !shown(y, choice.log_y)) continue;
      all.push({ name: nameOf(row, column, choice, notebook), column, point: { x, y } });
    }
    if (all.length === before) ++left;
  }
  const order = ({ column }: Line): number => choice.y.indexOf(column);
  const lines = [...grouped(all, (p) => p.name)]
    .map(([name, group]) => ({ name, column: group[0].column, points: group.map((p) => p.point) }))
    .map((line) => ({ ...line, means: meansOf(line.points) }));
  return { lines: lines.sort((a, b) => order(a) - order(b)), left };
}

function shown(value: Cell | undefined, log: boolean): value is number {
  return typeof value === 'number' && Number.isFinite(value) && !(log && value <= 0);
}

function nameOf(row: Record<string, Cell>, column: string, choice: ChartChoice, notebook: Notebook): string {
  if (!choice.per) return column;
  const unit = notebook.units[choice.per];
  const value = row[choice.per];
  const text =
    typeof value === 'number' ? numberText(value) : value === undefined || value === null ? '(none)' : String(value);
  const part = typeof value === 'string' ? text : `${choice.per} = ${text}${unit ? ' ' + unit : ''}`;
  return choice.y.length > 1 ? `${column}, ${part}` : part;
}

function meansOf(points: Point[]): Mean[] {
  const groups = grouped(points, (p) => p.x);
  return [...groups]
    .map(([x, alike]) => {
      const y = alike.reduce((sum, p) => sum + p.y, 0) / alike.length;
      const squares = alike.reduce((sum, p) => sum + (p.y - y) ** 2, 0);
      return { x, y, deviation: alike.length > 1 ? Math.sqrt(squares / (alike.length - 1)) : 0 };
    })
    .sort((a, b) => a.x - b.x);
}

export interface RunChart {
  name: string; // the same in every run
  title: string;
  notebook: Notebook;
  choice: ChartChoice;
  asked: boolean; // by the script
}

const foretold = new Map<string, ChartEvent[]>(); // from checks, by script
const mostKnown = 20; // scripts

export function foretell(script: string, charts: ChartEvent[]): void {
  foretold.delete(script);
  foretold.set(script, charts);
  if (foretold.size > mostKnown) foretold.delete(foretold.keys().next().value!);
}

/** The script's own first. */
export function chartsOf(run: Run): RunChart[] {
  const found: RunChart[] = [];
  const over = run.status === 'done' && run.charted.size > 0;
  for (const event of [...(over ? [] : (foretold.get(run.script) ?? [])), ...run.charted.values()]) {
    const notebook = run.notebooks.get('study' in event ? event.study : event.notebook);
    const charted = 'study' in event ? { ...ofStudy, title: `${event.study}: error against time` } : event.chart;
    const choice = notebook && fitted(charted, notebook);
    if (!choice) continue;
    const title = charted.title || `${choice.y.join(', ')} against ${choice.x}`;
    const name = `${notebook.name}: ${title}`;
    if (!found.some((c) => c.name === name)) found.push({ name, title, notebook, choice, asked: true });
  }
  for (const notebook of run.notebooks.values()) {
    if (numericColumns(notebook).length === 0 || columnsAlong(notebook).length < 2) continue;
    if (found.some((c) => c.notebook === notebook)) continue;
    found.push({ name: notebook.name, title: notebook.name, notebook, choice: firstChoice(run, notebook), asked: false });
  }
  return found;
}

const ofStudy: ChartChoice = { x: 'seconds', y: ['error'], per: 'way', log_x: true, log_y: true };

/** Columns of the same unit. */
export function columnsLike(notebook: Notebook, column: string): string[] {
  const dimension = (c: string): string => scaleFor(notebook.units[c], 0).unit;
  return numericColumns(notebook).filter((c) => dimension(c) === dimension(column));
}

function firstChoice(run: Run, notebook: Notebook): ChartChoice {
  const columns = numericColumns(notebook);
  // A script usually names its inputs before its results.
  const written = (c: string): number =>
    run.script.search(new RegExp(`(?<!\\w)${c.replace(/\W/g, '\\$&')}(?!\\w)`)) + 1 || run.script.length + 1;
  const varied = columns.filter((c) => varies(notebook, c)).sort((a, b) => written(a) - written(b));
  const per = partedBy(notebook);
  if (columns.length < 2) {
    const x = columnsAlong(notebook).find((c) => c !== columns[0])!;
    return { x, y: [columns[0]], per: per === x ? '' : per, log_x: false, log_y: false };
  }
  const x = varied[0] ?? columns[0];
  const y = varied[1] ?? columns.find((c) => c !== x)!;
  return { x, y: [y], per, log_x: false, log_y: false };
}

/** The first column of texts with two to eight values; else empty. */
function partedBy(notebook: Notebook): string {
  const numeric = numericColumns(notebook);
  const few = (c: string): boolean => {
    const values = new Set(notebook.rows.map((r) => r[c]).filter((v) => v !== undefined && v !== null));
    return values.size > 1 && values.size <= 8;
  };
  return notebook.columns.find((c) => !numeric.includes(c) && few(c)) ?? '';
}

/** With the notebook's columns only; undefined without both axes. */
export function fitted(choice: ChartChoice, notebook: Notebook): ChartChoice | undefined {
  const columns = numericColumns(notebook);
  const known = choice.y.filter((c) => columns.includes(c));
  if (known.length === 0 || !columnsAlong(notebook).includes(choice.x)) return undefined;
  const alike = columnsLike(notebook, known[0]);
  const per = notebook.columns.includes(choice.per) ? choice.per : '';
  return { ...choice, y: known.filter((c) => alike.includes(c)), per };
}

/** Beyond rounding; a single row shows nothing. */
function varies(notebook: Notebook, column: string): boolean {
  if (notebook.rows.length < 2) return true;
  const [low, high] = extentOf(notebook.rows.map((row) => row[column]));
  return high > low && !sameToRounding(low, high);
}
