// SPDX-License-Identifier: GPL-3.0-or-later
// Charts of a class's predictions: a histogram of numbers, bars of choices, and the answer once it is shown.

import { rectY, ruleX, text, type Markish } from '@observablehq/plot';
import { apartBy, asPicture, count, fontSize, plotted, widthOf, type Drawn } from './chart';
import type { Ink } from './colour';
import { axisFor, axisOfNames, type Axis } from './ticks';
import { extentOf, numberText, shareOf } from './units';

type Size = readonly [width: number, height: number];

interface Bar {
  from: number;
  to: number;
  count: number;
}

const widest = 30; // largest over smallest on a linear axis

/** Values around the middle 90 %, by as much as its span on both sides. An outlier does not widen the axis. */
export function robust(values: number[], answer?: number): { shown: number[]; log: boolean } {
  const sorted = [...values].sort((a, b) => a - b);
  const cut = sorted.length < 5 ? 0 : Math.ceil(sorted.length / 20);
  const core = sorted.slice(cut, sorted.length - cut);
  const [low, high] = extentOf(answer === undefined ? core : [...core, answer]);
  const log = sorted[0] > 0 && low > 0 && high / low > widest;
  const place = log ? Math.log : (value: number) => value;
  const room = Math.max(place(high) - place(low), log ? 0 : Math.abs(high) / 2);
  return { shown: sorted.filter((v) => place(v) >= place(low) - room && place(v) <= place(high) + room), log };
}

export function drawHistogram(values: number[], [width, height]: Size, ink: Ink, answer?: number): Drawn {
  const { shown, log } = robust(values, answer);
  const ends = answer === undefined ? shown : [...shown, answer];
  const x = axisFor(ends, log, apartBy((label) => widthOf(label) + 16, width - 70));
  const [low, high] = x.domain;
  const steps = Math.max(4, Math.min(12, Math.ceil(2 * Math.sqrt(values.length))));
  const edge = (k: number): number => (log ? low * (high / low) ** (k / steps) : low + ((high - low) * k) / steps);
  const bins = Array.from({ length: steps }, (_, k) => ({ from: edge(k), to: edge(k + 1), count: 0 }));
  for (const v of shown) ++bins[Math.min(steps - 1, Math.floor(shareOf(v, x.domain, log) * steps))].count;
  const beyond = values.length - shown.length;
  const middle = [...values].sort((a, b) => a - b)[Math.floor((values.length - 1) / 2)];
  const summary =
    `${count(values.length, 'prediction')} from ${numberText(shown[0])} to ${numberText(shown.at(-1)!)}` +
    `${beyond ? ` and ${beyond} beyond` : ''}, half of them up to ${numberText(middle)}`;
  const line = answer === undefined ? [] : [ruleX([answer], { stroke: ink.series[1], strokeWidth: 3 })];
  return drawn(bins, x, line, summary, answer === undefined ? undefined : numberText(answer), [width, height], ink);
}

/** `choices` in their order, with those nobody chose. */
export function drawBars(values: string[], choices: string[], size: Size, ink: Ink, answer?: string): Drawn {
  const names = [...new Set([...choices, ...values])];
  const counts = names.map((name) => values.filter((v) => v === name).length);
  const bars = counts.map((count, k) => ({ from: k - 0.35, to: k + 0.35, count }));
  const x = axisOfNames(names.map((name) => (name === answer ? `✓ ${name}` : name)), () => true);
  const summary = `${count(values.length, 'prediction')}: ${names.map((name, k) => `${name} ${counts[k]}`).join(', ')}`;
  return drawn(bars, x, [], summary, answer, size, ink);
}

function drawn(
  bars: Bar[],
  x: Axis,
  front: Markish[],
  words: string,
  answer: string | undefined,
  [width, height]: Size,
  ink: Ink,
): Drawn {
  const most = Math.max(...bars.map((b) => b.count));
  const y = axisFor([0, most], false, apartBy(() => 1.6 * fontSize, height - 70));
  const places = { x1: 'from', x2: 'to', y: 'count', fill: ink.series[0], inset: 1 };
  const margin = { left: 44, right: 24, top: 30, bottom: 32 };
  const summary = words + (answer === undefined ? '' : `; the answer is ${answer}`);
  const told = { fontSize, fill: ink.text, frameAnchor: 'top' as const, dy: -18 };
  const element = plotted({ width, height, margin, x, y, ink }, [rectY(bars.filter((b) => b.count > 0), places)], [
    ...front,
    ...(answer === undefined ? [] : [text([`The answer: ${answer}`], told)]),
  ]);
  return { element: asPicture(element, summary, ink), summary, left: 0 };
}
