// SPDX-License-Identifier: GPL-3.0-or-later
// A study of work and precision has seconds in its rows, so they are no notebook of the run but a file of it,
// <name>.csv, which is read here into one for the page.

import type { Api, Cell } from './api';
import { studiesIn } from './charted';
import type { Run } from './run';

/** Reads the file if it is a study's; true once its rows are in the run. */
export async function readStudy(run: Run, file: string, api: Api): Promise<boolean> {
  const name = file.replace(/\.csv$/, '');
  if (name === file || ![...studiesIn(run.script).values()].includes(name)) return false;
  const { columns, units, rows } = tableOf(await (await api.file(run.id, file)).text());
  run.notebooks.set(name, { name, columns, units, rows });
  return true;
}

/** Comma-separated, units in brackets behind the names of columns; what looks like a number is one. */
function tableOf(text: string): { columns: string[]; units: Record<string, string>; rows: Record<string, Cell>[] } {
  const [head, ...lines] = text.split('\n').filter(Boolean).map(cellsOf);
  const units: Record<string, string> = {};
  const columns = (head ?? []).map((c) => {
    const [, name, unit] = /^(.*?)(?: \[(.*)\])?$/.exec(c)!;
    if (unit) units[name] = unit;
    return name;
  });
  const rows = lines.map((cells) => {
    const row: Record<string, Cell> = {};
    columns.forEach((c, k) => {
      const value = cells[k] ?? '';
      if (value !== '') row[c] = Number.isNaN(Number(value)) ? value : Number(value);
    });
    return row;
  });
  return { columns, units, rows };
}

function cellsOf(line: string): string[] {
  return [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)].map((m) => m[1]?.replace(/""/g, '"') ?? m[2] ?? '');
}
