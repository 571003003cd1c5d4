// SPDX-License-Identifier: GPL-3.0-or-later
// Views as self-contained drawings with legend, labels and caption, in light colours for paper: pressure of a
// press, heights of a surface.

import { coloursOf, drawFlat, legend, legendHeight, lightInk, rangeOf } from './colour';
import { svg } from './dom';
import {
  anchorText,
  captionOf,
  describe,
  exaggerations,
  fittingExaggeration,
  reliefFields,
  type Attitude,
  type Field,
} from './pictures';
import type { ReliefScene } from './scene';

export interface Drawing {
  title: string;
  caption: string;
  text: string;
  element: SVGElement;
}

const [width, height] = [720, 480];
const above: Attitude = { turn: 0, tilt: 89.9, zoom: 1 };

/** `steps`: exaggeration by relief name; a missing step is fitted and stored. */
export async function drawingsOf(
  views: { name: string; title: string }[],
  fieldsOf: (name: string) => Promise<Field[]>,
  attitude: Attitude,
  steps: Map<string, number>,
): Promise<Drawing[]> {
  const canvas = document.createElement('canvas');
  const scene = await sceneOn(canvas);
  const result: Drawing[] = [];
  for (const { name, title } of views) {
    const fields = await fieldsOf(name);
    const field = fields.find((f) => f.name === 'pressure') ?? fields[0];
    if (!field) continue;
    await new Promise((r) => setTimeout(r)); // keep the page responsive
    const found = reliefFields(fields).find((f) => f.name === 'height') ?? reliefFields(fields)[0];
    const relief = scene && found?.nx === field.nx && found.ny === field.ny ? found : undefined;
    if (relief && !steps.has(relief.name)) steps.set(relief.name, fittingExaggeration(relief));
    const exaggeration = exaggerations[relief ? steps.get(relief.name)! : 0];
    const range = rangeOf(field.name, field.values);
    const colours = coloursOf(field.name, field.values, range);
    if (scene) {
      scene.show(field, relief, colours, exaggeration);
      scene.render(relief ? attitude : above);
    } else {
      drawFlat(canvas, field, colours);
    }
    const element = svg('svg', {
      xmlns: 'http://www.w3.org/2000/svg',
      viewBox: `0 0 ${width} ${height + legendHeight}`,
      width,
      height: height + legendHeight,
      role: 'img',
      'aria-label': `${title}: ${describe(field)}`,
      'font-family': 'system-ui, sans-serif',
      'font-size': 16,
      fill: lightInk.text,
    });
    element.append(svg('image', { href: canvas.toDataURL('image/png'), width, height }));
    for (const anchor of scene?.anchors(width, height) ?? []) {
      const end = anchor.name === 'z' ? 'middle' : anchor.outward < 0 ? 'end' : 'start';
      const place = { x: anchor.left, y: anchor.top + (anchor.name === 'z' ? 20 : 24), 'text-anchor': end };
      element.append(svg('text', place, anchorText(anchor.name, field, relief)));
    }
    const bar = legend(field.name, field.unit, range, width, lightInk.text);
    bar.setAttribute('y', String(height));
    element.append(bar);
    result.push({ title, caption: captionOf(field, relief, exaggeration), text: describe(field), element });
  }
  scene?.dispose();
  return result;
}

/** Undefined without WebGL. */
async function sceneOn(canvas: HTMLCanvasElement): Promise<ReliefScene | undefined> {
  const { ReliefScene: Made } = await import('./scene');
  try {
    const scene = new Made(canvas);
    scene.resize(width, height, 1);
    scene.setInk(lightInk.muted);
    return scene;
  } catch {
    return undefined;
  }
}
