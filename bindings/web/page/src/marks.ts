// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a chart's line. A paper-coloured outline keeps single points apart; where they come closer
// than their own size it would hide the neighbours and the line, so such points have none. Where many are
// close all are smaller, and closer still they are left to the line if it goes through every one of them.

import { svg } from './dom';

export interface Place {
  x: number;
  y: number;
}

export type Marks = 'large' | 'small' | 'none';

const radii = { large: 4, small: 2, none: 0 };
const shapes = [
  (r: number) => svg('circle', { r }),
  (r: number) => svg('rect', { x: -r * 0.9, y: -r * 0.9, width: r * 1.8, height: r * 1.8 }),
  (r: number) => svg('path', { d: `M0 ${-1.25 * r}L${1.15 * r} ${0.85 * r}H${-1.15 * r}Z` }),
  (r: number) => svg('path', { d: `M0 ${-1.3 * r}L${1.3 * r} 0L0 ${1.3 * r}L${-1.3 * r} 0Z` }),
];

/** The shape of the line with this index, in its colour. */
export function markAt(index: number, place: Place, radius: number, colour: string): SVGElement {
  const mark = shapes[index % shapes.length](radius);
  mark.setAttribute('transform', `translate(${place.x.toFixed(1)} ${place.y.toFixed(1)})`);
  mark.setAttribute('fill', colour);
  return mark;
}

/** What suits the points of one line; `onLine`: the line goes through every one of them. */
export function marksFor(places: Place[], onLine: boolean): Marks {
  if (share(crowded(places, 2 * radii.large)) <= 0.2) return 'large';
  return onLine && places.length > 100 && share(crowded(places, 2 * radii.small)) > 0.5 ? 'none' : 'small';
}

/** The marks of one line, each with its words. */
export function drawMarks(
  places: Place[],
  marks: Marks,
  index: number,
  ink: { colour: string; paper: string },
  words: (k: number) => string,
): SVGElement[] {
  if (marks === 'none') return [];
  const close = crowded(places, 2 * radii[marks]);
  // In a cloud of points the line through their means is seen through them.
  const cloud = share(close) > 0.5;
  return places.map((place, k) => {
    const mark = markAt(index, place, radii[marks], ink.colour);
    if (marks === 'large' && !close[k]) mark.setAttribute('stroke', ink.paper);
    if (cloud) mark.setAttribute('fill-opacity', '0.5');
    mark.append(svg('title', {}, words(k)));
    return mark;
  });
}

/** Of each place, whether another is nearer than `size`; places that cannot be told apart are one. */
function crowded(places: Place[], size: number): boolean[] {
  const tenths = places.map((p) => ({ x: Math.round(10 * p.x), y: Math.round(10 * p.y) }));
  const squares = new Map<string, Map<string, Place>>();
  const square = (v: number): number => Math.floor(v / (10 * size));
  for (const p of tenths) {
    const key = `${square(p.x)} ${square(p.y)}`;
    let inside = squares.get(key);
    if (!inside) squares.set(key, (inside = new Map()));
    inside.set(`${p.x} ${p.y}`, p);
  }
  return tenths.map((p) => {
    for (let i = -1; i <= 1; ++i) {
      for (let j = -1; j <= 1; ++j) {
        for (const q of squares.get(`${square(p.x) + i} ${square(p.y) + j}`)?.values() ?? []) {
          const away = Math.hypot(p.x - q.x, p.y - q.y);
          if (away > 0 && away < 10 * size) return true;
        }
      }
    }
    return false;
  });
}

function share(of: boolean[]): number {
  return of.filter(Boolean).length / of.length;
}
