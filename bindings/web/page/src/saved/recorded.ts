// SPDX-License-Identifier: GPL-3.0-or-later
// The runs of one script at several values of its knobs, as this tab of the browser has seen them: a saved run
// holds them all, and a slider in it goes from one to the next. Of runs with the same values the last one counts.

import type { Api } from '../api';
import { knobsIn } from '../knobs';
import type { Run } from '../run';

const most = 40; // runs that are kept

export class RecordedRuns {
  private runs: Run[] = [];

  /** A run that has ended. */
  add(run: Run): void {
    if (run.script !== this.runs[0]?.script) this.runs = [];
    this.runs = [...this.runs, run].slice(-most);
  }

  /** Those with the knobs of `run`, itself among them, in the order of their values. */
  async beside(run: Run, api: Api): Promise<Run[]> {
    const ended = this.runs.filter((r) => r.script === run.script && (r.status === 'done' || r.status === 'failed'));
    await Promise.all([run, ...ended].map((r) => readKnobs(r, api)));
    const names = namesOf(run);
    if (names === '') return [run];
    const known = new Map<string, Run>();
    for (const r of ended) if (namesOf(r) === names) known.set(valuesOf(r).join(), r);
    known.set(valuesOf(run).join(), run);
    return [...known.values()].sort((a, b) => {
      const [mine, theirs] = [valuesOf(a), valuesOf(b)];
      const at = mine.findIndex((v, k) => v !== theirs[k]);
      return at < 0 ? 0 : mine[at] - theirs[at];
    });
  }
}

function namesOf(run: Run): string {
  return run.knobs.map((k) => k.name).join('\n');
}

function valuesOf(run: Run): number[] {
  return run.knobs.map((k) => k.value);
}

/** A run that was followed by another at once had no time to ask for its knobs. */
async function readKnobs(run: Run, api: Api): Promise<void> {
  if (run.knobs.length > 0) return;
  try {
    run.knobs = knobsIn(JSON.parse(await (await api.file(run.id, 'manifest.json')).text()));
  } catch {
    // A run that was stopped before it began has no record.
  }
}
