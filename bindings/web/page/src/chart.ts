// SPDX-License-Identifier: GPL-3.0-or-later
// Charts of notebook columns as SVG, drawn by Observable Plot. Every row is a point; a line connects the
// means of rows with equal x, as in the engine's charts. Colours are attributes: saved runs need no style
// sheet.

import { axisX, axisY, dot, gridY, line, plot, rectY, ruleX, ruleY, text, type Markish } from '@observablehq/plot';
import { linesOf, namesAlong, type ChartChoice, type Line, type Point } from './chart_choice';
import { svg } from './dom';
import type { Ink } from './ink';
import { crowded, marksFor, radii, share, type Marks, type Place } from './marks';
import type { Notebook } from './run';
import { axisFor, axisOfNames, type Axis } from './ticks';
import { label, numberText, scaleFor, type Scale } from './units';

const fontSize = 15; // px
const lineHeight = 24; // px
const symbols = ['circle', 'square', 'triangle', 'diamond'] as const;
const mostNamed = 16;

export interface Drawn {
  element: SVGElement;
  summary: string;
  /** Rows without a number for the axis. */
  left: number;
}

export function drawChart(notebook: Notebook, asked: ChartChoice, width: number, height: number, ink: Ink): Drawn {
  const names = namesAlong(notebook, asked);
  const named = names.length > 0;
  const choice = named ? { ...asked, logX: false } : asked;
  const { lines, left } = linesOf(notebook, choice);
  const all = lines.flatMap((l) => l.points);
  const name = `${choice.y.join(', ')} against ${choice.x}`;
  if (all.length === 0) {
    const why = left ? 'No row has both numbers above zero, as these axes need' : 'No row has both numbers yet';
    return { element: sentence(`${why}.`, `${name}: ${why}`, width, height, ink), summary: why, left };
  }
  const scaleX = scaleFor(notebook.units[choice.x], greatest(all.map((p) => p.x)));
  const scaleY = scaleFor(notebook.units[choice.y[0]], greatest(all.map((p) => p.y)));
  const legend = legendRows(lines.length > 1 ? lines : [], width - 90);
  const turned = named && !fitAside(names, width - 130);
  const tall = turned ? Math.min(height / 3, Math.max(...names.map((n) => widthOf(shortened(n))))) : 0;
  const margin = { left: 0, right: 24, top: 14 + legend.length * lineHeight, bottom: 56 + Math.max(0, tall - fontSize) };
  const ends = choice.spread ? lines.flatMap((l) => l.means.flatMap((m) => barOf(m, choice.logY))) : [];
  const y = axisFor(
    [...all.map((p) => p.y), ...ends].map((v) => v / scaleY.factor),
    choice.logY,
    apartBy(() => 1.6 * fontSize, height - margin.top - margin.bottom),
  );
  margin.left = Math.max(58, 46 + Math.max(...y.labels.map(widthOf)));
  const inside = width - margin.left - margin.right;
  const x = named
    ? axisOfNames(
        names.map((n) => (turned ? shortened(n, tall) : n)),
        turned ? apartBy(() => 1.2 * fontSize, inside) : () => true,
      )
    : axisFor(
        all.map((p) => p.x / scaleX.factor),
        choice.logX,
        apartBy((text) => widthOf(text) + 16, inside),
      );

  const scaled = (p: Point): Point => ({ x: p.x / scaleX.factor, y: p.y / scaleY.factor });
  const place = (p: Point): Place => ({
    x: inside * shareOf(p.x / scaleX.factor, x, choice.logX),
    y: (height - margin.top - margin.bottom) * shareOf(p.y / scaleY.factor, y, choice.logY),
  });
  const places = lines.map((l) => l.points.map(place));
  const kinds = lines.map((l, k): Marks =>
    choice.points === false && !named ? 'none' : marksFor(places[k], !named && l.means.length === l.points.length),
  );
  const drawn = lines.flatMap((l, k): Markish[] => {
    const stroke = ink.series[k % ink.series.length];
    const kind = kinds[k] === 'large' && kinds.some((m) => m !== 'large') ? 'small' : kinds[k];
    const bars = l.means.filter((m) => choice.spread && m.deviation > 0);
    return [
      ruleX(bars, {
        x: (m) => m.x / scaleX.factor,
        y1: (m) => barOf(m, choice.logY)[0] / scaleY.factor,
        y2: (m) => barOf(m, choice.logY)[1] / scaleY.factor,
        stroke,
        strokeWidth: 1.5,
      }),
      ...(named ? [] : [line(l.means.map(scaled), { x: 'x', y: 'y', stroke, strokeWidth: 2 })]),
      ...dotsOf(l, places[k], kind, k, ink, scaled, (p) => pointText(l, p, choice, scaleX, scaleY, names)),
    ];
  });
  const words = { fontSize, fill: ink.text };
  const element = plot({
    className: 'columns',
    width,
    height,
    marginLeft: margin.left,
    marginRight: margin.right,
    marginTop: margin.top,
    marginBottom: margin.bottom,
    x: { type: choice.logX ? 'log' : 'linear', domain: x.domain },
    y: { type: choice.logY ? 'log' : 'linear', domain: y.domain },
    marks: [
      gridY(y.ticks, { stroke: ink.grid, strokeOpacity: 1 }),
      axisY(y.ticks, { ...words, fill: ink.muted, tickSize: 0, tickPadding: 8, text: labelOf(y), label: null }),
      axisX(x.ticks, {
        ...words,
        fill: ink.muted,
        stroke: ink.muted,
        text: labelOf(x),
        label: null,
        ...(turned ? { tickRotate: -90 } : {}),
      }),
      ruleY([y.domain[0]], { stroke: ink.muted }),
      text([fittedLabel(choice.xLabel || choice.x, scaleX, inside)], {
        ...words,
        frameAnchor: 'bottom',
        dy: margin.bottom - 8,
      }),
      text([fittedLabel(choice.yLabel || choice.y.join(', '), scaleY, height - Math.abs(margin.bottom - margin.top) - 8)], {
        ...words,
        frameAnchor: 'left',
        textAnchor: 'middle',
        rotate: -90,
        dx: 16 - margin.left,
      }),
      ...drawn,
      ...legendMarks(legend, margin.top, ink),
    ],
  }) as SVGSVGElement;
  const summary =
    `${yLabel(choice, scaleY)} against ${label(choice.x, scaleX)}: ${count(all.length, 'point')}` +
    (lines.length > 1 ? `, ${count(lines.length, 'line')}${choice.per ? `, one per ${choice.per}` : ''}` : '') +
    (x.ticks.length < names.length ? `, ${x.ticks.length} of ${names.length} names written` : '') +
    (kinds.includes('none') && choice.points !== false ? ', too close together to be marked one by one' : '');
  return { element: asPicture(element, summary, ink), summary, left };
}

