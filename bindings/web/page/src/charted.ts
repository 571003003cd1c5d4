// SPDX-License-Identifier: GPL-3.0-or-later
// The charts of a script, from its text: `book:chart{ x="N", y="Ra", log_x=true }`, and `study:chart
// "cost.svg"` (error against seconds). A column must be a literal, or a variable or loop variable with
// literal texts; other calls are skipped. The text also gives the order of columns, which rows lack.

import type { Cell } from './api';

export interface Charted {
  /** Empty if unknown. */
  notebook: string;
  x: string;
  y: string[];
  per: string;
  logX: boolean;
  logY: boolean;
  title: string;
  xLabel: string; // instead of the column names
  yLabel: string;
  where: Record<string, Cell[]>;
  points: boolean;
  spread: boolean;
}

interface Token {
  kind: 'text' | 'word' | 'sign';
  value: string;
}

type Field = string | boolean | string[] | Record<string, Cell[]>;

const study = { xLabel: '', yLabel: '', x: 'seconds', y: ['error'], per: 'way', logX: true, logY: true, where: {}, points: true, spread: false };

export function chartedIn(script: string): Charted[] {
  const tokens = tokensOf(script);
  const books = new Map<string, string>(); // by variable
  const studies = studiesIn(script);
  const variables = variablesIn(tokens);
  const found: Charted[] = [];
  const is = (at: number, value: string): boolean => tokens[at]?.kind !== 'text' && tokens[at]?.value === value;
  tokens.forEach((token, at) => {
    if (token.kind !== 'word') return;
    const past = is(at + 1, '(') ? at + 2 : at + 1;
    if (token.value === 'notebook' && is(at - 1, '.') && tokens[past]?.kind === 'text') {
      const variable = assignedTo(tokens, at);
      if (variable) books.set(variable, tokens[past].value);
    }
    if (token.value !== 'chart' || !is(at - 1, ':')) return;
    const holder = tokens[at - 2]?.value ?? '';
    if (tokens[past]?.kind === 'text' && studies.has(holder)) {
      const notebook = studies.get(holder)!;
      found.push({ ...study, notebook, title: `${notebook}: error against time` });
    } else if (is(past, '{')) {
      const { one_line_per: per, log_x, log_y, title, x_label, y_label, where, points, spread } = fieldsOf(tokens, past);
      const all = columnsOf(tokens, past, variables);
      for (const { x, y } of all)
        found.push({
          notebook: books.get(holder) ?? '',
          x,
          y,
          per: typeof per === 'string' ? per : '',
          xLabel: typeof x_label === 'string' ? x_label : '',
          yLabel: typeof y_label === 'string' ? y_label : '',
          logX: log_x === true,
          logY: log_y === true,
          title: typeof title === 'string' && all.length === 1 ? title : '',
          where: typeof where === 'object' && !Array.isArray(where) ? where : {},
          points: points !== false,
          spread: spread === true,
        });
    }
  });
  return found;
}

/** Study names by variable; the rows are in <name>.csv. */
export function studiesIn(script: string): Map<string, string> {
  const tokens = tokensOf(script);
  const studies = new Map<string, string>();
  tokens.forEach((token, at) => {
    if (token.kind !== 'word' || token.value !== 'work_precision' || tokens[at - 1]?.value !== '.') return;
    const past = tokens[at + 1]?.value === '(' ? at + 2 : at + 1;
    const variable = assignedTo(tokens, at);
    const { name } = fieldsOf(tokens, past);
    if (variable) studies.set(variable, typeof name === 'string' ? name : token.value);
  });
  return studies;
}

/** Table keys in order, without units: `N`, `["Ra [m]"]`. */
export function keysIn(script: string): string[] {
  const tokens = tokensOf(script);
  const open: string[] = [];
  const keys = new Set<string>();
  tokens.forEach(({ kind, value }, at) => {
    if (kind === 'sign' && '([{'.includes(value)) open.push(value);
    else if (kind === 'sign' && ')]}'.includes(value)) open.pop();
    const bracketed = kind === 'text' && tokens[at + 1]?.value === ']';
    if (tokens[at + (bracketed ? 2 : 1)]?.value !== '=') return;
    if (bracketed || (kind === 'word' && open[open.length - 1] === '{')) keys.add(value.replace(/ *\[.*\]$/, ''));
  });
  return [...keys];
}

