// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of a view as numbers, with captions. A gap is drawn downwards: contact is highest.

import type { FieldFacts, View } from './api';
import { extentOf, numberText, scaleFor, withUnit } from './units';

export interface Field extends FieldFacts {
  values: Float32Array; // NaN: missing
}

export function fieldsOf(view: View): Field[] {
  return view.fields.map((field) => {
    const bytes = atob(field.data);
    return fieldOf(field, new Float32Array(new Uint8Array(bytes.length).map((_, k) => bytes.charCodeAt(k)).buffer));
  });
}

export function fieldOf(field: FieldFacts, values: Float32Array | undefined): Field {
  if (values?.length !== field.nx * field.ny)
    throw new Error(`the map \`${field.name}\` has ${values?.length} numbers where ${field.nx * field.ny} belong`);
  return { ...field, values };
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
  const [low, high] = extentOf(values);
  return high > low ? high - low : 0;
}

export const exaggerations: number[] = [];
for (let power = -2; power <= 6; ++power) for (const f of [1, 2, 5]) exaggerations.push(f * 10 ** power);

/** For a relief height of about a sixth of the side. */
export function fittingExaggeration({ values, size_x, size_y }: Field): number {
  const span = spanOf(values);
  if (!(span > 0)) return exaggerations.indexOf(1);
  const wanted = Math.log((0.17 * Math.max(size_x, size_y)) / span);
  const away = exaggerations.map((e) => Math.abs(Math.log(e) - wanted));
  return away.indexOf(Math.min(...away));
}

/** The length of the scale bar: round, near a third of the relief. */
export function barFor(span: number): number {
  if (!(span > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(span / 2));
  return [5, 2, 1].map((f) => f * power).find((b) => b <= span / 2) ?? power;
}

export function anchorText(name: 'x' | 'y' | 'z', colour: Field, relief: Field | undefined): string {
  if (name === 'z') return withUnit(barFor(spanOf(relief!.values)), 'm');
  const scale = scaleFor('m', Math.max(colour.size_x, colour.size_y));
  return `${name}  ${numberText((name === 'x' ? colour.size_x : colour.size_y) / scale.factor)} ${scale.unit}`;
}

export function factorText(factor: number): string {
  return factor >= 1 ? `× ${factor.toLocaleString('en').replace(/,/g, ' ')}` : `× ${numberText(factor)}`;
}

/** "shown: 128 × 128 means of 8 × 8 nodes of 1024 × 1024", "all … nodes shown". */
function samplingText(field: Field): string {
  const shown = `${field.nx} × ${field.ny}`;
  const from = `${field.from_nx} × ${field.from_ny}`;
  if (field.reduction === 'none' || shown === from) return `all ${from} nodes shown`;
  const mean = /^mean of (\d+) x (\d+) (\w+)(.*)$/.exec(field.reduction);
  if (!mean) return `shown: ${shown} of ${from} (${field.reduction})`;
  return `shown: ${shown} means of ${mean[1]} × ${mean[2]} ${mean[3]} of ${from}${mean[4]}`;
}

export function captionOf(colour: Field, relief: Field | undefined, exaggeration: number): string {
  const scale = scaleFor('m', Math.max(colour.size_x, colour.size_y));
  const [x, y] = [colour.size_x, colour.size_y].map((size) => numberText(size / scale.factor));
  const parts = [`${x} × ${y} ${scale.unit}`];
  if (relief) parts.push(`${relief.name === 'gap' ? 'gap, drawn downwards,' : 'heights'} ${factorText(exaggeration)}`);
  else parts.push('flat map');
  parts.push(samplingText(colour));
  if (colour.not_measured) parts.push(`${colour.not_measured} nodes not measured`);
  return parts.join(' · ');
}

export function describe(colour: Field): string {
  const { values } = colour;
  const [least, most] = extentOf(values);
  let [sum, known] = [0, 0];
  for (let k = 0; k < values.length; ++k) {
    if (Number.isNaN(values[k])) continue;
    sum += values[k];
    ++known;
  }
  const mean = Math.abs(sum) > 1e-6 * (most - least) * known ? sum / known : 0;
  return `${colour.name} from ${withUnit(least, colour.unit)} to ${withUnit(most, colour.unit)}, mean ${withUnit(mean, colour.unit)}`;
}
