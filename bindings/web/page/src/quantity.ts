// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities as a user types them: "50 MPa", "1,5 um", "3 N/mm^2". The unit is the SI unit of the value with any
// prefix, or one of its other names.

import { scaleFor, unitText } from './units';

/** With a sentence for the user. */
export class QuantityError extends Error {}

/** By SI unit; their factors to it. */
const others: Record<string, Record<string, number>> = {
  '': { '%': 1e-2 },
  m: { in: 0.0254 },
  rad: { deg: Math.PI / 180, '°': Math.PI / 180, turn: 2 * Math.PI },
  s: { min: 60, h: 3600 },
  kg: { g: 1e-3, t: 1e3 },
  N: { kgf: 9.80665, lbf: 4.4482216152605 },
  Pa: { 'N/m²': 1, 'kN/m²': 1e3, 'N/mm²': 1e6, bar: 1e5, psi: 6894.757293168361, HV: 9806650 },
};
const prefixes: Record<string, number> = {
  f: 1e-15, p: 1e-12, n: 1e-9, µ: 1e-6, m: 1e-3, c: 1e-2, h: 1e2, k: 1e3, M: 1e6, G: 1e9, T: 1e12, '': 1,
};

/** From a written unit to SI; undefined if it is no unit of this value. */
function factorOf(written: string, unit: string): number | undefined {
  const name = unitText(written.replace(/\s|\*\*|\^/g, '').replace(/(?<=[a-z])-?\d/gi, '^$&').replace(/^[uμ]/, 'µ'));
  const power = { '²': 2, '³': 3 }[/^\p{L}+([²³])/u.exec(unit)?.[1] ?? ''] ?? 1;
  const prefix = unit !== '' && name.endsWith(unit) ? prefixes[name.slice(0, -unit.length)] : undefined;
  return others[unit]?.[name] ?? (prefix && prefix ** power);
}

/** With comma or point; undefined for another text. */
export function numberTyped(text: string): number | undefined {
  const plain = text.trim().replace('−', '-').replace(',', '.');
  const value = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
  return Number.isFinite(value) ? value : undefined;
}

/** The SI value. A number without a unit has the unit of `shown`, the value on the screen. Throws QuantityError. */
export function quantityIn(text: string, unit: string, shown: number): number {
  const scale = scaleFor(unit, Math.abs(shown));
  const wanted = `Give ${unitText(unit) || 'a plain number'}, for example 1.5${scale.unit && ` ${scale.unit}`}.`;
  const [, typed = '', written = ''] = /^([+\-−]?[\d.,]+(?:e[+-]?\d+)?)\s*(.*)$/i.exec(text.trim()) ?? [];
  const number = numberTyped(typed);
  if (number === undefined) throw new QuantityError(`“${text.trim()}” is no number. ${wanted}`);
  const factor = written === '' ? scale.factor : factorOf(written, unitText(unit));
  if (factor === undefined) throw new QuantityError(`“${written}” is no unit of this. ${wanted}`);
  return Number((number * factor).toPrecision(15));
}
