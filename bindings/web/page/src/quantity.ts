// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities as a user types them: "50 MPa", "1,5 um", "3e-3 N/m^2". Units are the script's, with prefixes.

import { scaleFor, unitText } from './units';

/** With a sentence for the user. */
export class QuantityError extends Error {}

/** A factor to SI, and powers of m, kg, s and rad. */
type Unit = [factor: number, m: number, kg: number, s: number, rad: number];

const bases: Record<string, Unit> = {
  m: [1, 1, 0, 0, 0],
  g: [1e-3, 0, 1, 0, 0],
  s: [1, 0, 0, 1, 0],
  rad: [1, 0, 0, 0, 1],
  N: [1, 1, 1, -2, 0],
  Pa: [1, -1, 1, -2, 0],
  J: [1, 2, 1, -2, 0],
  Hz: [1, 0, 0, -1, 0],
  bar: [1e5, -1, 1, -2, 0],
};
const others: Record<string, Unit> = {
  '1': [1, 0, 0, 0, 0],
  '%': [1e-2, 0, 0, 0, 0],
  deg: [Math.PI / 180, 0, 0, 0, 1],
  '°': [Math.PI / 180, 0, 0, 0, 1],
  turn: [2 * Math.PI, 0, 0, 0, 1],
  min: [60, 0, 0, 1, 0],
  h: [3600, 0, 0, 1, 0],
  t: [1e3, 0, 1, 0, 0],
  in: [0.0254, 1, 0, 0, 0],
  psi: [6894.757293168361, -1, 1, -2, 0],
  HV: [9806650, -1, 1, -2, 0],
  kgf: [9.80665, 1, 1, -2, 0],
  lbf: [4.4482216152605, 1, 1, -2, 0],
};
const prefixes: Record<string, number> = {
  f: 1e-15, p: 1e-12, n: 1e-9, u: 1e-6, m: 1e-3, c: 1e-2, h: 1e2, k: 1e3, M: 1e6, G: 1e9, T: 1e12, '': 1,
};

function named(name: string): Unit | undefined {
  if (name in others) return others[name];
  const base = Object.keys(bases).find((b) => name.endsWith(b) && name.slice(0, -b.length) in prefixes);
  if (!base) return undefined;
  const [factor, ...powers] = bases[base];
  return [factor * prefixes[name.slice(0, -base.length)], ...powers];
}

const raised = '⁰¹²³⁴⁵⁶⁷⁸⁹';

/** Undefined for an unknown name. */
function unitIn(text: string): Unit | undefined {
  const plain = text
    .replace(/⁻/g, '-')
    .replace(/[⁰¹²³⁴-⁹]/g, (c) => String(raised.indexOf(c)))
    .replace(/[µμ]/g, 'u')
    .replace(/\*\*|\^/g, '');
  const unit: Unit = [1, 0, 0, 0, 0];
  for (const [, sign, name, power] of plain.matchAll(/\s*([*·/]?)\s*([a-zA-Z%°]+|1|[^\s])(-?\d+)?/g)) {
    const one = named(name);
    if (!one) return undefined;
    const times = Number(power ?? 1) * (sign === '/' ? -1 : 1);
    unit[0] *= one[0] ** times;
    for (let k = 1; k < unit.length; ++k) unit[k] += one[k] * times;
  }
  return unit;
}

/** The SI value. A number without a unit has the unit of `shown`, the value on the screen. Throws QuantityError. */
export function quantityIn(text: string, unit: string, shown: number): number {
  const scale = scaleFor(unit, Math.abs(shown));
  const example = `for example 1.5${scale.unit && ` ${scale.unit}`}`;
  const found = /^\s*([+\-−]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*$/.exec(text);
  if (!found) throw new QuantityError(`“${text.trim()}” is no number. Give a number with its unit, ${example}.`);
  const number = Number(found[1].replace(',', '.').replace('−', '-'));
  const [given, wanted] = [unitIn(found[2]), unitIn(unit)!];
  if (found[2] === '') return Number((number * scale.factor).toPrecision(15));
  if (!given) throw new QuantityError(`“${found[2]}” is no unit. Give a number with its unit, ${example}.`);
  if (wanted.some((power, k) => k > 0 && power !== given[k]))
    throw new QuantityError(`“${found[2]}” is no unit of this. Give ${unitText(unit) || 'a plain number'}, ${example}.`);
  return Number((number * (given[0] / wanted[0])).toPrecision(15));
}
