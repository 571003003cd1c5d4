// SPDX-License-Identifier: GPL-3.0-or-later
// The list of lessons, and the open lesson: question, predictions, then text, read anew each time. The browser
// stores edited scripts and predictions by name.

import type { Api, Lesson, LessonEntry } from './api';
import { Choice, h, prose } from './dom';
import { chooseLanguage, inLanguage, label, languages, nameOfLanguage, told, type Told } from './language';
import { calledOut, markdown } from './markdown';
import { PredictionBox, type Guess, type ScriptAtHand } from './prediction_box';
import { keptScript } from './storage';

export interface Opened {
  key: string; // storage key
  title: string;
  script: string; // stored or original
  original: string;
  hidesCode?: boolean;
}

export class LessonsPane {
  private entries: LessonEntry[] | undefined;
  private again = (): void => undefined; // draws in another language
  private readonly language = new Choice('Language', (code) => {
    chooseLanguage(code);
    this.again();
  });
  prediction: PredictionBox | undefined;

  constructor(
    readonly element: HTMLElement,
    private readonly api: Api,
    private readonly open: (document: Opened) => void,
    private readonly own: () => void,
    private readonly handed: HTMLElement,
    private readonly script: ScriptAtHand,
    private readonly predicted: (lesson: string, guesses: Guess[], why: string) => void,
    private readonly failed: (error: unknown) => void,
  ) {
    addEventListener('popstate', () => {
      const name = (history.state as { lesson?: string } | null)?.lesson;
      void (name ? this.show(name, true) : this.list(true));
    });
  }

  /** Back undoes a user's choice. */
  private go(lesson: string): void {
    history.pushState({ lesson }, '');
    void (lesson ? this.show(lesson, true) : this.list(true));
  }

  async list(focus = false): Promise<void> {
    try {
      this.entries = await this.api.lessons();
    } catch (error) {
      this.failed(error);
    }
    this.again = () => this.drawList(this.entries ?? []);
    this.again();
    if (focus) this.element.querySelector('h2')!.focus();
  }

  private drawList(entries: LessonEntry[]): void {
    this.prediction = undefined;
    const items = entries.map((e, k) => {
      if (e.problem) return h('li', h('p.broken', h('strong', e.title), ' ', prose(e.problem)));
      const facts = [e.minutes ? `${e.minutes} min` : '', keptScript(`lesson.${e.name}`) === null ? '' : 'edited here'];
      const title = h('strong', { lang: told(e, 'title').lang, 'data-number': e.number ?? k + 1 }, told(e, 'title').text);
      const question = e.question ? inLanguage('span', told(e, 'question')) : null;
      const small = h('small', facts.filter(Boolean).join(' · '));
      return h('li', h('button', { onclick: () => this.go(e.name) }, title, question, small));
    });
    this.offerLanguages(entries);
    this.element.replaceChildren(
      h('div.choices', h('h2', { tabIndex: -1 }, 'Lessons'), this.language.element),
      h('button.own', { onclick: this.own },
        h('strong', 'Your own script'),
        h('span', 'Nothing but the editor: kept in this browser.'),
      ),
      this.handed,
      items.length
        ? h('ol.lessons', ...items)
        : h('p.empty', this.entries ? 'This installation has no lessons.' : 'The lessons could not be read.'),
    );
  }

  private offerLanguages(lessons: LessonEntry[]): void {
    const { codes, present } = languages(lessons);
    this.language.element.firstElementChild!.className = 'unseen';
    this.language.element.hidden = codes.length < 2;
    this.language.choose(codes.map((code) => ({ value: code, text: nameOfLanguage(code) })), present);
  }

  async show(name: string, focus: boolean): Promise<void> {
    try {
      const lesson = await this.api.lesson(name);
      const key = `lesson.${name}`;
      const { script, hides_code: hidesCode } = lesson;
      const title = told(lesson, 'title').text;
      this.open({ key, title, script: keptScript(key) ?? script, original: script, hidesCode });
      this.again = () => this.draw(lesson);
      this.again();
      this.element.scrollTop = 0;
      if (focus) this.element.querySelector('h2')!.focus();
    } catch (error) {
      this.failed(error);
    }
  }

  private draw(lesson: Lesson): void {
    const [title, question, predict, text] = (['title', 'question', 'predict', 'text'] as const).map((part) =>
      told(lesson, part),
    );
    const called = (name: string, t: Told): HTMLElement[] => {
      const element = calledOut(label(name, t), t.text);
      element.lang = t.lang;
      return t.text ? [element] : [];
    };
    const run = this.prediction?.run;
    this.prediction = new PredictionBox(lesson, this.script, this.predicted);
    this.offerLanguages([lesson]);
    this.element.replaceChildren(
      h('div.choices', h('button.back', { onclick: () => this.go('') }, '← All lessons'), this.language.element),
      h('h2', { tabIndex: -1, lang: title.lang }, title.text),
      ...called('Question', question),
      ...called('Predict', predict),
      this.prediction.element,
      h('div.lesson', { lang: text.lang }, markdown(text.text)),
      lesson.notes ? h('details.notes', h('summary', 'Notes for the teacher'), h('div.lesson', markdown(lesson.notes))) : '',
    );
    this.prediction.judge(run);
  }
}
