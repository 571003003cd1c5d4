// SPDX-License-Identifier: GPL-3.0-or-later
// Readable numbers from SI data: one prefix for a column, axis or legend.

export interface Scale {
  factor: number; // from shown value to SI
  unit: string; // empty: pure number
}

const prefixes = [...'pnµm kMGT'].map((p, k): [number, string] => [Number(`1e${3 * k - 12}`), p.trim()]);

export function unitText(unit: string): string {
  return unit.replace(/\^(-?\d)/g, (_, power) => raised(Number(power))).replace(/\*/g, '·');
}

/** For absolute values up to `greatest`. */
export function scaleFor(unit: string | undefined, greatest: number): Scale {
  const plain = unitText(unit ?? '');
  const found = /^(m|Pa|N|J|s|W|Hz)(²|³)?(\/.*)?$/.exec(plain);
  if (!found || !(greatest > 0) || !Number.isFinite(greatest)) return { factor: 1, unit: plain };
  const power = found[2] === '²' ? 2 : found[2] === '³' ? 3 : 1;
  const largest = found[1] === 's' || power > 1 ? 1 : found[1] === 'm' ? 1e3 : 1e12;
  let best = prefixes[0];
  for (const prefix of prefixes) {
    if (prefix[0] <= largest && greatest >= prefix[0] ** power) best = prefix;
  }
  return { factor: best[0] ** power, unit: best[1] + plain };
}

export function grouped<Key, T>(items: Iterable<T>, keyOf: (item: T) => Key): Map<Key, T[]> {
  const groups = new Map<Key, T[]>();
  for (const item of items) {
    const group = groups.get(keyOf(item));
    if (group) group.push(item);
    else groups.set(keyOf(item), [item]);
  }
  return groups;
}

/** The least and the greatest finite value; [Infinity, -Infinity] without any. */
export function extentOf(values: Iterable<unknown>): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  if (values instanceof Float32Array) {
    // An index is ten times faster than an iterator here; maps are large.
    for (let k = 0; k < values.length; ++k) {
      const v = values[k];
      if (v - v !== 0) continue; // not finite
      if (v < low) low = v;
      if (v > high) high = v;
    }
    return [low, high];
  }
  for (const v of values) {
    if (typeof v !== 'number' || !Number.isFinite(v)) continue;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return [low, high];
}

/** The greatest absolute value. */
export function greatestOf(values: Iterable<unknown>): number {
  const [low, high] = extentOf(values);
  return Math.max(0, -low, high);
}

/** The place in a range: 0 at its lower end, 1 at its upper end. */
export function shareOf(value: number, [low, high]: [number, number], log: boolean): number {
  return log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
}

/** With powers of ten and a true minus sign. */
export function numberText(value: number, digits = 4): string {
  if (Number.isNaN(value)) return 'nan';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  if (value === 0) return '0';
  const size = Math.abs(value);
  let text: string;
  if (size >= 1e-3 && size < 1e6) {
    text = Number(value.toPrecision(digits)).toString();
  } else {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    text = `${Number(mantissa)}×10${raised(Number(exponent))}`;
  }
  return text.replace(/^-/, '−');
}

export function sameToRounding(low: number, high: number): boolean {
  return high - low <= 1e-9 * Math.max(Math.abs(low), Math.abs(high));
}

export function raised(exponent: number): string {
  return String(exponent).replace(/./g, (c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)]));
}

export function withUnit(value: number, unit: string | undefined): string {
  const scale = scaleFor(unit, Math.abs(value));
  return `${numberText(value / scale.factor)}${scale.unit ? ' ' + scale.unit : ''}`;
}

/** "Ra [µm]"; only the name for a pure number. */
export function label(name: string, scale: Scale): string {
  return scale.unit ? `${name} [${scale.unit}]` : name;
}

export function duration(seconds: number): string {
  if (seconds < 1) return `${Math.max(1, Math.round(seconds * 1000))} ms`;
  if (seconds < 10) return `${seconds.toFixed(1)} s`;
  if (seconds < 90) return `${Math.round(seconds)} s`;
  if (seconds < 5400) return `${Math.round(seconds / 60)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}

export function bytes(count: number): string {
  const units = { GB: 1e9, MB: 1e6, kB: 1e3, B: 1 };
  const [unit, size] = Object.entries(units).find(([, size]) => count >= size * 0.9995) ?? ['B', 1];
  return `${numberText(count / size, 3)} ${unit}`;
}
