// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of a view as numbers, with captions. A gap is drawn downwards: contact is highest.

import type { View, ViewField } from './api';
import { numberText, scaleFor, withUnit } from './units';

export interface Field {
  name: string;
  unit: string;
  nx: number;
  ny: number;
  sizeX: number;
  sizeY: number;
  fromNx: number;
  fromNy: number;
  notMeasured: number; // number
  reduction: string;
  values: Float32Array; // NaN: missing
}

export function fieldsOf(view: View): Field[] {
  return view.fields.map((field) => fieldOf(field, numbersIn(field.data)));
}

function numbersIn(data: string): Float32Array {
  const text = atob(data);
  const raw = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) raw[k] = text.charCodeAt(k);
  const values = new Float32Array(Math.floor(raw.length / 4));
  const view = new DataView(raw.buffer);
  for (let k = 0; k < values.length; ++k) values[k] = view.getFloat32(4 * k, true);
  return values;
}

export function fieldOf(field: Omit<ViewField, 'data'>, values: Float32Array | undefined): Field {
  if (values?.length !== field.nx * field.ny)
    throw new Error(`the map \`${field.name}\` has ${values?.length} numbers where ${field.nx * field.ny} belong`);
  return {
    name: field.name,
    unit: field.unit,
    nx: field.nx,
    ny: field.ny,
    sizeX: field.size_x,
    sizeY: field.size_y,
    fromNx: field.from_nx,
    fromNy: field.from_ny,
    notMeasured: field.not_measured ?? 0,
    reduction: field.reduction,
    values,
  };
}

export interface Attitude {
  turn: number; // degrees about the vertical
  tilt: number; // degrees above the horizon
  zoom: number;
}

export const resting: Attitude = { turn: -32, tilt: 38, zoom: 1 };

export function reliefFields(fields: Field[]): Field[] {
  return fields.filter((f) => f.unit === 'm');
}

/** Relief heights in m. */
export function heightsOf(field: Field): Float32Array {
  return field.name === 'gap' ? field.values.map((v) => -v) : field.values;
}

export function spanOf(values: Float32Array): number {
  let low = Infinity;
  let high = -Infinity;
  for (const v of values) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return high > low ? high - low : 0;
}

export const exaggerations: number[] = [];
for (let power = -2; power <= 6; ++power) for (const f of [1, 2, 5]) exaggerations.push(f * 10 ** power);

/** For a relief height of about a sixth of the side. */
export function fittingExaggeration(span: number, side: number): number {
  if (!(span > 0)) return exaggerations.indexOf(1);
  const wanted = Math.log((0.17 * side) / span);
  let best = 0;
  exaggerations.forEach((e, k) => {
    if (Math.abs(Math.log(e) - wanted) < Math.abs(Math.log(exaggerations[best]) - wanted)) best = k;
  });
  return best;
}

/** The length of the scale bar: round, near a third of the relief. */
export function barFor(span: number): number {
  if (!(span > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(span / 2));
  return [5, 2, 1].map((f) => f * power).find((b) => b <= span / 2) ?? power;
}

export function anchorText(name: 'x' | 'y' | 'z', colour: Field, relief: Field | undefined): string {
  if (name === 'z') return withUnit(barFor(spanOf(relief!.values)), 'm');
  const scale = scaleFor('m', Math.max(colour.sizeX, colour.sizeY));
  return `${name}  ${numberText((name === 'x' ? colour.sizeX : colour.sizeY) / scale.factor)} ${scale.unit}`;
}

export function factorText(factor: number): string {
  return factor >= 1 ? `× ${factor.toLocaleString('en').replace(/,/g, ' ')}` : `× ${numberText(factor)}`;
}

/** "shown: 128 × 128 means of 8 × 8 nodes of 1024 × 1024", "all … nodes shown". */
export function samplingText(field: Field): string {
  const shown = `${field.nx} × ${field.ny}`;
  const from = `${field.fromNx} × ${field.fromNy}`;
  if (field.reduction === 'none' || shown === from) return `all ${from} nodes shown`;
  const mean = /^mean of (\d+) x (\d+) (\w+)(.*)$/.exec(field.reduction);
  if (!mean) return `shown: ${shown} of ${from} (${field.reduction})`;
  return `shown: ${shown} means of ${mean[1]} × ${mean[2]} ${mean[3]} of ${from}${mean[4]}`;
}

export function sizeText(field: Field): string {
  const scale = scaleFor('m', Math.max(field.sizeX, field.sizeY));
  return `${numberText(field.sizeX / scale.factor)} × ${numberText(field.sizeY / scale.factor)} ${scale.unit}`;
}

export function captionOf(colour: Field, relief: Field | undefined, exaggeration: number): string {
  const parts = [sizeText(colour)];
  if (relief) parts.push(`${relief.name === 'gap' ? 'gap, drawn downwards,' : 'heights'} ${factorText(exaggeration)}`);
  else parts.push('flat map');
  parts.push(samplingText(colour));
  if (colour.notMeasured > 0) parts.push(`${colour.notMeasured} nodes not measured`);
  return parts.join(' · ');
}

export function describe(colour: Field): string {
  let least = Infinity;
  let most = -Infinity;
  let sum = 0;
  let known = 0;
  for (const v of colour.values) {
    if (Number.isNaN(v)) continue;
    least = Math.min(least, v);
    most = Math.max(most, v);
    sum += v;
    ++known;
  }
  const mean = Math.abs(sum) > 1e-6 * (most - least) * known ? sum / known : 0;
  return `${colour.name} from ${withUnit(least, colour.unit)} to ${withUnit(most, colour.unit)}, mean ${withUnit(mean, colour.unit)}`;
}
