// SPDX-License-Identifier: GPL-3.0-or-later
// The only script in a saved run: plays pictures and switches between recorded knob values. Without it, and
// on paper, all are shown in sequence.

import { h } from '../dom';
import { Scrubber } from '../scrub';
import { nearestTo, placesOf, type Recorded } from './places';

const away = 'away'; // hidden on screen

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

function slider(name: string): { element: HTMLElement; tell: () => void } {
  const places = placesOf(recorded, name);
  const value = h('output', { className: 'factor' });
  const input = h('input', {
    type: 'range',
    min: '0',
    max: String(places.length - 1),
    step: '1',
    'aria-label': name,
    oninput: () => {
      show(nearestTo(recorded, shown, name, places[Number(input.value)].value));
      sliders.forEach((s) => s.tell());
    },
  });
  const tell = (): void => {
    const at = places.findIndex((p) => p.value === recorded[shown][name]?.value);
    const text = places[at]?.text ?? '';
    input.value = String(at);
    input.setAttribute('aria-valuetext', `${text}, ${at + 1} of ${places.length} that were recorded`);
    value.textContent = text;
  };
  return { element: h('label', { className: 'choice' }, h('span', {}, name), input, value), tell };
}

const moved = Object.keys(recorded[0] ?? {}).filter((name) => placesOf(recorded, name).length > 1);
const sliders = sections.length > 1 ? moved.map(slider) : [];
document.querySelector('.sliders')?.append(...sliders.map((s) => s.element));
if (sliders.length > 0) show(shown);
sliders.forEach((s) => s.tell());
