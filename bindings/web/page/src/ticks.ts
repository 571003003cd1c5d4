// SPDX-License-Identifier: GPL-3.0-or-later
// Range and ticks of an axis: the largest set without overlapping labels. Integer data have integer ticks. A
// logarithmic axis ends at its data. Plot's own ticks give halves between whole numbers, prefixes without a unit
// (100m), and logarithmic axes with most labels empty.

import { scaleLinear } from 'd3-scale';
import { extentOf, raised, sameToRounding, shareOf } from './units';

export interface Axis {
  domain: [number, number];
  ticks: number[];
  labels: string[];
  log: boolean;
}

/** Whether labels at these fractions of the axis do not overlap. */
export type Apart = (labels: string[], shares: number[]) => boolean;

export function axisFor(values: number[], log: boolean, apart: Apart): Axis {
  let [low, high] = extentOf(values);
  const whole = values.every((v) => Math.abs(v) < 1e9 && Math.abs(v - Math.round(v)) < 1e-9);
  if (sameToRounding(low, high)) {
    const spare = whole ? 1 : Math.abs(high) / 10 || 1;
    [low, high] = log ? [low / 2, high * 2] : [low - spare, high + spare];
  }
  const domain: [number, number] = log ? aLittleBeyond(low, high) : niceAround(low, high, whole);
  const sets = log ? logarithmic(domain) : linear(domain, whole);
  const axes = sets.map((ticks) => ({ domain, ticks, labels: log ? labelsOfPowers(ticks) : labelsOf(ticks), log }));
  return axes.find(({ ticks, labels }) => apart(labels, ticks.map((t) => shareOf(t, domain, log)))) ?? axes.at(-1)!;
}

/** If necessary only every second, third … name is written. */
export function axisOfNames(names: string[], apart: Apart): Axis {
  const domain: [number, number] = [-0.5, names.length - 0.5];
  for (let every = 1; ; ++every) {
    const ticks = names.flatMap((_, k) => (k % every === 0 ? [k] : []));
    const labels = ticks.map((t) => names[t]);
    if (ticks.length < 2 || apart(labels, ticks.map((t) => shareOf(t, domain, false))))
      return { domain, ticks, labels, log: false };
  }
}

/** Room for a whole mark. */
function aLittleBeyond(low: number, high: number): [number, number] {
  const factor = (high / low) ** 0.03;
  return [low / factor, high * factor];
}

function niceAround(low: number, high: number, whole: boolean): [number, number] {
  const [from, to] = scaleLinear().domain([low, high]).nice(6).domain();
  return whole ? [Math.floor(from), Math.ceil(to)] : [from, to];
}

/** The last is a single tick. */
function linear([low, high]: [number, number], whole: boolean): number[][] {
  const scale = scaleLinear().domain([low, high]);
  const sets = [8, 6, 5, 4, 3, 2].map((count) => scale.ticks(count).filter((t) => !whole || Number.isInteger(t)));
  return [...sets.filter((ticks) => ticks.length > 0), [low, high], [high]];
}

function logarithmic([low, high]: [number, number]): number[][] {
  const decades = Math.log10(high / low);
  const first = Math.floor(Math.log10(low));
  const powers = Array.from({ length: Math.ceil(decades) + 1 }, (_, k) => first + k);
  const of = (factors: number[], every = 1): number[][] => {
    const all = powers.filter((p) => p % every === 0).flatMap((p) => factors.map((f) => Number(`${f}e${p}`)));
    const ticks = all.filter((t) => t >= low && t <= high);
    return ticks.length >= 2 ? [ticks] : [];
  };
  const even = linear([low, high], false).map((ticks) => ticks.filter((t) => t > 0));
  return [
    ...(decades < 0.8 ? even.filter((ticks) => ticks.length > 1) : []),
    ...(decades < 4 ? of([1, 2, 5]) : []),
    ...(decades < 5 ? of([1, 3]) : []),
    ...[1, 2, 3, 4, 5, 10, 20, 50].flatMap((every) => of([1], every)),
    ...even.slice(-3),
  ];
}

/** Plain, or with a common power of ten; enough digits to distinguish them. */
function labelsOf(ticks: number[]): string[] {
  const greatest = ticks.reduce((most, t) => Math.max(most, Math.abs(t)), 0);
  const power = greatest > 0 ? Math.floor(Math.log10(greatest) + 1e-9) : 0;
  const far = power < -3 || power > 5;
  const factor = far ? 10 ** power : 1;
  const behind = far ? `×10${raised(power)}` : '';
  for (let digits = 4; ; ++digits) {
    const labels = ticks.map((t) => (t === 0 ? '0' : `${Number((t / factor).toPrecision(digits))}${behind}`));
    if (new Set(labels).size === ticks.length || digits >= 15) return labels.map((l) => l.replace(/^-/, '−'));
  }
}

/** Plain if all fit, else powers of ten. */
function labelsOfPowers(ticks: number[]): string[] {
  if (ticks.every((t) => t >= 0.999e-2 && t < 1.001e5)) return labelsOf(ticks);
  return ticks.map((t) => {
    const power = Math.floor(Math.log10(t) + 1e-9);
    const mantissa = Number((t / 10 ** power).toPrecision(4));
    return `${mantissa === 1 ? '' : `${mantissa}×`}10${raised(power)}`;
  });
}
