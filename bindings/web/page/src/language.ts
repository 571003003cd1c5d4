// SPDX-License-Identifier: GPL-3.0-or-later
// The language of the lessons' texts: chosen by hand and stored in the browser, else the browser's own. A text
// without a translation is English. The page itself is English.

import type { Lesson } from './api';
import { h } from './dom';
import { keep, kept } from './storage';

type Named = 'title' | 'question' | 'predict' | 'text';

export interface Told {
  text: string;
  lang: string;
}

const labels: Record<string, Record<string, string>> = { de: { Question: 'Frage', Predict: 'Vorhersage' } };

let chosen = kept('language') ?? navigator.language.slice(0, 2);

export function chooseLanguage(code: string): void {
  chosen = code;
  keep('language', code);
}

/** Codes for which a lesson has a text, English first; the present one is marked. */
export function languages(lessons: Partial<Lesson>[]): { codes: string[]; present: string } {
  const others = new Set(lessons.flatMap((l) => Object.keys(l.languages ?? {})));
  const codes = ['en', ...[...others].sort()];
  return { codes, present: codes.includes(chosen) ? chosen : 'en' };
}

export function nameOfLanguage(code: string): string {
  return new Intl.DisplayNames([code], { type: 'language' }).of(code) ?? code;
}

export function told(lesson: Partial<Lesson>, part: Named): Told {
  const text = lesson.languages?.[chosen]?.[part];
  return text === undefined ? { text: lesson[part] ?? '', lang: 'en' } : { text, lang: chosen };
}

/** "Frage" of "Question" for a text in German. */
export const label = (english: string, { lang }: Told): string => labels[lang]?.[english] ?? english;

/** The name of a guess, an option, or "note", the remark behind the guess. */
export function answer(lesson: Partial<Lesson>, name: string, english = name.replace(/_/g, ' ')): Told {
  const text = lesson.languages?.[chosen]?.answers?.[name];
  return text === undefined ? { text: english, lang: 'en' } : { text, lang: chosen };
}

export const inLanguage = (tag: 'span' | 'p' | 'strong', { text, lang }: Told): HTMLElement => h(tag, { lang }, text);

const decimals = (text: string): string => (chosen === 'de' ? text.replace(/(\d)\.(\d)/g, '$1,$2') : text);

const said =
  /^You said (.+?) of (.+?)(?:, and so it is|: it is (.+?))(?:, (which is(?: not)? near|\S+ times too \w+))?\.(?: (.+))?$/;

/** A line of scripts/guess.lua, in German for a lesson with German answers. */
export function verdict(lesson: Partial<Lesson>, line: string): Told {
  const { answers, replies } = lesson.languages?.[chosen] ?? {};
  const found = said.exec(line);
  if (!found || found[1].startsWith('`') || !answers || chosen !== 'de') return { text: line, lang: 'en' };
  const [, guess, of, is, distance = '', reply = ''] = found;
  const plain = (text: string): string => text.replace(/^"|"$/g, '');
  const answer = (text: string): string =>
    text.startsWith('"') ? `„${answers[plain(text)] ?? plain(text)}“` : decimals(text);
  const near = decimals(distance)
    .replace('which is not near', 'weit daneben')
    .replace('which is near', 'nah daran')
    .replace(/ times too (much|little)/, (_, much) => `-mal zu ${much === 'much' ? 'viel' : 'wenig'}`);
  const text =
    `${answers[of] ?? of}: Du sagtest ${answer(guess)}, ` +
    [is === undefined ? 'und so ist es' : `es ist ${answer(is)}`, near].filter(Boolean).join(', ');
  const german = replies?.[`${of}, ${plain(guess)}`] ?? replies?.[plain(guess)] ?? reply;
  return { text: `${text}. ${is === undefined ? '' : german}`.trim(), lang: chosen };
}

/** The reason that a run printed, in the chosen language: the printed text is compared with the reason of the
    lesson's script, whose values replace {1}, {2} … Undefined if there is none, or the script prints another. */
export function reasonOf(lesson: Partial<Lesson>, printed: string): Told | undefined {
  const translated = lesson.languages?.[chosen]?.reason;
  const source = /prose"?\(?\[\[([\s\S]*?)\]\]/.exec(lesson.script ?? '')?.[1];
  if (translated === undefined || source === undefined) return undefined;
  const found = new RegExp(patternOf(source)).exec(printed);
  if (!found) return undefined;
  return { text: translated.replace(/\{(\d+)\}/g, (whole, k: string) => decimals(found[Number(k)] ?? whole)), lang: chosen };
}

/** As scripts/prose.lua prints a text: each paragraph is a line. */
function patternOf(source: string): string {
  const lines = source.trim().split(/\s*\n\s*\n\s*/).map((p) => p.replace(/\s*\n\s*/g, ' '));
  return lines
    .join('\n\n')
    .split(/(%%|%[-+#0]*\d*(?:\.\d+)?[a-z])/)
    .map((part, k) => (k % 2 === 0 ? part.replace(/[.*+?^${}()|[\]\\]/g, '\\$&') : part === '%%' ? '%' : '(\\S+)'))
    .join('');
}
