// SPDX-License-Identifier: GPL-3.0-or-later
// One column of a notebook against another, as SVG: the same drawing on the page and in a saved run.
// Every row is a point; a line goes through the means of the rows that share an x, as the notebook's
// own charts do. Colours are attributes, so the drawing needs no style sheet. It draws no error bars.

import { scaleLinear, scaleLog } from 'd3-scale';
import { svg } from './dom';
import { drawMarks, markAt, marksFor, type Place } from './marks';
import type { Notebook } from './run';
import { label, numberText, raised, sameToRounding, scaleFor, type Scale } from './units';

export interface ChartChoice {
  x: string;
  y: string;
  per: string; // a line for each value of this column; empty for one line
  logX: boolean;
  logY: boolean;
}

export interface Ink {
  text: string;
  muted: string;
  grid: string;
  paper: string;
  series: string[];
}

// Okabe and Ito's colours for every kind of colour vision, darkened or lightened to stand out from paper.
export const lightInk: Ink = {
  text: '#1c2126',
  muted: '#4d5963',
  grid: '#dfe3e6',
  paper: '#ffffff',
  series: ['#0b5fa5', '#b04a00', '#00765a', '#9a4480', '#6b5b00', '#3a3f47', '#3d86b8', '#c2611f'],
};
export const darkInk: Ink = {
  text: '#e6eaed',
  muted: '#aeb9c2',
  grid: '#343c44',
  paper: '#14181c',
  series: ['#6fb7ee', '#f0964b', '#4fc9a4', '#e194c4', '#e0cd4e', '#c6ccd2', '#9fd3f2', '#ffbf8f'],
};

interface Point {
  x: number;
  y: number;
}

interface Line {
  name: string;
  points: Point[];
  means: Point[];
}

export interface Drawn {
  element: SVGElement;
  summary: string;
  /** Rows that a logarithmic axis or a missing number leaves out. */
  left: number;
}

