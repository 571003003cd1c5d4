// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a work-precision study contain seconds, so they are not in a notebook but in <name>.csv. This file
// reads them as a notebook for the page.

import type { Api, Cell } from './api';
import { studiesIn } from './charted';
import type { Run } from './run';

/** Reads a study's file; true if its rows were added to the run. */
export async function readStudy(run: Run, file: string, api: Api): Promise<boolean> {
  const name = file.replace(/\.csv$/, '');
  if (name === file || ![...studiesIn(run.script).values()].includes(name)) return false;
  const { columns, units, rows } = tableOf(await (await api.file(run.id, file)).text());
  run.notebooks.set(name, { name, columns, units, rows });
  return true;
}

/** Comma-separated, with units in brackets after column names; numeric text becomes numbers. */
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
