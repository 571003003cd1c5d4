// SPDX-License-Identifier: GPL-3.0-or-later
// Charts of notebook columns as SVG, by Observable Plot. Every row is a point; a line connects the means of
// rows with equal x. Colours are attributes: saved runs need no style sheet.

import { axisX, axisY, dot, gridY, line, plot, ruleX, ruleY, text, type Markish } from '@observablehq/plot';
import { linesOf, namesAlong, type ChartChoice, type Line, type Mean, type Point } from './chart_choice';
import { svg } from './dom';
import type { Ink } from './colour';
import type { Notebook } from './run';
import { axisFor, axisOfNames, type Axis } from './ticks';
import { greatestOf, label, numberText, scaleFor, shareOf, type Scale } from './units';

export const fontSize = 15; // px
const lineHeight = 24; // px
const symbols = ['circle', 'square', 'triangle', 'diamond'] as const;
const dashes = ['9 6', '12 5 3 5', '3 5', '6 4 12 4']; // px
const mostNamed = 16;

/** A notebook's rows at knob values tried before. The chart draws them faint. */
export interface Tried {
  notebook: Notebook;
  values: string; // of the knobs
}

export interface Drawn {
  element: SVGElement;
  summary: string;
  /** Rows without a number for the axis. */
  left: number;
}

export function drawChart(
  notebook: Notebook,
  asked: ChartChoice,
  width: number,
  height: number,
  ink: Ink,
  before: Tried[] = [],
): Drawn {
  const names = namesAlong(notebook, asked);
  const named = names.length > 0;
  const choice = named ? { ...asked, log_x: false } : asked;
  const { lines: given, left } = linesOf(notebook, choice);
  const earlier = before.flatMap((b) => triedLines(b, choice, names));
  const all = given.flatMap((l) => l.points);
  const name = `${choice.y.join(', ')} against ${choice.x}`;
  if (all.length === 0) {
    const why = left ? 'No row has both numbers above zero, as these axes need' : 'No row has both numbers yet';
    return { element: sentence(`${why}.`, `${name}: ${why}`, width, height, ink), summary: why, left };
  }
  const every = [...given, ...earlier].flatMap((l) => l.points);
  const scaleX = scaleFor(notebook.units[choice.x], greatestOf(every.map((p) => p.x)));
  const scaleY = scaleFor(notebook.units[choice.y[0]], greatestOf(every.map((p) => p.y)));
  const lines = given.map((l) => inUnits(l, scaleX.factor, scaleY.factor));
  const faint = earlier.map((l) => ({ ...l, ...inUnits(l, scaleX.factor, scaleY.factor) }));
  const legend = legendRows(lines.length > 1 ? lines : [], width - 90);
  const aside = names.every((name) => widthOf(name) + 12 <= (width - 130) / names.length);
  const turned = named && !aside;
  const tall = turned ? Math.min(height / 3, Math.max(...names.map((n) => widthOf(shortened(n))))) : 0;
  const margin = { left: 0, right: 24, top: 14 + legend.length * lineHeight, bottom: 56 + Math.max(0, tall - fontSize) };
  const upright = height - margin.top - margin.bottom;
  const bars = lines.map((l) => (choice.spread ? l.means.map((m) => barOf(m, choice.log_y)) : []));
  const shown = [...lines, ...faint].flatMap((l) => l.points);
  const up = [...shown.map((p) => p.y), ...bars.flat().flatMap((bar) => [bar.y1, bar.y2])];
  const y = axisFor(up, choice.log_y, apartBy(() => 1.6 * fontSize, upright));
  margin.left = Math.max(58, 46 + Math.max(...y.labels.map(widthOf)));
  const inside = width - margin.left - margin.right;
  const apart = apartBy((text) => (turned ? 1.2 * fontSize : widthOf(text) + 16), inside);
  const written = turned ? names.map((n) => shortened(n, tall)) : names;
  const x = named
    ? axisOfNames(written, turned ? apart : () => true)
    : axisFor(shown.map((p) => p.x), choice.log_x, apart);

  const place = (p: Point): Point => ({
    x: inside * shareOf(p.x, x.domain, x.log),
    y: upright * shareOf(p.y, y.domain, y.log),
  });
  const places = lines.map((l) => l.points.map(place));
  const kinds = lines.map((l, k): Marks =>
    choice.points === false && !named ? 'none' : marksFor(places[k], !named && l.means.length === l.points.length),
  );
  const over = liesOver(lines.map((l) => l.means.map(place)));
  const drawn = lines.flatMap((l, k): Markish[] => {
    const stroke = ink.series[k % ink.series.length];
    const kind = kinds[k] === 'large' && kinds.some((m) => m !== 'large') ? 'small' : kinds[k];
    const strokeDasharray = over[k] ? dashes[k % dashes.length] : 'none';
    const title = (p: Point): string => pointText(l, p, choice, scaleX, scaleY, names);
    return [
      ruleX(bars[k].filter((bar) => bar.y2 > bar.y1), { x: 'x', y1: 'y1', y2: 'y2', stroke, strokeWidth: 1.5 }),
      ...(named ? [] : [line(l.means, { x: 'x', y: 'y', stroke, strokeWidth: 2, strokeDasharray })]),
      ...dotsOf(l.points, places[k], kind, k, over[k], ink, title),
    ];
  });
  const words = { fontSize, fill: ink.text };
  const long = height - Math.abs(margin.bottom - margin.top) - 8;
  const xWords = fittedLabel(choice.x_label || choice.x, scaleX, inside);
  const yWords = fittedLabel(choice.y_label || choice.y.join(', '), scaleY, long);
  const element = plotted({ width, height, margin, x: { ...x, turned }, y, ink }, [], [
    text([xWords], { ...words, frameAnchor: 'bottom', dy: margin.bottom - 8 }),
    text([yWords], { ...words, frameAnchor: 'left', textAnchor: 'middle', rotate: -90, dx: 16 - margin.left }),
    ...faint.flatMap((l) => faintMarks(l, ink.series[indexOf(lines, l) % ink.series.length], named)),
    ...drawn,
    ...legendMarks(legend, margin.top, ink),
  ]);
  const summary =
    `${label(choice.y.join(', '), scaleY)} against ${label(choice.x, scaleX)}: ${count(all.length, 'point')}` +
    (lines.length > 1 ? `, ${count(lines.length, 'line')}${choice.per ? `, one per ${choice.per}` : ''}` : '') +
    (x.ticks.length < names.length ? `, ${x.ticks.length} of ${names.length} names written` : '') +
    (kinds.includes('none') && choice.points !== false ? ', too close together to be marked one by one' : '');
  return { element: asPicture(element, summary, ink), summary, left };
}

