// SPDX-License-Identifier: GPL-3.0-or-later
// Scripts between a teacher and students: the teacher hands one to the room, and each student's page offers it.

import type { Api, SharedScript } from './api';
import { byId, h } from './dom';
import { keep, kept } from './storage';

const askedAgain = 4000; // ms

/** A script to be sent; a longer one is cut. */
export function sent(title: string, text: string, most = Infinity): SharedScript {
  const script = text.length > most ? `${text.slice(0, most)}\n-- The rest is cut.\n` : text;
  return { name: title.slice(0, 60), script };
}

/** A student's page: offers the newest script of the teacher, and lists it above the lessons. */
export class Offer {
  readonly entry = h('button.own', { hidden: true, onclick: () => this.take() });
  private readonly bar = byId('offer');
  private number = 0;
  private script: SharedScript | undefined;
  private timer = 0;

  constructor(
    private readonly api: Api,
    private readonly open: (number: number, script: SharedScript) => void,
  ) {}

  begin(student: boolean): void {
    clearInterval(this.timer);
    if (!student) return;
    this.timer = window.setInterval(() => void this.ask(), askedAgain);
    void this.ask();
  }

  private async ask(): Promise<void> {
    if (document.hidden) return;
    const answer = await this.api.handed(this.number).catch(() => undefined); // others report a lost server
    if (!answer || answer.number === this.number) return;
    const { number, name, script } = answer;
    this.number = number;
    this.script = name !== undefined && script !== undefined ? { name, script } : undefined;
    this.entry.hidden = !this.script;
    this.entry.replaceChildren(h('strong', name ?? ''), h('span', 'From your teacher.'));
    this.bar.hidden = !this.script || kept('offered') === String(number);
    this.bar.replaceChildren(
      h('p', 'Your teacher sent ', h('strong', name ?? ''), '. Your own scripts stay as they are.'),
      h('button.primary', { onclick: () => this.take() }, 'Open'),
      h('button', { onclick: () => this.seen() }, 'Not now'),
    );
  }

  private seen(): void {
    keep('offered', String(this.number));
    this.bar.hidden = true;
  }

  private take(): void {
    this.seen();
    if (this.script) this.open(this.number, this.script);
  }
}

/** The teacher's button, and the line of the room that takes the script back. */
export class HandButton {
  private readonly button = byId<HTMLButtonElement>('hand');
  private readonly line = byId('room-handed');

  constructor(
    private readonly api: Api,
    private readonly script: () => SharedScript,
    private readonly failed: (error: unknown) => void,
  ) {
    this.button.addEventListener('click', () => this.hand(this.script()));
  }

  offer(teacher: boolean): void {
    this.button.hidden = !teacher;
    if (teacher) this.api.handed(0).then(({ name }) => this.show(name), this.failed);
  }

  /** After a change of the script. */
  forget(): void {
    this.button.textContent = 'Hand out';
  }

  private hand(script?: SharedScript): void {
    const handed = (): void => {
      this.show(script?.name);
      this.button.textContent = script ? 'Handed out' : 'Hand out';
    };
    this.api.hand(script).then(handed).catch(this.failed);
  }

  private show(name: string | undefined): void {
    const back = h('button', { onclick: () => this.hand() }, 'Take it back');
    this.line.replaceChildren(h('span', name ? `Handed out: ${name}` : 'No script is handed out.'), name ? back : '');
  }
}
