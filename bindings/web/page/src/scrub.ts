// SPDX-License-Identifier: GPL-3.0-or-later
// Slider and play button for pictures; skips late ones. Hidden below two pictures.

import { h } from './dom';

const playedFor = 700; // ms each, at least

export class Scrubber {
  readonly element: HTMLElement;
  private titles: string[] = [];
  private at = 0;
  private wanted: number | undefined;
  private moving = false;
  private playing = false;
  private timer = 0;
  private readonly slider = h('input.scrub', { type: 'range', min: '0', step: '1', oninput: () => this.slid() });
  private readonly button = h('button', { onclick: () => this.toggle() }, 'Play');
  private readonly place = h('output.factor');

  /** `go` resolves when the picture is drawn or refused. */
  constructor(
    private readonly go: (place: number) => Promise<void>,
    private readonly label = 'Picture of the run',
  ) {
    this.element = h('div.scrubber', { hidden: true }, this.button, this.slider, this.place);
  }

  show(titles: string[], at: number): void {
    this.titles = titles;
    this.element.hidden = titles.length < 2;
    if (this.element.hidden) this.pause();
    this.slider.max = String(Math.max(0, titles.length - 1));
    if (!this.moving) this.tell(Math.max(0, at));
  }

  pause(): void {
    clearTimeout(this.timer);
    this.playing = false;
    this.button.textContent = 'Play';
  }

  private slid(): void {
    this.pause();
    void this.move(Number(this.slider.value));
  }

  private toggle(): void {
    if (this.playing) return this.pause();
    this.playing = true;
    this.button.textContent = 'Pause';
    void this.step(this.at >= this.titles.length - 1 ? 0 : this.at + 1);
  }

  private async step(place: number): Promise<void> {
    await this.move(place);
    if (!this.playing) return;
    this.timer = window.setTimeout(() => {
      if (this.at >= this.titles.length - 1 || this.element.offsetParent === null) this.pause();
      else void this.step(this.at + 1);
    }, playedFor);
  }

  private async move(place: number): Promise<void> {
    this.tell(place);
    this.wanted = place;
    if (this.moving) return;
    this.moving = true;
    try {
      while (this.wanted !== undefined) {
        const next = this.wanted;
        this.wanted = undefined;
        await this.go(next);
      }
    } finally {
      this.moving = false;
    }
  }

  private tell(at: number): void {
    this.at = at;
    const where = `${at + 1} of ${this.titles.length}`;
    this.slider.value = String(at);
    this.slider.setAttribute('aria-label', this.label);
    this.slider.setAttribute('aria-valuetext', `${where}: ${this.titles[at] ?? ''}`);
    this.place.textContent = where;
  }
}