/** Possible values of a variable: texts or lists of texts. */
interface Variable {
  at: number; // the assigned token
  values: (string | string[])[];
}

/** `q = "a"`, `q = { "a", "b" }`, `for _, q in ipairs{ "a", "b" } do`, `ipairs(q)`. Other assignments and
    function parameters have no known values. */
function variablesIn(tokens: Token[]): Map<string, Variable[]> {
  const variables = new Map<string, Variable[]>();
  const put = (name: string, at: number, values: Variable['values']): void => {
    variables.set(name, [...(variables.get(name) ?? []), { at, values }]);
  };
  const word = (at: number): string => (tokens[at]?.kind === 'word' ? tokens[at].value : '');
  const sign = (at: number): string => (tokens[at]?.kind === 'sign' ? tokens[at].value : '');
  let depth = 0; // `=` in brackets is no assignment
  tokens.forEach(({ kind, value }, at) => {
    if (kind === 'sign' && '([{'.includes(value)) ++depth;
    if (kind === 'sign' && ')]}'.includes(value)) --depth;
    if (kind === 'sign' && value === '=' && depth === 0 && word(at - 1) && sign(at - 2) !== '.') {
      const next = tokens[at + 1];
      const single = sign(at - 2) !== ',' && sign(at + 2) !== '..' && sign(at + 2) !== ',';
      const list = sign(at + 1) === '{' ? textsOf(tokens, at + 2) : undefined;
      put(word(at - 1), at, !single ? [] : next?.kind === 'text' ? [next.value] : list ? [list] : []);
    }
    if (word(at) === 'for' && sign(at + 2) === ',' && word(at + 4) === 'in' && word(at + 5) === 'ipairs') {
      const past = sign(at + 6) === '(' ? at + 7 : at + 6;
      const list = sign(past) === '{' ? textsOf(tokens, past + 1) : valuesAt(variables, word(past), past)[0];
      put(word(at + 3), at, Array.isArray(list) ? list : []);
    } else if (word(at) === 'for') {
      for (let k = at + 1; word(k) && word(k) !== 'in'; k += 2) put(word(k), at, []);
    }
    if (word(at) === 'function') {
      let k = at + 1;
      while (k < tokens.length && sign(k) !== '(') ++k;
      for (++k; word(k); k += 2) put(word(k), at, []);
    }
  });
  return variables;
}

function valuesAt(variables: Map<string, Variable[]>, name: string, at: number): Variable['values'] {
  return (variables.get(name) ?? []).filter((v) => v.at < at).at(-1)?.values ?? [];
}

/** The columns of each possible chart of the table at `at`. */
function columnsOf(tokens: Token[], at: number, variables: Map<string, Variable[]>): { x: string; y: string[] }[] {
  const plain = fieldsOf(tokens, at);
  const values = (key: string): Variable['values'] => {
    const given = plain[key];
    if (typeof given === 'string') return [given];
    if (Array.isArray(given)) return [given];
    return valuesAt(variables, variableIn(tokens, at, key), at);
  };
  return values('x').flatMap((across) =>
    typeof across === 'string' ? values('y').map((up) => ({ x: across, y: [up].flat() })) : [],
  );
}

/** The variable of a field: `y=q`, but not `y=q.name` or `y=name(q)`. */
function variableIn(tokens: Token[], at: number, key: string): string {
  let depth = 0;
  for (let k = at; k < tokens.length; ++k) {
    const { kind, value } = tokens[k];
    if (kind === 'sign' && '([{'.includes(value)) ++depth;
    if (kind === 'sign' && ')]}'.includes(value) && --depth === 0) return '';
    if (depth !== 1 || kind !== 'word' || value !== key || tokens[k + 1]?.value !== '=') continue;
    const alone = tokens[k + 3]?.kind === 'sign' && [',', ';', '}'].includes(tokens[k + 3].value);
    return alone && tokens[k + 2].kind === 'word' ? tokens[k + 2].value : '';
  }
  return '';
}

