// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a work-precision study, which contain seconds, are in <name>.csv instead of a notebook. Here they
// become a notebook.

import type { Api, Cell } from './api';
import { studiesIn } from './charted';
import type { Run } from './run';

/** True if rows were added. */
export async function readStudy(run: Run, file: string, api: Api): Promise<boolean> {
  const name = file.replace(/\.csv$/, '');
  if (name === file || ![...studiesIn(run.script).values()].includes(name)) return false;
  const { columns, units, rows } = tableOf(await (await api.file(run.id, file)).text());
  run.notebooks.set(name, { name, columns, units, rows });
  return true;
}

/** Units are in brackets after column names. */
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
