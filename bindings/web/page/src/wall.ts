// SPDX-License-Identifier: GPL-3.0-or-later
// The predictions of the class in the whole window, for everybody to see: no names. The answer is hidden; the first
// time it is shown, the lesson runs. Polled while open.

import { ApiError, type Api, type Lesson, type RoomPerson } from './api';
import { inkNow } from './colour';
import { byId, Choice, h } from './dom';
import { asking } from './layout';
import { guessesIn, type Value } from './prediction_box';
import { Run } from './run';
import { grouped } from './units';

const revealed = 'Show the answer';
const widest = 640; // px of the chart, scaled to the window

export class Wall {
  private readonly dialog: HTMLDialogElement;
  private readonly which = new Choice('Question', () => this.show(undefined));
  private readonly question = h('p');
  private readonly figure = h('figure');
  private readonly caption = h('p.caption');
  private readonly summary = h('summary');
  private readonly whys = h('ul');
  private readonly details = h('details', { hidden: true }, this.summary, this.whys);
  private readonly reveal = h('button', { 'aria-pressed': 'false', onclick: () => void this.toggle() }, revealed);
  private readonly lessons = new Map<string, Promise<Lesson | undefined>>();
  private readonly answers = new Map<string, Promise<Map<string, Value>>>(); // of a lesson, by name
  private answer: { question: string; value: Value } | undefined;
  private people: RoomPerson[] = [];

  constructor(
    private readonly api: Api,
    private readonly failed: (error: unknown) => void,
  ) {
    const { element } = this.which;
    byId('wall-predictions').append(element, this.reveal, this.question, this.figure, this.caption, this.details);
    this.dialog = asking('wall', () => this.ask(), failed);
  }

  offer(teacher: boolean): void {
    byId('wall-button').hidden = !teacher;
  }

  private async ask(): Promise<void> {
    this.people = await this.api.people();
    await this.draw();
  }

  private show(answer: Wall['answer']): void {
    this.answer = answer;
    this.draw().catch(this.failed);
  }

  private async draw(): Promise<void> {
    const titled = ({ lesson, name }: { lesson: string; name: string }): string =>
      name ? `${lesson}: ${name.replace(/_/g, ' ')}` : lesson;
    const groups = grouped(this.people.flatMap((p) => p.predictions), titled);
    const names = [...groups.keys()].sort();
    const none = names.length === 0;
    for (const part of [this.which.element, this.question, this.figure, this.reveal, this.details]) part.hidden = none;
    if (none) {
      this.caption.textContent = 'Nobody has predicted anything yet.';
      return;
    }
    const before = this.which.value;
    this.which.choose(names, names.includes(before) ? before : names[0]);
    const given = groups.get(this.which.value)!;
    this.explain(given[0].lesson);
    const answer = this.answer?.question === this.which.value ? this.answer.value : undefined;
    this.reveal.setAttribute('aria-pressed', String(answer !== undefined));
    const { drawBars, drawHistogram } = await import('./histogram');
    const lesson = await this.lesson(given[0].lesson);
    this.question.textContent = lesson?.predict ?? '';
    const size = [Math.min(widest, innerWidth - 48), 250] as const;
    const choices = guessesIn(lesson?.script ?? '')?.choices ?? [];
    const numbers = given.map((p) => p.value).filter((v) => typeof v === 'number');
    const texts = given.map((p) => p.value).filter((v) => typeof v === 'string');
    const drawn =
      texts.length > 0
        ? drawBars(texts, choices, size, inkNow(), answer === undefined ? undefined : String(answer))
        : drawHistogram(numbers, size, inkNow(), typeof answer === 'number' ? answer : undefined);
    this.figure.replaceChildren(drawn.element);
    this.caption.textContent = `${drawn.summary}.`;
  }

  private explain(lesson: string): void {
    const texts = this.people.flatMap((p) => p.whys).flatMap((w) => (w.lesson === lesson ? [w.text] : []));
    this.summary.textContent = `Why: ${texts.length} ${texts.length === 1 ? 'answer' : 'answers'}`;
    const same = [...this.whys.children].map((item) => item.textContent).join('\n') === texts.join('\n');
    if (!same) this.whys.replaceChildren(...texts.map((t) => h('li', t)));
  }

  private async toggle(): Promise<void> {
    const question = this.which.value;
    if (this.answer?.question === question) return this.show(undefined);
    const [lesson, name = ''] = question.split(': ');
    this.reveal.textContent = 'The lesson runs …';
    try {
      if (!this.answers.has(lesson)) this.answers.set(lesson, this.computed(lesson));
      const value = (await this.answers.get(lesson)!).get(name);
      if (value === undefined) throw new ApiError('refused', `the lesson ${lesson} gave no answer`, 'Run it here.');
      this.show({ question, value });
    } catch (error) {
      this.answers.delete(lesson);
      this.dialog.close();
      this.failed(error);
    }
    this.reveal.textContent = revealed;
  }

  /** Undefined if the server does not have the lesson. */
  private lesson(name: string): Promise<Lesson | undefined> {
    if (!this.lessons.has(name)) this.lessons.set(name, this.api.lesson(name).catch(() => undefined));
    return this.lessons.get(name)!;
  }

  /** Notebook `guesses` of the lesson's own script. */
  private async computed(name: string): Promise<Map<string, Value>> {
    const { script, title } = await this.api.lesson(name);
    const { id } = await this.api.start(script, name);
    const run = new Run(id, title, script);
    await this.api.events(id, 0, (event) => run.take(event), () => undefined, new AbortController().signal);
    const rows = run.notebooks.get('guesses')?.rows ?? [];
    return new Map(rows.map((row) => [String(row.guess ?? '').replace(/_/g, ' '), row.found as Value]));
  }
}
