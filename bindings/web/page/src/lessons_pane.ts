// SPDX-License-Identifier: GPL-3.0-or-later
// The list of lessons, and the open lesson: question, predictions, then text. The browser stores edited
// scripts and predictions by name.

import type { Api, Lesson, LessonEntry } from './api';
import { h } from './dom';
import { calledOut, markdown } from './markdown';
import { PredictionBox, type Guess, type ScriptAtHand } from './prediction_box';
import { keptScript } from './storage';

export interface Opened {
  key: string; // storage key
  title: string;
  script: string; // stored or original
  original: string;
}

export class LessonsPane {
  private entries: LessonEntry[] | undefined;
  private readonly lessons = new Map<string, Lesson>();
  prediction: PredictionBox | undefined;

  constructor(
    readonly element: HTMLElement,
    private readonly api: Api,
    private readonly open: (document: Opened) => void,
    private readonly own: () => void,
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
      this.entries ??= await this.api.lessons();
    } catch (error) {
      this.failed(error);
    }
    this.prediction = undefined;
    const items = (this.entries ?? []).map((e) => {
      const facts = [e.minutes ? `${e.minutes} min` : '', keptScript(`lesson.${e.name}`) === null ? '' : 'edited here'];
      const question = e.question ? h('span', e.question) : null;
      const small = h('small', facts.filter(Boolean).join(' · '));
      return h('li', h('button', { onclick: () => this.go(e.name) }, h('strong', e.title), question, small));
    });
    this.element.replaceChildren(
      h('h2', { tabIndex: -1 }, 'Lessons'),
      h('button.own', { onclick: this.own },
        h('strong', 'Your own script'),
        h('span', 'Nothing but the editor: kept in this browser.'),
      ),
      items.length
        ? h('ol.lessons', ...items)
        : h('p.empty', this.entries ? 'This installation has no lessons.' : 'The lessons could not be read.'),
    );
    if (focus) this.element.querySelector('h2')!.focus();
  }

  async show(name: string, focus: boolean): Promise<void> {
    try {
      const lesson = this.lessons.get(name) ?? (await this.api.lesson(name));
      this.lessons.set(name, lesson);
      const question = lesson.question ?? this.entries?.find((e) => e.name === name)?.question;
      const key = `lesson.${name}`;
      this.open({ key, title: lesson.title, script: keptScript(key) ?? lesson.script, original: lesson.script });
      this.prediction = new PredictionBox(name, lesson.script, this.script, this.predicted);
      this.element.replaceChildren(
        h('button.back', { onclick: () => this.go('') }, '← All lessons'),
        h('h2', { tabIndex: -1 }, lesson.title),
        ...(question ? [calledOut('Question', question)] : []),
        ...(lesson.predict ? [calledOut('Predict', lesson.predict)] : []),
        this.prediction.element,
        h('div.lesson', markdown(lesson.text)),
      );
      this.element.scrollTop = 0;
      if (focus) this.element.querySelector('h2')!.focus();
    } catch (error) {
      this.failed(error);
    }
  }
}
