// SPDX-License-Identifier: GPL-3.0-or-later
// This tab's runs of one script at several knob values, for a saved run. Later runs replace runs with the
// same values.

import type { Api } from '../api';
import { knobsIn } from '../knobs';
import type { Run } from '../run';

const most = 40; // stored runs

export class RecordedRuns {
  private runs: Run[] = [];

  add(run: Run): void {
    if (run.script !== this.runs[0]?.script) this.runs = [];
    this.runs = [...this.runs, run].slice(-most);
  }

  /** Ordered by value. */
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

/** A run replaced at once has not read its knobs. */
async function readKnobs(run: Run, api: Api): Promise<void> {
  if (run.knobs.length > 0) return;
  try {
    run.knobs = knobsIn(JSON.parse(await (await api.file(run.id, 'manifest.json')).text()));
  } catch {
    // Stopped before its start.
  }
}
