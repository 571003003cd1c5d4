// SPDX-License-Identifier: GPL-3.0-or-later
// Predicted numbers in a lesson's script: `local my_guess = nil -- in degrees` or `local my_guess = {
// halved=nil, heavy=nil }`. The script prints verdicts in lines that begin with "You said".

import type { Run } from './run';

export interface Guess {
  name: string; // empty if single
  value: number | undefined;
}

export interface Guesses {
  list: Guess[];
  note: string; // remark: unit, range
}

const line = /^local my_guess = (\{[^}\n]*\}|[^{\n]*?)[ \t]*(?:--[ \t]*([^\n]*))?$/m;

/** Undefined without guesses. */
export function guessesIn(script: string): Guesses | undefined {
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
export function withGuess(script: string, name: string, value: number | undefined): string {
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

export function verdictsOf(run: Run): string[] {
  const printed = run.output
    .filter((part) => part.stream === 'out')
    .map((part) => part.text)
    .join('');
  return printed.match(/^You said .*$/gm) ?? [];
}