function tokensOf(script: string): Token[] {
  const pattern =
    /--\[(=*)\[[^]*?\]\1\]|--[^\n]*|\[(=*)\[\n?([^]*?)\]\2\]|"((?:\\[^]|[^"\\\n])*)"|'((?:\\[^]|[^'\\\n])*)'|([A-Za-z_]\w*)|\d[\w.]*|[=~<>]=|\.\.+|[^\s]/g;
  const tokens: Token[] = [];
  for (const part of script.matchAll(pattern)) {
    if (part[0].startsWith('--')) continue;
    const text = part[3] ?? (part[4] ?? part[5])?.replace(/\\(["'\\])/g, '$1');
    if (text !== undefined) tokens.push({ kind: 'text', value: text });
    else tokens.push({ kind: part[6] ? 'word' : 'sign', value: part[0] });
  }
  return tokens;
}

/** The assigned variable: `b` in `local a, b = 1, lab.notebook "b"`. */
function assignedTo(tokens: Token[], at: number): string | undefined {
  let depth = 0;
  let before = 0;
  let k = at - 1;
  for (; k >= 0; --k) {
    const { kind, value } = tokens[k];
    if (kind === 'text') continue;
    if (')]}'.includes(value)) ++depth;
    else if ('([{'.includes(value) && --depth < 0) return undefined;
    else if (depth === 0 && value === ',') ++before;
    else if (depth === 0 && value === '=') break;
  }
  const names: string[] = [];
  for (--k; tokens[k]?.kind === 'word'; k -= 2) {
    names.unshift(tokens[k].value);
    if (tokens[k - 1]?.value !== ',') break;
  }
  return names[before];
}

/** Literal fields of the table at `at`: "text", true, { "texts" }. */
function fieldsOf(tokens: Token[], at: number): Record<string, Field | undefined> {
  const fields: Record<string, Field | undefined> = {};
  const sign = (k: number): string => (tokens[k]?.kind === 'sign' ? tokens[k].value : '');
  const ends = (k: number): boolean => [',', ';', '}'].includes(sign(k));
  let depth = 0;
  for (let k = at; k < tokens.length; ++k) {
    if (['{', '(', '['].includes(sign(k))) ++depth;
    if (['}', ')', ']'].includes(sign(k)) && --depth === 0) break;
    if (depth !== 1 || tokens[k].kind !== 'word' || sign(k + 1) !== '=') continue;
    const value = tokens[k + 2];
    if (value?.kind === 'text' && ends(k + 3)) fields[tokens[k].value] = value.value;
    if (value?.kind === 'word' && /^(true|false)$/.test(value.value) && ends(k + 3))
      fields[tokens[k].value] = value.value === 'true';
    if (sign(k + 2) === '{')
      fields[tokens[k].value] = tokens[k].value === 'where' ? whereOf(tokens, k + 3) : textsOf(tokens, k + 3);
  }
  return fields;
}

function textsOf(tokens: Token[], from: number): string[] | undefined {
  const texts: string[] = [];
  for (let k = from; k < tokens.length; ++k) {
    const { kind, value } = tokens[k];
    if (kind === 'text') texts.push(value);
    else if (kind === 'sign' && value === '}') return texts;
    else if (kind !== 'sign' || (value !== ',' && value !== ';')) return undefined;
  }
  return undefined;
}

/** Literal parts of `body={ "a", "b" }, press=2`. */
function whereOf(tokens: Token[], from: number): Record<string, Cell[]> {
  const where: Record<string, Cell[]> = {};
  let column = '';
  let depth = 1;
  let known = true;
  const close = (): void => {
    if (!known) delete where[column];
    known = true;
    column = '';
  };
  for (let k = from; k < tokens.length && depth > 0; ++k) {
    const { kind, value } = tokens[k];
    const bracketed = kind === 'text' && tokens[k + 1]?.value === ']';
    if (depth === 1 && (kind === 'word' || bracketed) && tokens[k + (bracketed ? 2 : 1)]?.value === '=') {
      close();
      column = value.replace(/ *\[.*\]$/, '');
      where[column] = [];
    } else if (kind === 'text' && !bracketed) where[column]?.push(value);
    else if (kind === 'sign' && /^\d/.test(value)) where[column]?.push(Number(value));
    else if (value === '{') ++depth;
    else if (value === '}') --depth;
    else if (kind === 'word' || !'=,;[]'.includes(value)) known = false;
  }
  close();
  return where;
}