export function drawHistogram(values: number[], name: string, width: number, height: number, ink: Ink): Drawn {
  const axis = axisFor(
    values,
    false,
    apartBy((text) => widthOf(text) + 16, width - 70),
  );
  const [low, high] = axis.domain;
  const steps = Math.max(4, Math.min(12, Math.ceil(2 * Math.sqrt(values.length))));
  const bins = Array.from({ length: steps }, (_, k) => ({
    from: low + ((high - low) * k) / steps,
    to: low + ((high - low) * (k + 1)) / steps,
    count: 0,
  }));
  for (const v of values) ++bins[Math.min(steps - 1, Math.floor(((v - low) / (high - low)) * steps))].count;
  const most = Math.max(...bins.map((b) => b.count));
  const counts = axisFor([0, most], false, apartBy(() => 1.6 * fontSize, height - 70));
  const words = { fontSize, fill: ink.text };
  const element = plot({
    className: 'columns',
    width,
    height,
    marginLeft: 44,
    marginRight: 24,
    marginTop: 10,
    marginBottom: 52,
    x: { domain: axis.domain },
    y: { domain: counts.domain },
    marks: [
      gridY(counts.ticks, { stroke: ink.grid, strokeOpacity: 1 }),
      axisY(counts.ticks, { ...words, fill: ink.muted, tickSize: 0, tickPadding: 8, text: labelOf(counts), label: null }),
      rectY(
        bins.filter((b) => b.count > 0),
        { x1: 'from', x2: 'to', y: 'count', fill: ink.series[0], inset: 1 },
      ),
      axisX(axis.ticks, { ...words, fill: ink.muted, stroke: ink.muted, text: labelOf(axis), label: null }),
      ruleY([0], { stroke: ink.muted }),
      text([name], { ...words, frameAnchor: 'bottom', dy: 46 }),
    ],
  }) as SVGSVGElement;
  const sorted = [...values].sort((a, b) => a - b);
  const summary =
    `${name}: ${count(values.length, 'prediction')}, from ${numberText(sorted[0])} to ${numberText(sorted[sorted.length - 1])}, ` +
    `half of them up to ${numberText(sorted[Math.floor((sorted.length - 1) / 2)])}`;
  return { element: asPicture(element, summary, ink), summary, left: 0 };
}