export function drawChart(notebook: Notebook, choice: ChartChoice, width: number, height: number, ink: Ink): Drawn {
  const { lines, left } = linesOf(notebook, choice);
  const all = lines.flatMap((l) => l.points);
  const name = `${choice.y} against ${choice.x}`;
  const root = svg('svg', {
    xmlns: 'http://www.w3.org/2000/svg',
    viewBox: `0 0 ${width} ${height}`,
    width,
    height,
    role: 'img',
    'font-family': 'system-ui, sans-serif',
    'font-size': 15,
    fill: ink.text,
  });
  if (all.length === 0) {
    const why = left ? 'No row has both numbers above zero, as these axes need.' : 'No row has both numbers yet.';
    root.append(svg('text', { x: width / 2, y: height / 2, 'text-anchor': 'middle', fill: ink.muted }, why));
    root.setAttribute('aria-label', `${name}: ${why}`);
    return { element: root, summary: why, left };
  }
  const scaleX = scaleFor(notebook.units[choice.x], greatest(all.map((p) => p.x)));
  const scaleY = scaleFor(notebook.units[choice.y], greatest(all.map((p) => p.y)));
  const legend = lines.length > 1 ? lines : [];
  const legendRows = legendLayout(legend, choice.per, notebook, width - 90);
  const top = 14 + legendRows.length * 24;
  const y = axis(
    all.map((p) => p.y / scaleY.factor),
    choice.logY,
    [height - 56, top],
    Math.max(3, Math.floor((height - top) / 60)),
  );
  const widest = Math.max(...y.ticks.map((t) => tickText(t, y).length));
  const margin = { left: Math.max(58, 42 + 8.4 * widest), right: 20, top, bottom: 56 };
  const x = axis(
    all.map((p) => p.x / scaleX.factor),
    choice.logX,
    [margin.left, width - margin.right],
    Math.max(3, Math.floor(width / 110)),
  );

  for (const tick of y.ticks) {
    const at = y.place(tick);
    root.append(
      svg('line', { x1: margin.left, x2: width - margin.right, y1: at, y2: at, stroke: ink.grid }),
      svg('text', { x: margin.left - 8, y: at + 5, 'text-anchor': 'end', fill: ink.muted }, tickText(tick, y)),
    );
  }
  for (const tick of x.ticks) {
    const at = x.place(tick);
    root.append(
      svg('line', { x1: at, x2: at, y1: height - margin.bottom, y2: height - margin.bottom + 5, stroke: ink.muted }),
      svg(
        'text',
        { x: at, y: height - margin.bottom + 22, 'text-anchor': 'middle', fill: ink.muted },
        tickText(tick, x),
      ),
    );
  }
  root.append(
    svg('line', {
      x1: margin.left,
      x2: width - margin.right,
      y1: height - margin.bottom,
      y2: height - margin.bottom,
      stroke: ink.muted,
    }),
    svg(
      'text',
      { x: (margin.left + width - margin.right) / 2, y: height - 8, 'text-anchor': 'middle' },
      label(choice.x, scaleX),
    ),
    svg(
      'text',
      { transform: `translate(18 ${(top + height - margin.bottom) / 2}) rotate(-90)`, 'text-anchor': 'middle' },
      label(choice.y, scaleY),
    ),
  );
  const placed = (p: Point): Place => ({ x: x.place(p.x / scaleX.factor), y: y.place(p.y / scaleY.factor) });
  const places = lines.map((line) => line.points.map(placed));
  const marks = lines.map((line, k) => marksFor(places[k], line.means.length === line.points.length));
  lines.forEach((line, index) => {
    const colour = ink.series[index % ink.series.length];
    const path = line.means
      .map(placed)
      .map((p, i) => `${i ? 'L' : 'M'}${p.x.toFixed(1)} ${p.y.toFixed(1)}`)
      .join('');
    root.append(svg('path', { d: path, fill: 'none', stroke: colour, 'stroke-width': 2, 'stroke-linejoin': 'round' }));
    // Points of one chart have one size.
    const kind = marks[index] === 'large' && marks.some((m) => m !== 'large') ? 'small' : marks[index];
    const words = (k: number): string => pointText(line, line.points[k], choice, scaleX, scaleY);
    for (const mark of drawMarks(places[index], kind, index, { colour, paper: ink.paper }, words)) root.append(mark);
  });
  for (const [row, entries] of legendRows.entries()) {
    for (const entry of entries) {
      const place = { x: margin.left + entry.at + 6, y: 14 + row * 24 };
      const mark = markAt(entry.index, place, 5, ink.series[entry.index % ink.series.length]);
      root.append(mark, svg('text', { x: margin.left + entry.at + 18, y: 19 + row * 24 }, entry.text));
    }
  }
  const summary =
    `${label(choice.y, scaleY)} against ${label(choice.x, scaleX)}: ${count(all.length, 'point')}` +
    (lines.length > 1 ? `, ${count(lines.length, 'line')}, one per ${choice.per}` : '') +
    (marks.includes('none') ? ', too close together to be marked one by one' : '');
  root.setAttribute('aria-label', summary);
  return { element: root, summary, left };
}

function linesOf(notebook: Notebook, choice: ChartChoice): { lines: Line[]; left: number } {
  const groups = new Map<string, Point[]>();
  let left = 0;
  for (const row of notebook.rows) {
    const x = row[choice.x];
    const y = row[choice.y];
    const fits =
      typeof x === 'number' &&
      typeof y === 'number' &&
      Number.isFinite(x) &&
      Number.isFinite(y) &&
      !(choice.logX && x <= 0) &&
      !(choice.logY && y <= 0);
    if (!fits) {
      ++left;
      continue;
    }
    const key = choice.per ? keyText(row[choice.per]) : '';
    const points = groups.get(key);
    if (points) points.push({ x, y });
    else groups.set(key, [{ x, y }]);
  }
  const lines = [...groups].map(([name, points]) => ({ name, points, means: meansOf(points) }));
  return { lines, left };
}

