// SPDX-License-Identifier: GPL-3.0-or-later
// 3-D pictures of views; flat maps without WebGL. Maps are fetched when shown.

import type { Api } from './api';
import { coloursOf, drawFlat, inkNow, legend, rangeOf } from './colour';
import { Choice, h, slider } from './dom';
import { drawingsOf, type Drawing } from './drawings';
import {
  anchorText,
  captionOf,
  describe,
  exaggerations,
  factorText,
  fieldsOf,
  fittingExaggeration,
  reliefFields,
  resting,
  type Attitude,
  type Field,
} from './pictures';
import type { LivePicture, LookedAt } from './live';
import type { Run } from './run';
import type { ReliefScene } from './scene';
import { Scrubber } from './scrub';

const fetched = 24; // in memory
const rested = 350; // ms without a move

export class PicturePane {
  private run: Run | undefined;
  private readonly maps = new Map<string, Promise<Field[]>>();
  private fields: Field[] = [];
  private shown = '';
  private followed = true;
  private colour: Field | undefined;
  private relief: Field | undefined;
  private step = 0;
  private attitude: Attitude = { ...resting };
  private scene: ReliefScene | undefined;
  private flat = false;
  private pending = false;
  private kept = ''; // view in the previous run
  private began: number | undefined; // the event behind a picture
  private first: Field | undefined; // of a live picture, before its other maps
  private room = { width: 120, height: 120 }; // px, of the stage
  private along = 0; // px, of the colour key
  private readonly which = new Choice('Picture', (name) => {
    this.scrubber.pause();
    void this.choose(name);
  });
  private readonly scrubber = new Scrubber((place) => this.choose(this.run?.views[place]?.name ?? this.shown));
  private readonly colourChoice = new Choice('Colour', (name) => this.pick(name, this.relief?.name ?? 'flat'));
  private readonly reliefChoice = new Choice('Relief', (name) => this.pick(this.colour?.name ?? '', name));
  private readonly exaggerate = slider('Heights', exaggerations.length - 1, (step) => {
    this.step = step;
    this.draw();
  });
  private readonly canvas = h('canvas.relief', { tabIndex: 0, role: 'img' });
  private readonly map = h('canvas.relief.moving', { hidden: true, 'aria-hidden': 'true' });
  private readonly labels = h('div.labels', { 'aria-hidden': 'true' });
  private readonly key = h('div.key');
  private readonly caption = h('p.caption', { id: 'picture-caption' });
  private readonly leftOut = h('p.caption.left-out', { hidden: true });
  private readonly name = h('p.tag.name', { 'aria-hidden': 'true' });
  private readonly stage = h('div.stage', this.canvas, this.map, this.labels, this.name);
  private readonly body: HTMLElement;
  private readonly empty = h('p.empty');