function dotsOf(
  l: Line,
  places: Place[],
  kind: Marks,
  index: number,
  ink: Ink,
  scaled: (p: Point) => Point,
  words: (p: Point) => string,
): Markish[] {
  if (kind === 'none') return [];
  const close = crowded(places, 2 * radii[kind]);
  const fill = ink.series[index % ink.series.length];
  // The line must remain visible in a dense cloud.
  const cloud = share(close) > 0.5;
  const single = kind === 'large' ? l.points.filter((_, k) => !close[k]) : [];
  const rest = kind === 'large' ? l.points.filter((_, k) => close[k]) : l.points;
  return [single, rest].map((points, outlined) =>
    dot(points, {
      x: (p: Point) => scaled(p).x,
      y: (p: Point) => scaled(p).y,
      r: radii[kind],
      symbol: symbols[index % symbols.length],
      fill,
      fillOpacity: cloud ? 0.5 : 1,
      stroke: outlined === 0 ? ink.paper : 'none',
      title: words,
    }),
  );
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
function asPicture(root: SVGElement, name: string, ink: Ink): SVGElement {
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

function barOf(mean: { y: number; deviation: number }, log: boolean): [number, number] {
  const low = mean.y - mean.deviation;
  return [log && low <= 0 ? mean.y : low, mean.y + mean.deviation];
}

function shareOf(value: number, axis: Axis, log: boolean): number {
  const [low, high] = axis.domain;
  return log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
}

function apartBy(size: (text: string) => number, length: number) {
  return (labels: string[], shares: number[]): boolean =>
    labels.every((text, k) => k === 0 || length * (shares[k] - shares[k - 1]) >= (size(text) + size(labels[k - 1])) / 2);
}

/** Whether the names fit side by side. */
function fitAside(names: string[], length: number): boolean {
  return names.every((name) => widthOf(name) + 12 <= length / names.length);
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

function widthOf(text: string): number {
  if (!ruler) return 8.6 * text.length;
  ruler.font = `${fontSize}px system-ui, sans-serif`;
  return ruler.measureText(text).width;
}

function labelOf(axis: Axis): (tick: number) => string {
  return (tick) => axis.labels[axis.ticks.indexOf(tick)];
}

function yLabel(choice: ChartChoice, scale: Scale): string {
  return label(choice.y.join(', '), scale);
}

function pointText(l: Line, p: Point, choice: ChartChoice, x: Scale, y: Scale, names: string[]): string {
  const number = (value: number, scale: Scale): string =>
    numberText(value / scale.factor) + (scale.unit && ' ' + scale.unit);
  const part = choice.per ? `${l.name}\n` : '';
  const along = names[p.x] ?? number(p.x, x);
  return `${part}${choice.x} = ${along}\n${l.column} = ${number(p.y, y)}`;
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
      return [
        dot([0], {
          ...place,
          r: 5,
          symbol: symbols[index % symbols.length],
          fill: ink.series[index % ink.series.length],
          stroke: 'none',
        }),
        text([words], { ...place, dx: at + 18, textAnchor: 'start', lineAnchor: 'middle', fontSize, fill: ink.text }),
      ];
    }),
  );
}

function greatest(values: number[]): number {
  return values.reduce((most, v) => Math.max(most, Math.abs(v)), 0);
}

function count(n: number, what: string): string {
  return `${n} ${what}${n === 1 ? '' : 's'}`;
}
