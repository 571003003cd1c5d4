// SPDX-License-Identifier: GPL-3.0-or-later
// The script of a saved run: plays pictures and switches between recorded knob values. Without it, and on
// paper, all are shown in sequence.

import { slider } from '../dom';
import { Scrubber } from '../scrub';

const away = 'away'; // hidden on screen

/** Knob values of a run. */
type Recorded = Record<string, { value: number; text: string }>;

/** Ascending, without duplicates. */
function placesOf(runs: Recorded[], name: string): { value: number; text: string }[] {
  const known = new Map(runs.flatMap((r) => (r[name] ? [[r[name].value, r[name]] as const] : [])));
  return [...known.values()].sort((a, b) => a.value - b.value);
}

/** The run for a slider move: the new value, with the fewest steps in other knobs. */
function nearestTo(runs: Recorded[], from: number, name: string, value: number): number {
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

class Frames {
  private readonly figures: HTMLElement[];
  private readonly titles: string[];
  private readonly scrubber: Scrubber;
  at: number;

  constructor(element: HTMLElement) {
    this.figures = [...element.querySelectorAll<HTMLElement>(':scope > figure')];
    this.titles = this.figures.map((f) => f.dataset.title ?? '');
    this.at = this.figures.length - 1;
    this.scrubber = new Scrubber((place) => Promise.resolve(this.turn(place)), element.dataset.name);
    element.prepend(this.scrubber.element);
    this.show(this.at);
  }

  show(at: number): void {
    this.turn(Math.min(at, this.figures.length - 1));
    this.scrubber.show(this.titles, this.at);
  }

  private turn(place: number): void {
    this.at = place;
    this.figures.forEach((f, k) => f.classList.toggle(away, k !== place));
  }
}

const sections = [...document.querySelectorAll<HTMLElement>('.results')];
const frames = sections.map((s) => [...s.querySelectorAll<HTMLElement>('.frames')].map((e) => new Frames(e)));
const recorded = sections.map((s) => JSON.parse(s.dataset.at ?? '{}') as Recorded);
let shown = Math.max(0, sections.findIndex((s) => s.dataset.first !== undefined));

function show(next: number): void {
  frames[shown].forEach((f, k) => frames[next][k]?.show(f.at));
  shown = next;
  sections.forEach((s, k) => s.classList.toggle(away, k !== next));
}

function knobSlider(name: string): { element: HTMLElement; tell: () => void } {
  const places = placesOf(recorded, name);
  const { element, tell } = slider(name, places.length - 1, (place) => {
    show(nearestTo(recorded, shown, name, places[place].value));
    sliders.forEach((s) => s.tell());
  });
  return {
    element,
    tell: () => {
      const at = places.findIndex((p) => p.value === recorded[shown][name]?.value);
      const text = places[at]?.text ?? '';
      tell(at, text, `${text}, ${at + 1} of ${places.length} that were recorded`);
    },
  };
}

const moved = Object.keys(recorded[0] ?? {}).filter((name) => placesOf(recorded, name).length > 1);
const sliders = sections.length > 1 ? moved.map(knobSlider) : [];
document.querySelector('.sliders')?.append(...sliders.map((s) => s.element));
if (sliders.length > 0) show(shown);
sliders.forEach((s) => s.tell());
