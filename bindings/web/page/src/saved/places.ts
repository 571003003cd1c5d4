// SPDX-License-Identifier: GPL-3.0-or-later
// Recorded knob values, and the run for a slider move: the new value, with the fewest steps in other knobs.

export type Recorded = Record<string, { value: number; text: string }>;

/** Ascending, without duplicates. */
export function placesOf(runs: Recorded[], name: string): { value: number; text: string }[] {
  const known = new Map(runs.flatMap((r) => (r[name] ? [[r[name].value, r[name]] as const] : [])));
  return [...known.values()].sort((a, b) => a.value - b.value);
}

export function nearestTo(runs: Recorded[], from: number, name: string, value: number): number {
  const others = Object.keys(runs[from]).filter((other) => other !== name);
  const steps = (k: number): number =>
    others.reduce((sum, other) => {
      const places = placesOf(runs, other).map((p) => p.value);
      const place = (run: Recorded): number => places.indexOf(run[other]?.value);
      return sum + Math.abs(place(runs[k]) - place(runs[from]));
    }, 0);
  let best = from;
  runs.forEach((run, k) => {
    if (run[name]?.value !== value) return;
    if (runs[best][name]?.value !== value || steps(k) < steps(best)) best = k;
  });
  return best;
}
