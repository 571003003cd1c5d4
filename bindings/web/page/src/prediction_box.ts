// SPDX-License-Identifier: GPL-3.0-or-later
// A lesson's predictions: numbers or choices in the lesson's script, `local my_guess = nil -- in degrees` or `local
// my_guess = { halved=nil, heavy=nil }` with perhaps `guess.choices(my_guess, "less", "more")`; words, stored in the
// browser; and the run's verdicts, printed lines that begin with "You said". The paragraphs printed after the last
// verdict are the reason.

import type { Lesson } from './api';
import { h, prose } from './dom';
import { answer, inLanguage, reasonOf, verdict } from './language';
import { numberTyped } from './quantity';
import type { Run } from './run';
import { keep, kept } from './storage';

export interface ScriptAtHand {
  text: () => string;
  replace: (script: string) => void;
}

export type Value = number | string;

export interface Guess {
  name: string; // empty if single
  value: Value | undefined;
}

/** One predicted value. `show` displays the script's value; `lost`: the script has no my_guess. */
interface Field {
  name: string;
  element: HTMLElement;
  show: (value: Value | undefined, lost: boolean) => void;
}

/** A name, an option or the note in the chosen language. */
type Word = (name: string, english?: string) => HTMLElement;

const longestWhy = 500; // characters, as the server bounds bytes

export class PredictionBox {
  readonly element: HTMLElement;
  private readonly fields: Field[];
  private readonly missing = h('p.hint', { hidden: true }, 'The script has no my_guess any more. Reset restores it.');
  private readonly words: HTMLTextAreaElement;
  private said = '';
  run: Run | undefined; // judged
  private readonly judged = h('div.judged', { hidden: true });

  constructor(
    private readonly texts: Lesson,
    private readonly script: ScriptAtHand,
    private readonly changed: (lesson: string, guesses: Guess[], why: string) => void,
  ) {
    const guesses = guessesIn(texts.script);
    const word: Word = (name, english) => inLanguage('span', answer(texts, name, english));
    const { note = '', choices = [] } = guesses ?? {};
    const unit = /\bin (per cent|\S+)/.exec(note)?.[1] ?? '';
    this.fields = (guesses?.list ?? []).map(({ name }) => {
      const put = (value: Value | undefined): void => this.put(name, value);
      return choices.length > 0 ? choiceField(name, choices, word, put) : numberField(name, unit, word, put);
    });
    this.words = h('textarea', {
      rows: 2,
      maxLength: longestWhy,
      value: kept(`prediction.${this.lesson}`) ?? '',
      oninput: () => {
        keep(`prediction.${this.lesson}`, this.words.value || null);
        this.tell();
      },
      'aria-describedby': 'prediction-hint',
    });
    this.element = h('section.prediction', { 'aria-label': 'Your prediction' },
      h('b', 'Your prediction, before you run it'),
      note && h('p.hint', word('note', note)),
      guesses && h('div.guesses', ...this.fields.map((f) => f.element)),
      this.missing,
      this.judged,
      h('label', h('span', guesses ? 'And why' : 'In words'), this.words),
      h('p.hint', { id: 'prediction-hint' }, 'Kept here and with a saved run.'),
      guesses ? h('p.hint', 'Predictions stand in the script, and its run compares them.') : '',
    );
    this.read();
  }

  get lesson(): string {
    return this.texts.name;
  }

  /** Whether the script asks for predictions and has none. */
  get isOpen(): boolean {
    const guesses = guessesIn(this.script.text());
    return guesses !== undefined && guesses.list.every((g) => g.value === undefined);
  }

  focus(): void {
    this.element.querySelector('input')?.focus();
  }

  /** From the edited script. */
  read(): void {
    if (this.fields.length === 0) return;
    const guesses = guessesIn(this.script.text());
    this.missing.hidden = guesses !== undefined;
    for (const { name, show } of this.fields) {
      show(guesses?.list.find((g) => g.name === name)?.value, guesses === undefined);
    }
  }

  judge(run: Run | undefined): void {
    this.run = run;
    const { verdicts, reason } = run && !run.active ? judgedIn(run) : { verdicts: [], reason: [] };
    this.judged.hidden = verdicts.length === 0;
    const said = [...verdicts, ...reason].join('\n');
    if (said === this.said) return;
    this.said = said;
    const translated = reasonOf(this.texts, reason.join('\n\n'));
    const lang = translated?.lang ?? 'en';
    this.judged.replaceChildren(
      ...verdicts.map((v) => h('p.verdict', inLanguage('span', verdict(this.texts, v)))),
      ...(translated?.text.split('\n\n') ?? reason).map((r) => h('p', { lang }, prose(r))),
    );
    const pane = this.element.closest('.pane');
    if (!said || !pane || pane.scrollHeight <= pane.clientHeight) return; // in one column
    const [shown, whole] = [this.judged, pane].map((e) => e.getBoundingClientRect());
    const below = Math.min(shown.bottom - whole.bottom, shown.top - whole.top);
    if (below > 0) pane.scrollTop += below + 12;
  }

