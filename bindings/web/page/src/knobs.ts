// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders for a script's knobs, from a check or a run's manifest. A move updates the live script (live.ts);
// at rest, a recorded run with the new values replaces a current run.

import type { Api } from './api';
import { h, slider } from './dom';
import type { Followed } from './live';
import type { Run } from './run';
import { numberText, shareOf, withUnit } from './units';

export interface Knob {
  name: string;
  from: number; // SI
  to: number;
  value: number;
  log: boolean;
  unit: string;
}

const steps = 400; // of a slider
const rest = 250; // ms without a move
const restAlive = 900; // ms, live script

/** Knobs of an aborted run may lack bounds and get no slider. */
export function knobsIn(manifest: unknown): Knob[] {
  const members = (manifest as { knobs?: Record<string, Partial<Knob>> } | null)?.knobs ?? {};
  return Object.entries(members).flatMap(([name, k]) =>
    typeof k.value === 'number' && typeof k.from === 'number' && typeof k.to === 'number' && k.from < k.to
      ? [{ name, from: k.from, to: k.to, value: k.value, log: k.log === true && k.from > 0, unit: k.unit ?? '' }]
      : [],
  );
}

/** False for a run that was stopped before its start: it has no record. */
export async function readKnobs(run: Run, api: Api): Promise<boolean> {
  try {
    const manifest = async () => JSON.parse(await (await api.file(run.id, 'manifest.json')).text()) as unknown;
    if (run.knobs.length === 0) run.knobs = knobsIn(await manifest());
    return true;
  } catch {
    return false;
  }
}

/** The end positions give the exact bounds. */
export function placeOf(knob: Knob, value: number): number {
  return Math.round(steps * Math.min(1, Math.max(0, shareOf(value, [knob.from, knob.to], knob.log))));
}

export function valueAt(knob: Knob, place: number): number {
  if (place <= 0) return knob.from;
  if (place >= steps) return knob.to;
  const share = place / steps;
  const value = knob.log ? knob.from * (knob.to / knob.from) ** share : knob.from + share * (knob.to - knob.from);
  // To a quarter of a step; four digits if possible.
  const next = knob.log ? value * ((knob.to / knob.from) ** (1 / steps) - 1) : (knob.to - knob.from) / steps;
  const digits = Math.ceil(Math.log10((4 * Math.abs(value)) / next));
  return Math.min(knob.to, Math.max(knob.from, Number(value.toPrecision(Math.min(17, Math.max(4, digits))))));
}

export function knobText(knob: Knob, value = knob.value): string {
  return knob.unit ? withUnit(value, knob.unit) : numberText(value);
}

export class KnobsPane {
  readonly element = h('div.knobs', { role: 'group', 'aria-label': 'Knobs of the script', hidden: true });
  private of: Followed | undefined; // owner of the shown knobs
  private asked: Run | undefined; // manifest requested
  private current: Run | undefined;
  private knobs: Knob[] = [];
  private tell: (() => void)[] = []; // updates the values
  private timer = 0;
  private waiting = false; // moved; the current run is being stopped
  private starting = false;

  constructor(
    private readonly api: Api,
    private readonly actions: {
      again: (of: Followed, values: Record<string, string>) => Promise<boolean>; // true: started
      stop: () => Promise<void>;
      failed: (error: unknown) => void;
      keyOf: (run: Run) => string; // document key
      touched: (of: Followed) => void; // pointer or focus
      answering: () => boolean;
      follow: (of: Followed, values: Record<string, string>, began: number) => boolean; // false: not live
    },
  ) {}

  /** For every new or changed run. */
  show(run: Run | undefined): void {
    const news = run !== this.current;
    this.current = run;
    if (!run || run.live) return;
    if (news && run.script !== this.of?.script && run !== this.asked) {
      this.clear();
      this.asked = undefined;
    }
    if (run.active || run === this.asked) return;
    this.asked = run;
    if (this.waiting) this.go();
    else void this.fetch(run);
  }

