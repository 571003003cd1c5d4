// SPDX-License-Identifier: GPL-3.0-or-later
// Readable numbers from SI data: one prefix for a column, axis or legend (4.2e-6 m is 4.2 µm).

export interface Scale {
  factor: number; // shown value times `factor` is SI
  unit: string; // with prefix; empty for a pure number
}

const prefixes: [number, string][] = [
  [1e-12, 'p'],
  [1e-9, 'n'],
  [1e-6, 'µ'],
  [1e-3, 'm'],
  [1, ''],
  [1e3, 'k'],
  [1e6, 'M'],
  [1e9, 'G'],
  [1e12, 'T'],
];

const superscripts: Record<string, string> = { '^2': '²', '^3': '³', '^-1': '⁻¹', '^-2': '⁻²' };

export function unitText(unit: string): string {
  return unit.replace(/\^-?\d/g, (power) => superscripts[power] ?? power).replace(/\*/g, '·');
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
  for (const [size, unit] of [
    [1e9, 'GB'],
    [1e6, 'MB'],
    [1e3, 'kB'],
  ] as const) {
    if (count >= size * 0.9995) return `${numberText(count / size, 3)} ${unit}`;
  }
  return `${count} B`;
}
