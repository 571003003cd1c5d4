// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of values from 256 palette colours. Cells without contact have no pressure and no yield: grey, not
// the lowest colour. Missing values are darker grey.

import { scaleLinear } from 'd3-scale';
import { svg } from './dom';
import { bytesOf, paletteOf } from './palettes';
import { numberText, scaleFor } from './units';

const tables = new Map<string, Uint8Array>();

export function tableOf(field: string): Uint8Array {
  const known = tables.get(field);
  if (known) return known;
  const { colours } = paletteOf(field);
  const table = new Uint8Array(768);
  for (let k = 0; k < 256; ++k) {
    const place = (k / 255) * (colours.length - 1);
    const below = Math.min(Math.floor(place), colours.length - 2);
    const [from, to] = [bytesOf(colours[below]), bytesOf(colours[below + 1])];
    for (let c = 0; c < 3; ++c) table[3 * k + c] = Math.round(from[c] + (place - below) * (to[c] - from[c]));
  }
  tables.set(field, table);
  return table;
}

export interface Range {
  low: number;
  high: number;
}

/** Pressures, gaps and fractions start at zero. */
export function rangeOf(field: string, values: Float32Array): Range {
  let low = Infinity;
  let high = -Infinity;
  for (const v of values) {
    if (!Number.isFinite(v)) continue;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  if (low > high) return { low: 0, high: 1 };
  if (field === 'contact') return { low: 0, high: 1 };
  if (field !== 'height' && low > 0) low = 0;
  return low === high ? { low: low - (Math.abs(low) || 1) / 2, high: high + (Math.abs(high) || 1) / 2 } : { low, high };
}

export function coloursOf(field: string, values: Float32Array, range: Range): Uint8Array {
  const table = tableOf(field);
  const none = noneOf(field);
  const out = new Uint8Array(values.length * 3);
  const factor = 255 / (range.high - range.low);
  for (let k = 0; k < values.length; ++k) {
    const v = values[k];
    if (!Number.isFinite(v)) {
      out.fill(128, 3 * k, 3 * k + 3);
      continue;
    }
    if (none && v <= 0) {
      out[3 * k] = none[0];
      out[3 * k + 1] = none[1];
      out[3 * k + 2] = none[2];
      continue;
    }
    const at = 3 * Math.min(255, Math.max(0, Math.round((v - range.low) * factor)));
    out[3 * k] = table[at];
    out[3 * k + 1] = table[at + 1];
    out[3 * k + 2] = table[at + 2];
  }
  return out;
}

function noneOf(field: string): [number, number, number] | undefined {
  const { none } = paletteOf(field);
  return none === undefined ? undefined : bytesOf(none);
}

/** `height` in px. */
export function legend(field: string, unit: string, range: Range, height: number, ink: string): SVGElement {
  const table = tableOf(field);
  const scale = scaleFor(unit, Math.max(Math.abs(range.low), Math.abs(range.high)));
  const name = field === 'contact' ? 'contact' : field;
  const root = svg('svg', {
    width: 100,
    height,
    viewBox: `0 0 100 ${height}`,
    role: 'img',
    'font-family': 'system-ui, sans-serif',
    'font-size': 15,
    fill: ink,
    'aria-label': `Colours: ${name} from ${numberText(range.low / scale.factor)} to ${numberText(range.high / scale.factor)} ${scale.unit}`,
  });
  root.append(
    svg('text', { x: 4, y: 16 }, name),
    svg('text', { x: 4, y: 34, 'font-size': 14 }, scale.unit ? `[${scale.unit}]` : field === 'contact' ? 'share' : ''),
  );
  const top = 46;
  const none = noneOf(field);
  const bottom = height - (none ? 40 : 10);
  if (none) {
    root.append(
      svg('rect', {
        x: 4,
        y: height - 28,
        width: 20,
        height: 18,
        fill: `rgb(${none.join(',')})`,
        stroke: ink,
        'stroke-opacity': 0.5,
      }),
      svg('text', { x: 33, y: height - 14 }, 'none'),
    );
  }
  const steps = 64;
  for (let k = 0; k < steps; ++k) {
    const at = 3 * Math.round((255 * k) / (steps - 1));
    const y = bottom - ((k + 1) * (bottom - top)) / steps;
    root.append(
      svg('rect', {
        x: 4,
        y,
        width: 20,
        height: (bottom - top) / steps + 0.6,
        fill: `rgb(${table[at]},${table[at + 1]},${table[at + 2]})`,
      }),
    );
  }
  root.append(
    svg('rect', { x: 4, y: top, width: 20, height: bottom - top, fill: 'none', stroke: ink, 'stroke-opacity': 0.5 }),
  );
  const place = scaleLinear()
    .domain([range.low / scale.factor, range.high / scale.factor])
    .range([bottom, top]);
  for (const tick of place.ticks(Math.max(2, Math.floor(height / 55)))) {
    const y = place(tick);
    root.append(
      svg('line', { x1: 24, x2: 29, y1: y, y2: y, stroke: ink }),
      svg('text', { x: 33, y: y + 5 }, numberText(tick, 5)),
    );
  }
  return root;
}
