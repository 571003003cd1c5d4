// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders for a script's knobs, from a check or a run's manifest. A move updates the live script (live.ts);
// at rest, a recorded run with the new values replaces a current run.

import type { Api } from './api';
import { h } from './dom';
import type { Followed } from './live';
import { quantityIn, QuantityError } from './quantity';
import type { Run } from './run';
import { numberText, sameToRounding, withUnit } from './units';

export interface Knob {
  name: string;
  from: number; // SI
  to: number;
  value: number;
  log: boolean;
  unit: string;
}

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

/** The largest of …, 1, 2, 5, 10, … up to `size`. */
function stepUpTo(size: number): number {
  const power = 10 ** Math.floor(Math.log10(size * (1 + 1e-9)));
  const most = (size / power) * (1 + 1e-9);
  return (most >= 5 ? 5 : most >= 2 ? 2 : 1) * power;
}

const stepsByRatio = ({ from, to, log }: Knob): boolean => log && to >= 5 * from;

/** Round values of the slider and both bounds. Steps are 1, 2 or 5 times a power of ten: a hundredth of a linear
    slider, 4 to 10 % of a logarithmic value. */
function stopsOf(knob: Knob): number[] {
  const { from, to } = knob;
  const stops = [from];
  for (let at = from; at < to; stops.push(at)) {
    const step = stepUpTo(stepsByRatio(knob) ? at / 10 : (to - from) / 100);
    const next = Number(((Math.floor(at / step + 1e-6) + 1) * step).toPrecision(14));
    at = next > at && next < to && !sameToRounding(next, to) ? next : to;
  }
  return stops;
}

/** The next value of an arrow key: 1, 2, 5, 10, … of a logarithmic knob, a tenth of a linear one. */
function keyed(knob: Knob, stops: number[], up: boolean): number {
  const { from, to, value } = knob;
  const step = stepUpTo((to - from) / 10);
  const round = (v: number): number => (stepsByRatio(knob) ? stepUpTo(v) : Math.round(v / step) * step);
  const main = (v: number): boolean => v === from || v === to || Math.abs(round(v) - v) <= 1e-6 * Math.abs(v);
  const beyond = (v: number): boolean => main(v) && (up ? v > value : v < value);
  return stops.filter(beyond).at(up ? 0 : -1) ?? value;
}

function placeOf(stops: number[], value: number): number {
  const away = stops.map((s) => Math.abs(s - value));
  return away.indexOf(Math.min(...away));
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
      known: (run: Run) => void; // its knobs have come
      touched: (of: Followed) => void; // pointer or focus
      answering: () => boolean;
      follow: (of: Followed, knobs: Knob[], began: number) => boolean; // false: not live
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
    if (!(await readKnobs(run, this.api))) return;
    if (run.knobs.length > 0) this.actions.known(run);
    if (this.asked !== run) return;
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
    const stops = stopsOf(knob);
    const set = (value: number, began: number): void => {
      knob.value = value;
      tell(true);
      this.moved(began);
    };
    const touched = (): void => {
      if (this.of) this.actions.touched(this.of);
    };
    const range = h('input', {
      type: 'range',
      min: '0',
      max: String(stops.length - 1),
      'aria-label': knob.name,
      onpointerenter: touched,
      onfocus: touched,
      oninput: (event: Event) => set(stops[Number(range.value)], event.timeStamp),
      onkeydown: (event: KeyboardEvent) => {
        const up = { ArrowRight: true, ArrowUp: true, ArrowLeft: false, ArrowDown: false }[event.key];
        if (up === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
        event.preventDefault();
        const value = keyed(knob, stops, up);
        if (value !== knob.value) set(value, event.timeStamp);
      },
    });
    const problem = h('p.problem', { id: `knob-${this.tell.length}`, role: 'status', hidden: true });
    const field = h('input', {
      type: 'text',
      autocomplete: 'off',
      spellcheck: false,
      'aria-label': `${knob.name}, as a number`,
      'aria-describedby': problem.id,
      onfocus: () => (touched(), field.select()),
      onchange: (event: Event) => {
        try {
          const value = typed(knob, field.value);
          tell(true);
          if (value !== knob.value) set(value, event.timeStamp);
        } catch (error) {
          if (!(error instanceof QuantityError)) throw error;
          complain(error.message);
        }
      },
      onkeydown: (event: KeyboardEvent) => event.key === 'Escape' && tell(true),
    });
    const complain = (words: string): void => {
      problem.textContent = words;
      problem.hidden = words === '';
      field.setAttribute('aria-invalid', String(words !== ''));
    };
    let written = '';
    const tell = (over = false): void => {
      range.value = String(placeOf(stops, knob.value));
      range.setAttribute('aria-valuetext', knobText(knob));
      // A number that is being typed stays.
      if (!over && document.activeElement === field && field.value !== written) return;
      field.value = written = knobText(knob);
      complain('');
    };
    this.tell.push(tell);
    tell();
    return h('div.knob', h('span', { title: knob.name }, knob.name), range, field, problem);
  }

  /** Pointer or keyboard is at a slider. */
  get held(): boolean {
    return this.element.querySelector('input[type=range]:is(:hover, :active, :focus-visible)') !== null;
  }

  private moved(began: number): void {
    clearTimeout(this.timer);
    const knobs = this.knobs.map((k) => ({ ...k }));
    const follows = this.of !== undefined && this.actions.follow(this.of, knobs, began);
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
      const begun = await this.actions.again(of, valuesOf(this.knobs));
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

export function valuesText(knobs: Knob[]): string {
  return knobs.map((k) => `${k.name} ${knobText(k)}`).join(', ');
}

/** As the server takes them. */
export function valuesOf(knobs: Knob[]): Record<string, string> {
  return Object.fromEntries(knobs.map((k) => [k.name, String(k.value)]));
}

function typed(knob: Knob, text: string): number {
  const value = quantityIn(text, knob.unit, knob.value);
  if (value >= knob.from && value <= knob.to) return value;
  const [shown, from, to] = [value, knob.from, knob.to].map((v) => knobText(knob, v));
  throw new QuantityError(`${shown} is out of bounds. Give ${knob.name} from ${from} to ${to}.`);
}

/** Equal except for the value. */
function sameKnob(one: Knob, other: Knob): boolean {
  return JSON.stringify({ ...one, value: 0 }) === JSON.stringify({ ...other, value: 0 });
}