type Faint = Line & { values: string };

/** Lines of another run with the same names along x. */
function triedLines({ notebook, values }: Tried, choice: ChartChoice, names: string[]): Faint[] {
  if (namesAlong(notebook, choice).join('\n') !== names.join('\n')) return [];
  return linesOf(notebook, choice).lines.map((l) => ({ ...l, values }));
}

function indexOf(lines: Line[], { name }: Line): number {
  return Math.max(0, lines.findIndex((l) => l.name === name));
}

const mostDots = 12; // of a faint line

function faintMarks({ means, values }: Faint, stroke: string, named: boolean): Markish[] {
  const look = { x: 'x', y: 'y', title: () => values };
  return [
    ...(named ? [] : [line(means, { ...look, stroke, strokeWidth: 1.5, strokeOpacity: 0.35 })]),
    dot(means.length > mostDots ? [] : means, { ...look, r: 3, fill: stroke, fillOpacity: 0.45, stroke: 'none' }),
  ];
}

function inUnits(l: Line, x: number, y: number): Line {
  const scaled = (p: Point): Point => ({ x: p.x / x, y: p.y / y });
  const means = l.means.map((m) => ({ ...scaled(m), deviation: m.deviation / y }));
  return { ...l, points: l.points.map(scaled), means };
}

interface Frame {
  width: number;
  height: number;
  margin: { left: number; right: number; top: number; bottom: number };
  x: Axis & { turned?: boolean }; // labels turned
  y: Axis;
  ink: Ink;
}

