// SPDX-License-Identifier: GPL-3.0-or-later
// Point marks of chart lines. Single points have a paper-coloured outline; crowded points have none, because
// outlines would hide neighbours and the line. Many crowded points are smaller, or omitted if the line passes
// through all.

export interface Place {
  x: number;
  y: number;
}

export type Marks = 'large' | 'small' | 'none';

export const radii = { large: 4, small: 2, none: 0 };

/** `onLine`: the line passes through all points. */
export function marksFor(places: Place[], onLine: boolean): Marks {
  if (share(crowded(places, 2 * radii.large)) <= 0.2) return 'large';
  return onLine && places.length > 100 && share(crowded(places, 2 * radii.small)) > 0.5 ? 'none' : 'small';
}

/** Whether another place is nearer than `size`; identical places count as one. */
export function crowded(places: Place[], size: number): boolean[] {
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

export function share(of: boolean[]): number {
  return of.filter(Boolean).length / of.length;
}