  constructor(
    readonly element: HTMLElement,
    private readonly api: Api,
    private readonly failed: (error: unknown) => void,
    private readonly held: () => boolean, // a slider is in use
  ) {
    const reset = h('button', { onclick: () => this.turn({ ...resting }) }, 'Oblique');
    const above = h('button', { onclick: () => this.turn({ turn: 0, tilt: 89.9, zoom: 1 }) }, 'Above');
    this.body = h('div.pictures', { hidden: true },
      this.stage,
      this.key,
      this.caption,
      h('div.below',
        this.scrubber.element,
        h('details.view',
          h('summary', 'View'),
          h('div.choices',
            this.which.element,
            this.colourChoice.element,
            this.reliefChoice.element,
            this.exaggerate.element,
            reset,
            above,
            h('p', 'Drag the picture, or use the arrow keys.'),
            this.leftOut,
          ),
        ),
      ),
    );
    element.append(this.empty, this.body);
    this.listen();
    // Reading a size would lay the page out again.
    const observer = new ResizeObserver((entries) => {
      for (const { target, contentRect } of entries)
        if (target === this.key) this.along = contentRect.width;
        else this.room = { width: Math.max(120, contentRect.width), height: Math.max(120, contentRect.height) };
      this.draw();
    });
    for (const part of [this.stage, this.key]) observer.observe(part);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.draw());
  }

  show(run: Run | undefined): void {
    if (run !== this.run) {
      this.take(run);
      this.scrubber.pause();
      this.maps.clear();
      this.shown = '';
      this.followed = true;
      this.body.hidden = true;
    }
    const views = run?.views ?? [];
    this.empty.hidden = views.length > 0;
    this.empty.textContent = run?.active
      ? 'No surface or contact yet.'
      : 'Surfaces and contacts that a script makes are drawn here: run one that presses or generates a surface.';
    this.body.hidden = views.length === 0;
    if (views.length === 0) return;
    this.leftOut.hidden = !run?.viewsLeftOut;
    if (run) this.leftOut.textContent = leftOutText(run);
    const last = views[views.length - 1].name;
    const name = this.followed ? last : this.shown || this.kept || last;
    this.which.choose(views.map((v) => ({ value: v.name, text: v.title })), name);
    this.scrubber.show(views.map((v) => v.title), views.findIndex((v) => v.name === name));
    if (name !== this.shown && this.visible) void this.look(name);
  }

  get lookedAt(): LookedAt {
    return { view: this.followed ? '' : this.shown, map: this.colour?.name ?? '' };
  }

  /** Other values: the old picture stays until the new one arrives. */
  succeed(run: Run, picture?: LivePicture, began?: number): void {
    this.scrubber.pause();
    this.take(run);
    this.maps.clear();
    if (picture) this.maps.set(picture.name, picture.fields);
    this.first = picture?.first;
    this.kept = run.views.some((v) => v.name === this.shown) ? this.shown : '';
    this.shown = '';
    this.began = began;
    if (began !== undefined || (!this.map.hidden && this.held())) this.flatten();
    else this.map.hidden = true;
    this.show(run);
  }

  private take(run: Run | undefined): void {
    if (run?.script !== this.run?.script) {
      // Another script needs its own exaggeration.
      this.fields = [];
      this.colour = this.relief = undefined;
    }
    this.run = run;
  }

  private resting = 0;

  /** A relief is too slow while a slider is in use: until then the map is flat. */
  private flatten(): void {
    this.map.hidden = false;
    clearTimeout(this.resting);
    this.resting = window.setTimeout(() => {
      if (this.held()) return this.flatten();
      this.map.hidden = true;
      this.draw();
    }, rested);
  }

  appear(): void {
    this.show(this.run);
    this.drawSoon(false);
  }

  private get visible(): boolean {
    return !this.element.hidden;
  }

  private fetch(name: string): Promise<Field[]> {
    const known = this.maps.get(name);
    if (known) return known;
    const { id, live } = this.run!;
    const coming = live ? live.fields(name) : this.api.view(id, name).then(fieldsOf);
    coming.catch(() => this.maps.delete(name));
    this.maps.set(name, coming);
    if (this.maps.size > fetched) this.maps.delete(this.maps.keys().next().value!);
    return coming;
  }

  /** After the last picture, the pane follows new ones. */
  private async choose(name: string): Promise<void> {
    this.followed = name === this.run?.views[this.run.views.length - 1]?.name;
    await this.look(name);
    this.show(this.run);
  }

  private async look(name: string): Promise<void> {
    this.shown = name;
    const { run, first, colour: old } = this;
    this.first = undefined;
    const alike = first?.name === old?.name && first?.nx === old?.nx && first?.ny === old?.ny;
    if (first && alike && !this.map.hidden) {
      this.colour = first;
      this.draw();
    }
    try {
      const [fields] = await Promise.all([this.fetch(name), this.prepare()]);
      if (this.run !== run || this.shown !== name) return;
      if (fields.length === 0) return void this.maps.delete(name);
      const before = { colour: this.colour?.name, relief: this.relief?.name };
      const same = this.fields.length > 0 && this.fields.map((f) => f.name).join() === fields.map((f) => f.name).join();
      this.fields = fields;
      this.colourChoice.choose(fields.map((f) => f.name), '');
      this.reliefChoice.choose([...reliefFields(fields).map((f) => f.name), { value: 'flat', text: 'flat map' }], '');
      const colour = (same && before.colour) || (fields.find((f) => f.name === 'pressure') ?? fields[0]).name;
      const relief = (same && (before.relief ?? 'flat')) || reliefFields(fields)[0]?.name || 'flat';
      this.pick(colour, relief);
    } catch (error) {
      if (this.run === run) this.failed(error);
    }
  }

  private pick(colour: string, relief: string): void {
    const previous = this.relief;
    const drawn = this.colour?.values;
    this.colour = this.fields.find((f) => f.name === colour) ?? this.fields[0];
    this.relief = reliefFields(this.fields).find(
      (f) => f.name === relief && f.nx === this.colour!.nx && f.ny === this.colour!.ny,
    );
    this.colourChoice.select.value = this.colour.name;
    this.reliefChoice.select.value = this.relief?.name ?? 'flat';
    // Equal reliefs share a factor for comparison.
    if (this.relief && previous?.name !== this.relief.name) this.step = fittingExaggeration(this.relief);
    if (this.map.hidden || this.colour.values !== drawn) this.draw();
  }

  private async prepare(): Promise<void> {
    if (this.scene || this.flat) return;
    const { ReliefScene: Made } = await import('./scene');
    if (this.scene) return;
    try {
      this.scene = new Made(this.canvas);
    } catch {
      this.flat = true; // no WebGL here
      const fresh = this.canvas.cloneNode() as HTMLCanvasElement;
      this.canvas.replaceWith(fresh);
      Object.defineProperty(this, 'canvas', { value: fresh });
    }
  }

  private turn(attitude: Attitude): void {
    this.attitude = attitude;
    this.drawSoon(false);
  }

  /** A flat map is built at once, so that the next frame only paints it. */
  private draw(): void {
    const now = !this.map.hidden && this.visible && this.colour !== undefined;
    if (now) this.build();
    this.drawSoon(!now);
  }

  private rebuilt = false;

  private drawSoon(rebuild: boolean): void {
    this.rebuilt ||= rebuild;
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      if (!this.colour || !this.visible) return;
      if (this.rebuilt) this.build();
      this.rebuilt = false;
      this.render();
      if (this.began !== undefined) this.painted(this.began);
      this.began = undefined;
    });
  }

  private build(): void {
    const colour = this.colour!;
    const ink = inkNow();
    const { width, height } = this.room;
    const along = Math.max(240, this.along);
    const range = rangeOf(colour.name, colour.values);
    const factor = exaggerations[this.step];
    this.exaggerate.tell(this.step, this.relief ? factorText(factor) : '', factorText(factor));
    this.exaggerate.input.disabled = !this.relief;
    this.exaggerate.input.setAttribute('aria-label', 'Exaggeration of heights');
    const flat = this.map.hidden ? 'flat map' : 'flat map while the slider is in use';
    this.caption.textContent =
      captionOf(colour, this.flat || !this.map.hidden ? undefined : this.relief, factor).replace('flat map', flat) +
      (this.run?.live?.part === 'coarse' ? ' · coarse, the whole follows' : '') +
      (this.flat ? ' · this browser has no WebGL, so nothing can be turned' : '');
    this.canvas.setAttribute(
      'aria-label',
      `${[this.title(), describe(colour)].filter(Boolean).join(': ')}. ${this.caption.textContent}. Arrow keys turn it.`,
    );
    const colours = coloursOf(colour.name, colour.values, range);
    this.name.textContent = this.title();
    this.key.replaceChildren(legend(colour.name, colour.unit, range, along, ink.text));
    if (this.flat || !this.map.hidden) {
      drawFlat(this.flat ? this.canvas : this.map, colour, colours);
      this.labels.replaceChildren();
      return;
    }
    this.scene!.setInk(ink.muted);
    this.scene!.resize(width, height, Math.min(2, devicePixelRatio));
    this.scene!.show(colour, this.relief, colours, factor);
  }

  private render(): void {
    if (!this.scene || !this.map.hidden) return;
    this.scene.render(this.attitude);
    const { width, height } = this.room;
    const tags = this.scene.anchors(width, height).map(({ name, left, top, outward }) => {
      const tag = h('span.tag', anchorText(name, this.colour!, this.relief));
      // Inside the stage.
      const [least, most] = [name === 'z' ? 34 : outward < 0 ? 80 : 0, width - (outward < 0 ? 0 : 80)];
      const shift = name === 'z' ? '-60%, 4px' : `${outward < 0 ? '-100%' : '0'}, 10px`;
      Object.assign(tag.style, {
        left: `${Math.min(most, Math.max(least, left))}px`,
        top: `${top}px`,
        transform: `translate(${shift})`,
      });
      return tag;
    });
    this.labels.replaceChildren(...tags);
  }

  private painted(began: number): void {
    const channel = new MessageChannel();
    channel.port1.onmessage = () => {
      performance.clearMeasures('asperity-live');
      performance.measure('asperity-live', { start: began, end: performance.now(), detail: this.run?.live?.part });
    };
    channel.port2.postMessage(0);
  }

  private title(): string {
    const name = this.shown || this.kept; // until the next arrives
    return this.run?.views.find((v) => v.name === name)?.title ?? name;
  }

  private listen(): void {
    let from: { x: number; y: number; at: Attitude } | undefined;
    this.stage.addEventListener('pointerdown', (event) => {
      from = { x: event.clientX, y: event.clientY, at: this.attitude };
      this.stage.setPointerCapture(event.pointerId);
    });
    this.stage.addEventListener('pointermove', (event) => {
      if (!from) return;
      const turn = from.at.turn - (event.clientX - from.x) * 0.5;
      this.turn(limited({ ...from.at, turn, tilt: from.at.tilt + (event.clientY - from.y) * 0.4 }));
    });
    for (const end of ['pointerup', 'pointercancel'] as const)
      this.stage.addEventListener(end, () => (from = undefined));
    this.stage.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        this.turn(limited({ ...this.attitude, zoom: this.attitude.zoom * Math.exp(-event.deltaY * 0.001) }));
      },
      { passive: false },
    );
    this.stage.addEventListener('keydown', (event) => {
      const a = this.attitude;
      const moved: Record<string, Attitude> = {
        ArrowLeft: { ...a, turn: a.turn + 10 },
        ArrowRight: { ...a, turn: a.turn - 10 },
        ArrowUp: { ...a, tilt: a.tilt + 8 },
        ArrowDown: { ...a, tilt: a.tilt - 8 },
        '+': { ...a, zoom: a.zoom * 1.15 },
        '=': { ...a, zoom: a.zoom * 1.15 },
        '-': { ...a, zoom: a.zoom / 1.15 },
        Home: { ...resting },
      };
      if (!(event.key in moved) || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      this.turn(limited(moved[event.key]));
    });
  }

  /** The last views of a run, from the present attitude. `steps`: exaggeration by relief name. */
  drawings(run: Run, most: number, steps: Map<string, number>): Promise<Drawing[]> {
    if (this.relief) steps.set(this.relief.name, this.step);
    const fields = (name: string): Promise<Field[]> =>
      run === this.run ? this.fetch(name) : this.api.view(run.id, name).then(fieldsOf);
    return drawingsOf(run.views.slice(-most), fields, this.attitude, steps);
  }
}

export function leftOutText(run: Run): string {
  return `${run.viewsLeftOut} more were made and not drawn, so as not to hold up the run.`;
}

function limited(a: Attitude): Attitude {
  return { turn: a.turn % 360, tilt: Math.min(89.9, Math.max(-20, a.tilt)), zoom: Math.min(8, Math.max(0.5, a.zoom)) };
}
