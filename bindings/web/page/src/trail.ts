// SPDX-License-Identifier: GPL-3.0-or-later
// Results of a script at the knob values tried before. The chart draws them faint.

import { valuesText } from './knobs';
import type { Notebook, Run } from './run';

export interface Tried {
  notebook: Notebook;
  values: string; // of the knobs
}

const most = 40; // runs

export class Trail {
  private runs: Run[] = [];

  /** Another script starts another trail. */
  add(run: Run): void {
    if (run.status !== 'done' || run === this.runs.at(-1)) return;
    if (run.script !== this.runs[0]?.script) this.runs = [];
    this.runs = [...this.runs, run].slice(-most);
  }

  clear(): void {
    this.runs = [];
  }

  /** Runs of this script at other values, with this notebook; the last of equal values. */
  before(run: Run, notebook: string): Tried[] {
    const known = new Map<string, Tried>();
    for (const one of this.runs) {
      const found = one.notebooks.get(notebook);
      const values = valuesText(one.knobs);
      if (one.script === run.script && values && found) known.set(values, { notebook: found, values });
    }
    known.delete(valuesText(run.knobs));
    return [...known.values()];
  }
}
