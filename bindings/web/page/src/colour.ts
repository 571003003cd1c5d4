// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of paper, lines and maps. A map has 256 colours of its palette. Cells without contact are grey, not
// the lowest colour; missing values are darker grey.

import { scaleLinear } from 'd3-scale';
import { svg } from './dom';
import { extentOf, greatestOf, numberText, scaleFor } from './units';

/** For light and dark paper; chart lines in Okabe and Ito's colours for all kinds of colour vision, adjusted
    for contrast. */
export interface Ink {
  text: string;
  muted: string;
  grid: string;
  paper: string;
  series: string[];
}

export const lightInk: Ink = {
  text: '#1c2126',
  muted: '#4d5963',
  grid: '#dfe3e6',
  paper: '#ffffff',
  series: ['#0b5fa5', '#b04a00', '#00765a', '#9a4480', '#6b5b00', '#3a3f47', '#3d86b8', '#c2611f'],
};
const darkInk: Ink = {
  text: '#e6eaed',
  muted: '#aeb9c2',
  grid: '#343c44',
  paper: '#14181c',
  series: ['#6fb7ee', '#f0964b', '#4fc9a4', '#e194c4', '#e0cd4e', '#c6ccd2', '#9fd3f2', '#ffbf8f'],
};

const dark = matchMedia('(prefers-color-scheme: dark)');
let ink = dark.matches ? darkInk : lightInk;
dark.addEventListener('change', () => (ink = dark.matches ? darkInk : lightInk));

export function inkNow(): Ink {
  return ink;
}

interface Palette {
  colours: number[]; // 0xRRGGBB, equal steps, ascending
  none?: number; // lowest value, if special
}

/** Map colours, as in engine/plot/palette.cpp. Viridis and cividis are perceptually uniform. Heat, inferno
    from orange to black, has a contrast of at least 3:1 with its grey. */
const palettes: Record<string, Palette> = {
  viridis: {
    colours: [
      0x440154, 0x48186a, 0x472d7b, 0x424086, 0x3b528b, 0x33638d, 0x2c728e, 0x26828e, 0x21918c, 0x1fa088, 0x28ae80,
      0x3fbc73, 0x5ec962, 0x84d44b, 0xaddc30, 0xd8e219, 0xfde725,
    ],
  },
  cividis: {
    colours: [0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173, 0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46],
  },
  heat: {
    colours: [0xdf5337, 0xcb4149, 0xb1325a, 0x932667, 0x751d6c, 0x57106e, 0x380962, 0x190c3e, 0x000004],
    none: 0xe6eaed,
  },
  contact: { colours: [0xe6e6e6, 0x08306b] },
};

const ofField: Record<string, string> = { gap: 'cividis', pressure: 'heat', plastic: 'heat', contact: 'contact' };

function paletteOf(field: string): Palette {
  return palettes[ofField[field] ?? 'viridis'];
}

function bytesOf(colour: number): [number, number, number] {
  return [colour >> 16, (colour >> 8) & 255, colour & 255];
}

function tableOf(field: string): Uint8Array {
  const { colours } = paletteOf(field);
  const table = new Uint8Array(768);
  for (let k = 0; k < 256; ++k) {
    const place = (k / 255) * (colours.length - 1);
    const below = Math.min(Math.floor(place), colours.length - 2);
    const [from, to] = [bytesOf(colours[below]), bytesOf(colours[below + 1])];
    for (let c = 0; c < 3; ++c) table[3 * k + c] = Math.round(from[c] + (place - below) * (to[c] - from[c]));
  }
  return table;
}

type Range = [low: number, high: number];

/** Pressures, gaps and fractions start at zero. */
export function rangeOf(field: string, values: Float32Array): Range {
  const [least, high] = extentOf(values);
  if (least > high || field === 'contact') return [0, 1];
  const low = field !== 'height' && least > 0 ? 0 : least;
  return low === high ? [low - (Math.abs(low) || 1) / 2, high + (Math.abs(high) || 1) / 2] : [low, high];
}

