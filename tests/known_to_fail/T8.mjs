// SPDX-License-Identifier: GPL-3.0-or-later
// T8: pressure runs from white to dark red in pictures and from black to yellow on the page, whose grey of no contact is as
// bright as its orange. Wanted: one scale in both, 3:1 at least to the grey. The work on the page that is alive owns it.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { claim, on } from './claims_of_page.mjs';

const source = new URL('../../bindings/web/page/src/colour.ts', import.meta.url);
const text = readFileSync(source, 'utf8');
const [, map] = /pressure: interpolate(\w+)/.exec(text);
const none = JSON.parse(/const none = (\[.*?\])/.exec(text)[1]);
const maps = await import(pathToFileURL(join(on.build, 'page-build/node_modules/d3-scale-chromatic/dist/d3-scale-chromatic.mjs')));

const bytes = (colour) =>
  colour.startsWith('#')
    ? [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16))
    : colour.match(/\d+/g).slice(0, 3).map(Number);
const linear = (byte) => (byte / 255 <= 0.04045 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
const bright = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
const contrast = (a, b) => (Math.max(bright(a), bright(b)) + 0.05) / (Math.min(bright(a), bright(b)) + 0.05);
const least = Math.min(...[...Array(101).keys()].map((k) => contrast(bytes(maps[`interpolate${map}`](k / 100)), none)));
claim('the grey of no contact stands out from each pressure by 3:1', least >= 3, least.toFixed(2));

const pictures = readFileSync(new URL('../../bindings/lua/surface/field_class.cpp', import.meta.url), 'utf8');
const [, heat] = /f\.name == "pressure"\) options\.palette = "(\w+)"/.exec(pictures);
claim('pictures and page have one scale of pressure', map.toLowerCase() === heat, map, heat);