/** Axes and grid, with marks behind and in front of the lower axis. */
export function plotted({ width, height, margin, x, y, ink }: Frame, behind: Markish[], front: Markish[]): SVGSVGElement {
  const words = { fontSize, fill: ink.muted, label: null };
  return plot({
    className: 'columns',
    width,
    height,
    marginLeft: margin.left,
    marginRight: margin.right,
    marginTop: margin.top,
    marginBottom: margin.bottom,
    x: { type: x.log ? 'log' : 'linear', domain: x.domain },
    y: { type: y.log ? 'log' : 'linear', domain: y.domain },
    marks: [
      gridY(y.ticks, { stroke: ink.grid, strokeOpacity: 1 }),
      axisY(y.ticks, { ...words, tickSize: 0, tickPadding: 8, text: labelOf(y) }),
      ...behind,
      axisX(x.ticks, { ...words, stroke: ink.muted, text: labelOf(x), ...(x.turned ? { tickRotate: -90 } : {}) }),
      ruleY([y.domain[0]], { stroke: ink.muted }),
      ...front,
    ],
  }) as SVGSVGElement;
}

function dotsOf(
  points: Point[],
  places: Point[],
  kind: Marks,
  index: number,
  over: boolean,
  ink: Ink,
  title: (p: Point) => string,
): Markish[] {
  if (kind === 'none') return [];
  const close = crowded(places, 2 * radii[kind]);
  const r = radii[kind] * (over ? 0.65 : 1);
  const fill = ink.series[index % ink.series.length];
  const look = { x: 'x', y: 'y', r, symbol: symbols[index % symbols.length], fill, title };
  const fillOpacity = share(close) > 0.5 ? 0.5 : 1; // the line must remain visible in a dense cloud
  const outlined = (k: number): boolean => kind === 'large' && !close[k] && !over;
  return [
    dot(points.filter((_, k) => outlined(k)), { ...look, fillOpacity, stroke: ink.paper }),
    dot(points.filter((_, k) => !outlined(k)), { ...look, fillOpacity, stroke: 'none' }),
  ];
}

function sentence(words: string, name: string, width: number, height: number, ink: Ink): SVGElement {
  const root = svg('svg', { viewBox: `0 0 ${width} ${height}`, width, height });
  root.append(
    svg('text', { x: width / 2, y: height / 2, 'text-anchor': 'middle', 'font-size': fontSize, fill: ink.muted }, words),
  );
  return asPicture(root, name, ink);
}

/** Removes Plot's style sheet, which the content policy forbids, and merges aria attributes into one
    name. */
export function asPicture(root: SVGElement, name: string, ink: Ink): SVGElement {
  root.querySelector('style')?.remove();
  for (const part of root.querySelectorAll('[aria-label], [aria-hidden], [aria-description]')) {
    if (part.getAttribute('aria-label')) part.setAttribute('class', part.getAttribute('aria-label')!.replace(/\W+/g, '-'));
    for (const attribute of ['aria-label', 'aria-hidden', 'aria-description']) part.removeAttribute(attribute);
  }
  root.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
  root.setAttribute('role', 'img');
  root.setAttribute('aria-label', name);
  root.setAttribute('font-family', 'system-ui, sans-serif');
  root.setAttribute('font-size', String(fontSize));
  root.setAttribute('fill', ink.text);
  return root;
}

/** One standard deviation up and down. */
function barOf({ x, y, deviation }: Mean, log: boolean): { x: number; y1: number; y2: number } {
  return { x, y1: log && y <= deviation ? y : y - deviation, y2: y + deviation };
}

export function apartBy(size: (text: string) => number, length: number) {
  return (labels: string[], shares: number[]): boolean =>
    labels.every((text, k) => k === 0 || length * (shares[k] - shares[k - 1]) >= (size(text) + size(labels[k - 1])) / 2);
}

/** At most 220 px; the point's title has the whole name. */
function shortened(name: string, room = 220): string {
  if (widthOf(name) <= room) return name;
  let text = [...name];
  while (text.length > 1 && widthOf(`${text.join('').trimEnd()}…`) > room) text = text.slice(0, -1);
  return `${text.join('').trimEnd()}…`;
}

/** The whole unit, and words as they fit. */
function fittedLabel(words: string, scale: Scale, room: number): string {
  const unit = label('', scale);
  return shortened(words, room - widthOf(unit)) + unit;
}

