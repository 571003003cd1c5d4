// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders for the knobs of a run, above its results. A knob that is moved runs the script of that run again
// with the new values, as a run of its own: what the sliders say when a hand rests is what is run, and a run
// that goes on by then is stopped for it. Bounds and values are those that the run recorded in its manifest.

import type { Api } from './api';
import { h } from './dom';
import type { Run } from './run';
import { numberText, withUnit } from './units';

export interface Knob {
  name: string;
  from: number; // SI, as all values
  to: number;
  value: number;
  log: boolean;
  unit: string;
}

const steps = 400; // of a slider
const rest = 250; // ms without a move after which the script is run

/** The knobs of a manifest; a run that was cut off may know a value alone, which has no slider. */
export function knobsIn(manifest: unknown): Knob[] {
  const members = (manifest as { knobs?: Record<string, Partial<Knob>> } | null)?.knobs ?? {};
  return Object.entries(members).flatMap(([name, k]) =>
    typeof k.value === 'number' && typeof k.from === 'number' && typeof k.to === 'number' && k.from < k.to
      ? [{ name, from: k.from, to: k.to, value: k.value, log: k.log === true && k.from > 0, unit: k.unit ?? '' }]
      : [],
  );
}

/** Where a value stands on the slider, and the value there; the ends are the bounds to the bit. */
export function placeOf(knob: Knob, value: number): number {
  const share = knob.log
    ? Math.log(value / knob.from) / Math.log(knob.to / knob.from)
    : (value - knob.from) / (knob.to - knob.from);
  return Math.round(steps * Math.min(1, Math.max(0, share)));
}

export function valueAt(knob: Knob, place: number): number {
  if (place <= 0) return knob.from;
  if (place >= steps) return knob.to;
  const share = place / steps;
  const value = knob.log ? knob.from * (knob.to / knob.from) ** share : knob.from + share * (knob.to - knob.from);
  // Round to a quarter of a step at most, of four digits where that will do.
  const next = knob.log ? value * ((knob.to / knob.from) ** (1 / steps) - 1) : (knob.to - knob.from) / steps;
  const digits = Math.ceil(Math.log10((4 * Math.abs(value)) / next));
  return Math.min(knob.to, Math.max(knob.from, Number(value.toPrecision(Math.min(17, Math.max(4, digits))))));
}

export function knobText(knob: Knob, value = knob.value): string {
  return knob.unit ? withUnit(value, knob.unit) : numberText(value);
}

export class KnobsPane {
  readonly element = h('div', { className: 'knobs', role: 'group', 'aria-label': 'Knobs of this run', hidden: true });
  private run: Run | undefined; // whose knobs are shown
  private asked: Run | undefined; // whose manifest was asked for
  private current: Run | undefined; // the last that was shown
  private knobs: Knob[] = [];
  private tell: (() => void)[] = []; // shows each knob's value
  private timer = 0;
  private waiting = false; // moved while a run went on, which is being stopped
  private starting = false;

  constructor(
    private readonly api: Api,
    private readonly actions: {
      again: (run: Run, values: Record<string, string>) => Promise<boolean>; // whether it was begun
      stop: () => Promise<void>;
      failed: (error: unknown) => void;
    },
  ) {}

  /** Called whenever a run is shown or has changed. */
  show(run: Run | undefined): void {
    if (!run || (run.script !== this.run?.script && run !== this.asked)) this.clear();
    this.current = run;
    if (!run || run.active || run === this.asked) return;
    this.asked = run;
    if (this.waiting) this.go();
    else void this.fetch(run);
  }

  private async fetch(run: Run): Promise<void> {
    try {
      const manifest = JSON.parse(await (await this.api.file(run.id, 'manifest.json')).text()) as unknown;
      const found = knobsIn(manifest);
      run.knobs = found.map((k) => ({ ...k }));
      if (this.asked !== run || this.timer || this.starting || this.waiting) return;
      // After a mistake early on, the sliders that were there stay, so that the value can be taken back.
      if (found.length > 0 || run.script !== this.run?.script) this.fill(run, found);
    } catch {
      // A run that was stopped before it began has no record.
    }
  }

  private clear(): void {
    clearTimeout(this.timer);
    this.timer = 0;
    this.waiting = false;
    this.run = undefined;
    this.knobs = [];
    this.tell = [];
    this.element.hidden = true;
    this.element.replaceChildren();
  }

  private fill(run: Run, knobs: Knob[]): void {
    const same = JSON.stringify(knobs.map((k) => ({ ...k, value: 0 })));
    const had = JSON.stringify(this.knobs.map((k) => ({ ...k, value: 0 })));
    this.run = run;
    this.element.hidden = knobs.length === 0;
    if (same === had && this.element.childElementCount > 0) {
      // The slider that has the focus is not taken from under the hand.
      this.knobs.forEach((k, n) => (k.value = knobs[n].value));
      this.tell.forEach((tell) => tell());
      return;
    }
    this.knobs = knobs;
    this.tell = [];
    this.element.replaceChildren(...knobs.map((k) => this.slider(k)));
  }

  private slider(knob: Knob): HTMLElement {
    const text = (): string => knobText(knob);
    const value = h('output', { className: 'factor' });
    const input = h('input', {
      type: 'range',
      min: '0',
      max: String(steps),
      step: '1',
      'aria-label': knob.name,
      oninput: () => {
        knob.value = valueAt(knob, Number(input.value));
        say();
        this.moved();
      },
    });
    const say = (): void => {
      value.textContent = text();
      input.setAttribute('aria-valuetext', text());
    };
    this.tell.push(() => {
      input.value = String(placeOf(knob, knob.value));
      say();
    });
    this.tell[this.tell.length - 1]();
    return h('label', { className: 'choice' }, h('span', {}, knob.name), input, value);
  }

  private moved(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => {
      this.timer = 0;
      this.go();
    }, rest);
  }

  private go(): void {
    this.waiting = this.starting; // the one that starts now looks again
    if (!this.starting) void this.begin();
  }

  private async begin(): Promise<void> {
    const run = this.run;
    if (!run) return;
    const values = Object.fromEntries(this.knobs.map((k) => [k.name, String(k.value)]));
    this.starting = true;
    try {
      const begun = await this.actions.again(run, values);
      if (begun && !this.waiting) return;
      // A run goes on whose values are not those of the sliders: its end begins one with what they say then.
      this.waiting = true;
      await this.actions.stop();
    } catch (error) {
      this.waiting = false;
      this.actions.failed(error);
    } finally {
      this.starting = false;
    }
    // It may have ended while it was being stopped.
    if (this.waiting && this.current?.active === false) this.go();
  }
}
