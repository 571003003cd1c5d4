// SPDX-License-Identifier: GPL-3.0-or-later
// A lesson's predictions: numbers, as in the lesson's script; words, stored in the browser; and the run's
// verdicts.

import { h } from './dom';
import { guessesIn, verdictsOf, withGuess, type Guess } from './predictions';
import type { Run } from './run';
import { keep, kept } from './storage';

export interface ScriptAtHand {
  text: () => string;
  replace: (script: string) => void;
}

export class PredictionBox {
  readonly element: HTMLElement;
  private readonly fields: { name: string; input: HTMLInputElement }[];
  private readonly missing = h('p', { className: 'hint', hidden: true }, 'The script has no my_guess any more; Reset brings it back.');
  private said = '';
  private readonly judged = h('div', { className: 'judged', hidden: true });

  constructor(
    readonly lesson: string,
    original: string,
    private readonly script: ScriptAtHand,
    private readonly changed: (lesson: string, guesses: Guess[]) => void,
  ) {
    const guesses = guessesIn(original);
    this.fields = (guesses?.list ?? []).map(({ name }) => ({
      name,
      input: h('input', { type: 'number', step: 'any', oninput: () => this.put(name) }),
    }));
    const words = h('textarea', {
      rows: 2,
      value: kept(`prediction.${lesson}`) ?? '',
      oninput: () => keep(`prediction.${lesson}`, words.value || null),
      'aria-describedby': 'prediction-hint',
    });
    this.element = h(
      'section',
      { className: 'prediction', 'aria-label': 'Your prediction' },
      h('b', {}, 'Your prediction, before you run it'),
      ...(guesses
        ? [
            h(
              'div',
              { className: 'guesses' },
              ...this.fields.map(({ name, input }) =>
                h('label', {}, h('span', {}, name ? name.replace(/_/g, ' ') : 'Number'), input),
              ),
            ),
            guesses.note ? h('p', { className: 'hint' }, guesses.note) : '',
            this.missing,
            this.judged,
          ]
        : []),
      h('label', {}, h('span', {}, guesses ? 'And why' : 'In words'), words),
      h('p', { className: 'hint', id: 'prediction-hint' }, 'Kept here and with a saved run.'),
      guesses ? h('p', { className: 'hint' }, 'Numbers stand in the script, and its run compares them.') : '',
    );
    this.read();
  }

  /** From the edited script. */
  read(): void {
    if (this.fields.length === 0) return;
    const guesses = guessesIn(this.script.text());
    this.missing.hidden = guesses !== undefined;
    for (const { name, input } of this.fields) {
      const value = guesses?.list.find((g) => g.name === name)?.value;
      input.disabled = guesses === undefined;
      if (document.activeElement !== input) input.value = value === undefined ? '' : String(value);
    }
  }

  judge(run: Run | undefined): void {
    const verdicts = run && !run.active ? verdictsOf(run) : [];
    this.judged.hidden = verdicts.length === 0;
    const said = verdicts.join('\n');
    if (said === this.said) return;
    this.said = said;
    this.judged.replaceChildren(...verdicts.map((v) => h('p', {}, v)));
    const pane = this.element.closest('.pane');
    if (!pane || pane.scrollHeight <= pane.clientHeight) return; // in one column the page scrolls
    const below = this.judged.getBoundingClientRect().bottom - pane.getBoundingClientRect().bottom;
    if (said && below > 0) pane.scrollTop += below + 12;
  }

  private put(name: string): void {
    const { input } = this.fields.find((f) => f.name === name)!;
    const value = input.value.trim() === '' || !Number.isFinite(input.valueAsNumber) ? undefined : input.valueAsNumber;
    this.script.replace(withGuess(this.script.text(), name, value));
    this.changed(this.lesson, guessesIn(this.script.text())?.list ?? []);
  }
}
