// SPDX-License-Identifier: GPL-3.0-or-later
// A lesson's predictions: numbers in the lesson's script, `local my_guess = nil -- in degrees` or `local
// my_guess = { halved=nil, heavy=nil }`; words, stored in the browser; and the run's verdicts: printed lines
// that begin with "You said".

import { h } from './dom';
import type { Run } from './run';
import { keep, kept } from './storage';

export interface ScriptAtHand {
  text: () => string;
  replace: (script: string) => void;
}

export class PredictionBox {
  readonly element: HTMLElement;
  private readonly fields: { name: string; input: HTMLInputElement }[];
  private readonly missing = h('p.hint', { hidden: true }, 'The script has no my_guess any more; Reset brings it back.');
  private said = '';
  private readonly judged = h('div.judged', { hidden: true });

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
    const numbers = this.fields.map(({ name, input }) =>
      h('label', h('span', name.replace(/_/g, ' ') || 'Number'), input),
    );
    const note = guesses?.note ? h('p.hint', guesses.note) : '';
    this.element = h('section.prediction', { 'aria-label': 'Your prediction' },
      h('b', 'Your prediction, before you run it'),
      ...(guesses ? [h('div.guesses', ...numbers), note, this.missing, this.judged] : []),
      h('label', h('span', guesses ? 'And why' : 'In words'), words),
      h('p.hint', { id: 'prediction-hint' }, 'Kept here and with a saved run.'),
      guesses ? h('p.hint', 'Numbers stand in the script, and its run compares them.') : '',
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
    this.judged.replaceChildren(...verdicts.map((v) => h('p', v)));
    const pane = this.element.closest('.pane');
    if (!pane || pane.scrollHeight <= pane.clientHeight) return; // in one column
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

export interface Guess {
  name: string; // empty if single
  value: number | undefined;
}

interface Guesses {
  list: Guess[];
  note: string; // remark: unit, range
}

const line = /^local my_guess = (\{[^}\n]*\}|[^{\n]*?)[ \t]*(?:--[ \t]*([^\n]*))?$/m;

/** Undefined without guesses. */
function guessesIn(script: string): Guesses | undefined {
  const found = line.exec(script);
  if (!found) return undefined;
  const [, given, note = ''] = found;
  if (!given.startsWith('{')) return { list: [{ name: '', value: numberOf(given) }], note };
  const list = [...given.matchAll(/(\w+)\s*=\s*([^,}]+)/g)].map(([, name, value]) => ({
    name,
    value: numberOf(value.trim()),
  }));
  return { list, note };
}

/** Unchanged without a place for the number. */
function withGuess(script: string, name: string, value: number | undefined): string {
  const literal = value === undefined ? 'nil' : String(value);
  return script.replace(line, (whole: string, given: string) => {
    const changed =
      name === ''
        ? literal
        : given.replace(new RegExp(`(\\b${name}\\s*=\\s*)[^,}]*?(\\s*[,}])`), (_, lead, end) => lead + literal + end);
    const at = whole.indexOf(given);
    return whole.slice(0, at) + changed + whole.slice(at + given.length);
  });
}

function numberOf(literal: string): number | undefined {
  const text = /^"\s*([-+.\deE]+).*"$/.exec(literal)?.[1] ?? literal;
  return text.trim() === '' || Number.isNaN(Number(text)) ? undefined : Number(text);
}

function verdictsOf(run: Run): string[] {
  const printed = run.output
    .filter((part) => part.stream === 'out')
    .map((part) => part.text)
    .join('');
  return printed.match(/^You said .*$/gm) ?? [];
}
