// SPDX-License-Identifier: GPL-3.0-or-later
// Which chart of a notebook is shown first: what the script itself charts, by its text or by the names of
// the files it drew, and else the columns that vary and that it writes first.

import type { ChartChoice } from './chart';
import type { Charted } from './charted';
import { numericColumns, type Notebook, type Run } from './run';
import { sameToRounding } from './units';

export function firstChoice(run: Run, notebook: Notebook): ChartChoice {
  for (const charted of run.charted) {
    const choice = asCharted(charted, notebook);
    if (choice) return choice;
  }
  const columns = numericColumns(notebook);
  const written = (c: string): number => {
    const at = run.keys.indexOf(c);
    return at < 0 ? run.keys.length : at;
  };
  const varied = columns.filter((c) => varies(notebook, c)).sort((a, b) => written(a) - written(b));
  const per =
    notebook.columns.find((c) => {
      const values = columns.includes(c) ? 0 : distinct(notebook, c);
      return values > 1 && values <= 8;
    }) ?? '';
  const drawn = byFile(run, notebook, columns);
  if (drawn) return { ...drawn, per, logX: false, logY: false };
  const x = varied[0] ?? columns[0];
  const y = varied[1] ?? columns.find((c) => c !== x)!;
  return { x, y, per, logX: false, logY: false };
}

/** The notebook that the script charts first, of those that can be drawn. */
export function firstNotebook(run: Run, names: string[]): string {
  for (const charted of run.charted) {
    const name = names.find((n) => asCharted(charted, run.notebooks.get(n)!));
    if (name) return name;
  }
  return names[0];
}

function asCharted(charted: Charted, notebook: Notebook): ChartChoice | undefined {
  const columns = numericColumns(notebook);
  if (charted.notebook && charted.notebook !== notebook.name) return undefined;
  if (!columns.includes(charted.x)) return undefined;
  const known = charted.y.filter((c) => columns.includes(c));
  const y = known.find((c) => varies(notebook, c)) ?? known[0];
  if (y === undefined) return undefined;
  const per = notebook.columns.includes(charted.per) ? charted.per : '';
  return { x: charted.x, y, per, logX: charted.logX, logY: charted.logY };
}

/** A chart without a name of its own is in the file <notebook>-<y>-<x>.svg, with any further y between. */
function byFile(run: Run, notebook: Notebook, columns: string[]): { x: string; y: string } | undefined {
  for (const file of run.files.keys()) {
    for (const y of columns) {
      const begin = `${fileName(`${notebook.name}-${y}`)}-`;
      if (!file.startsWith(begin)) continue;
      const x = columns.find((c) => c !== y && `-${file.slice(begin.length)}`.endsWith(`-${fileName(c)}.svg`));
      if (x !== undefined) return { x, y };
    }
  }
  return undefined;
}

/** A text as the program makes it safe as a file's name. */
function fileName(text: string): string {
  return text.replace(/[^\w.\u0080-\uffff]+/g, '-').replace(/^[.-]+|-+$/g, '');
}

/** More than by rounding. */
function varies(notebook: Notebook, column: string): boolean {
  let low = Infinity;
  let high = -Infinity;
  for (const row of notebook.rows) {
    const value = row[column];
    if (typeof value !== 'number' || !Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return high > low && !sameToRounding(low, high);
}

function distinct(notebook: Notebook, column: string): number {
  return new Set(notebook.rows.map((r) => r[column]).filter((v) => v !== undefined && v !== null)).size;
}