  /** From the edited script; unchanged knobs keep their values. */
  know(of: Followed, told: unknown): void {
    const found = knobsIn({ knobs: told });
    if (of.script === this.of?.script || this.timer || this.starting || this.waiting) return;
    if (found.length === 0) {
      // A run's knobs stay with its results.
      if (this.of && this.of.script !== this.current?.script) this.clear();
      return;
    }
    for (const knob of found) {
      const had = this.knobs.find((k) => sameKnob(k, knob));
      if (had) knob.value = had.value;
    }
    this.fill(of, found);
  }

  private async fetch(run: Run): Promise<void> {
    if (!(await readKnobs(run, this.api)) || this.asked !== run) return;
    if (this.timer || this.starting || this.waiting) return;
    // After an early error, the user can go back.
    if (run.knobs.length === 0 && run.script === this.of?.script) return;
    const of = { script: run.script, name: run.name, key: this.actions.keyOf(run) };
    this.fill(of, run.knobs.map((k) => ({ ...k })));
  }

  private clear(): void {
    clearTimeout(this.timer);
    this.timer = 0;
    this.waiting = false;
    this.of = undefined;
    this.knobs = [];
    this.tell = [];
    this.element.hidden = true;
    this.element.replaceChildren();
  }

  private fill(of: Followed, knobs: Knob[]): void {
    const same = knobs.length === this.knobs.length && knobs.every((k, n) => sameKnob(k, this.knobs[n]));
    this.of = of;
    this.element.hidden = knobs.length === 0;
    if (same && this.element.childElementCount > 0) {
      // Keep the focused slider.
      this.knobs.forEach((k, n) => (k.value = knobs[n].value));
      this.tell.forEach((tell) => tell());
      return;
    }
    this.knobs = knobs;
    this.tell = [];
    this.element.replaceChildren(...knobs.map((k) => this.slider(k)));
  }

  private slider(knob: Knob): HTMLElement {
    const touched = (): void => {
      if (this.of) this.actions.touched(this.of);
    };
    const moved = (place: number, event: Event): void => {
      knob.value = valueAt(knob, place);
      made.tell(place, knobText(knob));
      this.moved(event.timeStamp);
    };
    const made = slider(knob.name, steps, moved, { onpointerenter: touched, onfocus: touched });
    const tell = (): void => made.tell(placeOf(knob, knob.value), knobText(knob));
    this.tell.push(tell);
    tell();
    return made.element;
  }

  private values(): Record<string, string> {
    return Object.fromEntries(this.knobs.map((k) => [k.name, String(k.value)]));
  }

  private moved(began: number): void {
    clearTimeout(this.timer);
    const follows = this.of !== undefined && this.actions.follow(this.of, this.values(), began);
    const rests = (): void => {
      this.timer = 0;
      if (follows && this.actions.answering()) this.timer = window.setTimeout(rests, restAlive);
      else this.go();
    };
    this.timer = window.setTimeout(rests, follows ? restAlive : rest);
  }

  private go(): void {
    this.waiting = this.starting; // the starting run checks again
    if (!this.starting) void this.begin();
  }

  private async begin(): Promise<void> {
    const of = this.of;
    if (!of) return;
    this.starting = true;
    try {
      const begun = await this.actions.again(of, this.values());
      if (begun && !this.waiting) return;
      // The end of the active run starts one with the present values.
      this.waiting = true;
      await this.actions.stop();
    } catch (error) {
      this.waiting = false;
      this.actions.failed(error);
    } finally {
      this.starting = false;
    }
    if (this.waiting && this.current?.active === false) this.go();
  }
}

/** Equal except for the value. */
function sameKnob(one: Knob, other: Knob): boolean {
  return JSON.stringify({ ...one, value: 0 }) === JSON.stringify({ ...other, value: 0 });
}