  private put(name: string, value: Value | undefined): void {
    this.script.replace(withGuess(this.script.text(), name, value));
    this.tell();
  }

  private tell(): void {
    this.changed(this.lesson, guessesIn(this.script.text())?.list ?? [], this.words.value.trim());
  }
}

function numberField(name: string, unit: string, word: Word, put: (value: Value | undefined) => void): Field {
  const understood = h('output.hint');
  const input = h('input', {
    type: 'text',
    inputMode: 'decimal',
    autocomplete: 'off',
    oninput: () => {
      tell();
      put(numberTyped(input.value));
    },
  });
  const tell = (): void => {
    const text = input.value.trim();
    const value = numberTyped(text);
    const found = value === undefined ? `“${text}” is not a number` : `understood: ${value} ${unit}`.trim();
    understood.textContent = text && found;
  };
  return {
    name,
    element: h('div.guess', h('label', name ? word(name) : h('span', 'Number'), input), understood),
    show: (value, lost) => {
      input.disabled = lost;
      if (document.activeElement === input) return;
      input.value = value === undefined ? '' : String(value);
      tell();
    },
  };
}

function choiceField(name: string, choices: string[], word: Word, put: (value: Value | undefined) => void): Field {
  const radios = choices.map((value) =>
    h('input', { type: 'radio', name: `guess-${name}`, value, onchange: () => put(value) }),
  );
  const legend = h('legend', name ? word(name) : 'Choice');
  const element = h('fieldset.guess', legend, ...radios.map((radio) => h('label', radio, word(radio.value))));
  return {
    name,
    element,
    show: (value, lost) => {
      element.disabled = lost;
      for (const radio of radios) radio.checked = radio.value === value;
    },
  };
}

interface Guesses {
  list: Guess[];
  note: string; // remark: unit, range
  choices: string[]; // empty: numbers
}

const line = /^local my_guess = (\{[^}\n]*\}|[^{\n]*?)[ \t]*(?:--[ \t]*([^\n]*))?$/m;

/** Undefined without guesses. */
export function guessesIn(script: string): Guesses | undefined {
  const found = line.exec(script);
  if (!found) return undefined;
  const [, given, note = ''] = found;
  const offered = /^guess\.choices\(my_guess((?:,\s*"[^"\n]*")+)\)/m.exec(script)?.[1] ?? '';
  const choices = [...offered.matchAll(/"([^"]*)"/g)].map((m) => m[1]);
  const valueOf = (literal: string): Value | undefined => {
    const text = /^"([^"]*)"$/.exec(literal.trim())?.[1] ?? literal.trim();
    if (choices.length > 0) return choices.find((c) => c === text);
    return numberTyped(/^[-+.,\deE]+/.exec(text.trim())?.[0] ?? '');
  };
  if (!given.startsWith('{')) return { list: [{ name: '', value: valueOf(given) }], note, choices };
  const list = [...given.matchAll(/(\w+)\s*=\s*([^,}]+)/g)].map(([, name, value]) => ({ name, value: valueOf(value) }));
  return { list, note, choices };
}

/** Unchanged without a place for the value. */
function withGuess(script: string, name: string, value: Value | undefined): string {
  const literal = value === undefined ? 'nil' : JSON.stringify(value);
  return script.replace(line, (whole: string, given: string) => {
    const changed =
      name === ''
        ? literal
        : given.replace(new RegExp(`(\\b${name}\\s*=\\s*)[^,}]*?(\\s*[,}])`), (_, lead, end) => lead + literal + end);
    const at = whole.indexOf(given);
    return whole.slice(0, at) + changed + whole.slice(at + given.length);
  });
}

function judgedIn(run: Run): { verdicts: string[]; reason: string[] } {
  const printed = run.output.map((part) => (part.stream === 'out' ? part.text : '')).join('');
  const lines = printed.split('\n').filter((text) => text.trim() !== '');
  const isVerdict = lines.map((text) => text.startsWith('You said '));
  const last = isVerdict.lastIndexOf(true);
  return { verdicts: lines.filter((_, k) => isVerdict[k]), reason: last < 0 ? [] : lines.slice(last + 1) };
}