const ruler = document.createElement('canvas').getContext('2d');

export function widthOf(text: string): number {
  if (!ruler) return 8.6 * text.length;
  ruler.font = `${fontSize}px system-ui, sans-serif`;
  return ruler.measureText(text).width;
}

function labelOf(axis: Axis): (tick: number) => string {
  return (tick) => axis.labels[axis.ticks.indexOf(tick)];
}

function pointText(l: Line, p: Point, choice: ChartChoice, x: Scale, y: Scale, names: string[]): string {
  const number = (value: number, { unit }: Scale): string => numberText(value) + (unit && ` ${unit}`);
  const part = choice.per ? `${l.name}\n` : '';
  return `${part}${choice.x} = ${names[p.x] ?? number(p.x, x)}\n${l.column} = ${number(p.y, y)}`;
}

interface Entry {
  text: string;
  at: number;
  index: number;
}

function legendRows(lines: Line[], width: number): Entry[][] {
  const rows: Entry[][] = [];
  let at = Infinity;
  const add = (text: string, index: number): void => {
    const room = 36 + widthOf(text);
    if (at + room > width) {
      rows.push([]);
      at = 0;
    }
    rows[rows.length - 1].push({ text, at, index });
    at += room;
  };
  lines.slice(0, mostNamed).forEach((l, k) => add(l.name, k));
  if (lines.length > mostNamed) add(`and ${lines.length - mostNamed} more`, mostNamed);
  return rows;
}

function legendMarks(rows: Entry[][], top: number, ink: Ink): Markish[] {
  return rows.flatMap((entries, row) =>
    entries.flatMap(({ text: words, at, index }) => {
      const place = { frameAnchor: 'top-left' as const, dx: at + 6, dy: 14 + row * lineHeight - top };
      const look = { symbol: symbols[index % symbols.length], fill: ink.series[index % ink.series.length] };
      const beside = { textAnchor: 'start' as const, lineAnchor: 'middle' as const, fontSize, fill: ink.text };
      return [
        dot([0], { ...place, ...look, r: 5, stroke: 'none' }),
        text([words], { ...place, ...beside, dx: at + 18 }),
      ];
    }),
  );
}

export function count(n: number, what: string): string {
  return `${n} ${what}${n === 1 ? '' : 's'}`;
}

/** Single points have a paper-coloured outline; crowded points have none, because outlines would hide
    neighbours and the line. Many crowded points are smaller, or omitted if the line passes through all. */
type Marks = 'large' | 'small' | 'none';

const radii = { large: 4, small: 2, none: 0 };

/** `onLine`: the line passes through all points. */
function marksFor(places: Point[], onLine: boolean): Marks {
  if (share(crowded(places, 2 * radii.large)) <= 0.2) return 'large';
  return onLine && places.length > 100 && share(crowded(places, 2 * radii.small)) > 0.5 ? 'none' : 'small';
}

/** Whether another place is nearer than `size`; identical places count as one. */
function crowded(places: Point[], size: number): boolean[] {
  const tenths = places.map((p) => ({ x: Math.round(10 * p.x), y: Math.round(10 * p.y), close: false }));
  const known = new Map(tenths.map((p) => [`${p.x} ${p.y}`, p]));
  const sorted = [...known.values()].sort((p, q) => p.x - q.x);
  sorted.forEach((p, k) => {
    for (let j = k + 1; j < sorted.length && sorted[j].x - p.x < 10 * size; ++j) {
      const q = sorted[j];
      if (!(p.close && q.close) && Math.hypot(p.x - q.x, p.y - q.y) < 10 * size) p.close = q.close = true;
    }
  });
  return tenths.map((p) => known.get(`${p.x} ${p.y}`)!.close);
}

/** Lines with two or more points of earlier lines; these are dashed and have small marks, to hide nothing. */
function liesOver(lines: Point[][]): boolean[] {
  const taken = new Set<string>();
  return lines.map((places) => {
    const names = places.map((p) => `${Math.round(p.x)} ${Math.round(p.y)}`);
    const alike = names.filter((n) => taken.has(n)).length;
    names.forEach((n) => taken.add(n));
    return alike > 1;
  });
}

function share(of: boolean[]): number {
  return of.filter(Boolean).length / of.length;
}
