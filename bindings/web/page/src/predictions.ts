// SPDX-License-Identifier: GPL-3.0-or-later
// Predicted numbers of a lesson, in its script: `local my_guess = nil -- in degrees` or `local my_guess = {
// halved=nil, heavy=nil }`. The script prints its verdicts in lines that begin with "You said". These
// functions read and write the numbers and extract the verdicts.

import type { Run } from './run';

export interface Guess {
  name: string; // empty for a single number
  value: number | undefined;
}

export interface Guesses {
  list: Guess[];
  note: string; // the script's remark: unit, range
}

const line = /^local my_guess = (\{[^}\n]*\}|[^{\n]*?)[ \t]*(?:--[ \t]*([^\n]*))?$/m;

/** Undefined if the script has no guesses. */
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

/** The script with this number, or nil; unchanged without a place for guesses. */
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

/** The script's own sentences. */
export function verdictsOf(run: Run): string[] {
  const printed = run.output
    .filter((part) => part.stream === 'out')
    .map((part) => part.text)
    .join('');
  return printed.match(/^You said .*$/gm) ?? [];
}
