// SPDX-License-Identifier: GPL-3.0-or-later
// The choice of a chart, and its lines: for each y column and each value of a grouping column.

import type { Cell } from './api';
import { namesIn, numericColumns, type Notebook } from './run';
import { numberText } from './units';

export interface ChartChoice {
  x: string; // numbers or names
  y: string[]; // of one unit
  per: string; // grouping column, or empty
  logX: boolean;
  logY: boolean;
  xLabel?: string; // instead of the column names
  yLabel?: string;
  where?: Record<string, Cell[]>; // only rows with these values
  points?: boolean; // false: lines only
  spread?: boolean; // bars: standard deviation of rows with equal x
}

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
  const groups = new Map<string, { column: string; points: Point[] }>();
  let left = 0;
  const names = namesAlong(notebook, choice);
  for (const row of rowsOf(notebook, choice)) {
    const given = row[choice.x];
    const place = typeof given === 'string' ? names.indexOf(given) : -1;
    const x = names.length === 0 ? given : place < 0 ? null : place;
    let drawn = false;
    for (const column of choice.y) {
      const y = row[column];
      if (!shown(x, choice.logX && names.length === 0) || !shown(y, choice.logY)) continue;
      drawn = true;
      const key = nameOf(row, column, choice, notebook);
      const group = groups.get(key);
      if (group) group.points.push({ x, y });
      else groups.set(key, { column, points: [{ x, y }] });
    }
    if (!drawn) ++left;
  }
  const order = (column: string): number => choice.y.indexOf(column);
  const lines = [...groups]
    .map(([name, { column, points }]) => ({ name, column, points, means: meansOf(points) }))
    .sort((a, b) => order(a.column) - order(b.column));
  return { lines, left };
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
  const groups = new Map<number, number[]>();
  for (const p of points) {
    const group = groups.get(p.x);
    if (group) group.push(p.y);
    else groups.set(p.x, [p.y]);
  }
  return [...groups]
    .map(([x, ys]) => {
      const y = ys.reduce((sum, v) => sum + v, 0) / ys.length;
      const squares = ys.reduce((sum, v) => sum + (v - y) ** 2, 0);
      return { x, y, deviation: ys.length > 1 ? Math.sqrt(squares / (ys.length - 1)) : 0 };
    })
    .sort((a, b) => a.x - b.x);
}