export function coloursOf(field: string, values: Float32Array, [low, high]: Range): Uint8Array {
  const table = tableOf(field);
  const none = noneOf(field);
  const out = new Uint8Array(values.length * 3);
  const factor = 255 / (high - low);
  for (let k = 0, to = 0; k < values.length; ++k, to += 3) {
    const v = values[k];
    if (!Number.isFinite(v)) {
      out.fill(128, to, to + 3);
      continue;
    }
    const from = none && v <= 0 ? none : table;
    const at = none && v <= 0 ? 0 : 3 * Math.min(255, Math.max(0, Math.round((v - low) * factor)));
    out[to] = from[at];
    out[to + 1] = from[at + 1];
    out[to + 2] = from[at + 2];
  }
  return out;
}

function noneOf(field: string): [number, number, number] | undefined {
  const { none } = paletteOf(field);
  return none === undefined ? undefined : bytesOf(none);
}

/** From above, y upwards, one pixel a node. `colours`: three bytes a node. */
export function drawFlat(canvas: HTMLCanvasElement, { nx, ny }: { nx: number; ny: number }, colours: Uint8Array): void {
  // Setting a size costs a layout, even the same size.
  if (canvas.width !== nx) canvas.width = nx;
  if (canvas.height !== ny) canvas.height = ny;
  const pixels = new ImageData(nx, ny);
  const words = new Uint32Array(pixels.data.buffer); // little-endian, as the views are
  for (let j = 0, k = 0; j < ny; ++j)
    for (let to = (ny - 1 - j) * nx, end = to + nx; to < end; ++to, k += 3)
      words[to] = 0xff000000 | (colours[k + 2] << 16) | (colours[k + 1] << 8) | colours[k];
  canvas.getContext('2d')!.putImageData(pixels, 0, 0);
}

export const legendHeight = 42; // px

/** `width` in px. */
export function legend(field: string, unit: string, range: Range, width: number, ink: string): SVGElement {
  const scale = scaleFor(unit, greatestOf(range));
  const [low, high] = range.map((value) => value / scale.factor);
  const root = svg('svg', {
    width,
    height: legendHeight,
    viewBox: `0 0 ${width} ${legendHeight}`,
    role: 'img',
    'font-family': 'system-ui, sans-serif',
    'font-size': 15,
    fill: ink,
    'aria-label': `Colours: ${field} from ${numberText(low)} to ${numberText(high)} ${scale.unit}`,
  });
  const measure = scale.unit ? `[${scale.unit}]` : field === 'contact' ? 'share' : '';
  root.append(svg('text', { x: 4, y: 16 }, field), svg('text', { x: 4, y: 36, 'font-size': 14 }, measure));
  const none = noneOf(field);
  const left = 18 + Math.max(64, 8.6 * field.length) + (none ? 48 : 0);
  const frame = { y: 4, height: 14, stroke: ink, 'stroke-opacity': 0.5 };
  if (none)
    root.append(
      svg('rect', { ...frame, x: left - 44, width: 20, fill: `rgb(${none.join(',')})` }),
      svg('text', { x: left - 34, y: 36, 'text-anchor': 'middle' }, 'none'),
    );
  const bar = { ...frame, x: left, width: width - 24 - left };
  const { colours } = paletteOf(field);
  const stops = colours.map((colour, k) =>
    svg('stop', { offset: k / (colours.length - 1), 'stop-color': `rgb(${bytesOf(colour).join(',')})` }),
  );
  const id = `colours-of-${field}`;
  root.append(svg('linearGradient', { id }, ...stops), svg('rect', { ...bar, fill: `url(#${id})` }));
  const place = scaleLinear([low, high], [bar.x, bar.x + bar.width]);
  for (const tick of place.ticks(Math.max(2, Math.floor(bar.width / 70)))) {
    const x = place(tick);
    root.append(
      svg('line', { x1: x, x2: x, y1: 18, y2: 22, stroke: ink }),
      svg('text', { x, y: 36, 'text-anchor': 'middle' }, numberText(tick, 5)),
    );
  }
  return root;
}