function meansOf(points: Point[]): Point[] {
  const sums = new Map<number, { sum: number; count: number }>();
  for (const p of points) {
    const at = sums.get(p.x) ?? { sum: 0, count: 0 };
    sums.set(p.x, { sum: at.sum + p.y, count: at.count + 1 });
  }
  return [...sums].map(([x, s]) => ({ x, y: s.sum / s.count })).sort((a, b) => a.x - b.x);
}

function keyText(value: unknown): string {
  return typeof value === 'number'
    ? numberText(value)
    : value === undefined || value === null
      ? '(none)'
      : String(value);
}

interface Axis {
  place: (value: number) => number;
  ticks: number[];
  log: boolean;
}

function axis(values: number[], log: boolean, range: [number, number], wanted: number): Axis {
  let low = values.reduce((least, v) => Math.min(least, v), Infinity);
  let high = values.reduce((most, v) => Math.max(most, v), -Infinity);
  if (sameToRounding(low, high)) {
    const half = log ? 0 : Math.abs(low) / 10 || 1;
    [low, high] = log ? [low / 2, high * 2] : [low - half, high + half];
  }
  if (!log) {
    const scale = scaleLinear().domain([low, high]).nice(wanted).range(range);
    return { place: scale, ticks: scale.ticks(wanted), log };
  }
  const scale = scaleLog().domain([low, high]).range(range);
  const decades = Math.log10(high / low);
  if (decades < 1) {
    const linear = scaleLinear().domain([low, high]).nice(wanted);
    const [from, to] = linear.domain();
    scale.domain([from > 0 ? from : low, to]);
    return { place: scale, ticks: linear.ticks(wanted).filter((t) => t > 0), log };
  }
  scale.nice();
  const [from, to] = scale.domain();
  const every = Math.ceil(Math.log10(to / from) / wanted);
  const factors = decades <= 2 ? [1, 2, 5] : [1];
  const ticks: number[] = [];
  for (let power = Math.floor(Math.log10(from)); 10 ** power <= to * 1.001; power += every) {
    for (const factor of factors) {
      const tick = factor * 10 ** power;
      if (tick >= from * 0.999 && tick <= to * 1.001) ticks.push(tick);
    }
  }
  return { place: scale, ticks, log };
}

function tickText(tick: number, on: Axis): string {
  const power = Math.log10(Math.abs(tick));
  if (on.log && (power < -3.5 || power > 4.5) && Math.abs(power - Math.round(power)) < 1e-9)
    return `10${raised(Math.round(power))}`;
  return numberText(tick, 6);
}

function pointText(line: Line, p: Point, choice: ChartChoice, x: Scale, y: Scale): string {
  const per = choice.per ? `${choice.per} = ${line.name}\n` : '';
  const number = (value: number, scale: Scale): string =>
    numberText(value / scale.factor) + (scale.unit && ' ' + scale.unit);
  return `${per}${choice.x} = ${number(p.x, x)}\n${choice.y} = ${number(p.y, y)}`;
}

/** Entries of the legend in rows that fit the width; the first says what parts the lines. */
function legendLayout(
  lines: Line[],
  per: string,
  notebook: Notebook,
  width: number,
): { text: string; at: number; index: number }[][] {
  const rows: { text: string; at: number; index: number }[][] = [];
  const unit = notebook.units[per];
  let at = Infinity;
  lines.slice(0, 16).forEach((line, index) => {
    const text = `${per} = ${line.name}${unit ? ' ' + unit : ''}`;
    const room = 36 + 8.2 * text.length;
    if (at + room > width) {
      rows.push([]);
      at = 0;
    }
    rows[rows.length - 1].push({ text, at, index });
    at += room;
  });
  if (lines.length > 16) rows[rows.length - 1].push({ text: `and ${lines.length - 16} more`, at, index: 16 });
  return rows;
}

function greatest(values: number[]): number {
  return values.reduce((most, v) => Math.max(most, Math.abs(v)), 0);
}

function count(n: number, what: string): string {
  return `${n} ${what}${n === 1 ? '' : 's'}`;
}
