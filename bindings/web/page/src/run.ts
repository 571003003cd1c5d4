// SPDX-License-Identifier: GPL-3.0-or-later
// A run as the sum of its events. Panes draw this record once a frame: 10,000 lines cost one drawing.

import type { About, Cell, ChartEvent, EventOf, RunEvent } from './api';
import type { Knob } from './knobs';
import type { LiveResults } from './live';
import type { Field } from './pictures';
import { bytes, duration } from './units';

export type Status = 'starting' | 'running' | 'done' | 'failed' | 'stopped' | 'limit' | 'lost';

export interface Notebook {
  name: string;
  columns: string[];
  units: Record<string, string>;
  rows: Record<string, Cell>[];
}

export type LiveRun = LiveResults & { fields: (view: string) => Promise<Field[]> };

/** Characters; longer output loses its beginning. */
export const outputKept = 400_000;

const mostCharts = 50; // of the script

export class Run {
  status: Status = 'starting';
  before: number | undefined; // runs ahead
  reason = '';
  seconds: number | undefined;
  output: { stream: 'out' | 'err'; text: string }[] = [];
  outputDropped = 0;
  progress: EventOf<'progress'> | undefined;
  readonly notebooks = new Map<string, Notebook>();
  readonly files = new Map<string, EventOf<'file'>>();
  readonly views: { name: string; title: string }[] = [];
  viewsLeftOut = 0; // for speed
  readonly expectations: EventOf<'expectation'>[] = [];
  knobs: Knob[] = []; // with this run's values
  live: LiveRun | undefined; // not a recorded run
  readonly errors: EventOf<'error'>[] = [];
  readonly charted = new Map<string, ChartEvent>(); // each once
  private characters = 0;
  private readonly on: { [Type in RunEvent['type']]: (event: EventOf<Type>) => void } = {
    waiting: (event) => (this.before = event.before),
    started: () => (this.status = 'running'),
    output: (event) => this.print(event.stream, event.text),
    progress: (event) => (this.progress = event),
    row: (event) => this.write(event.notebook, event.row, event.units ?? {}, event.columns ?? []),
    chart: (event) => {
      if (this.charted.size < mostCharts) this.charted.set(JSON.stringify({ ...event, n: 0 }), event);
    },
    study: (event) =>
      event.rows.forEach(({ knobs, ...row }, k) =>
        this.write(event.name, { ...knobs, ...row, seconds: event.seconds[k] }, { seconds: 's' }, ['way']),
      ),
    file: (event) => this.files.set(event.name, event),
    view: ({ name, title = name }) => {
      if (this.views.some((v) => v.name === name)) return;
      const same = this.views.filter((v) => v.title === title || v.title.startsWith(`${title} (`)).length;
      this.views.push({ name, title: same ? `${title} (${same + 1})` : title });
    },
    views_left_out: (event) => (this.viewsLeftOut = event.count),
    expectation: (event) => this.expectations.push(event),
    error: (event) => this.errors.push(event),
    finished: (event) => {
      this.status = event.status;
      // An error has its own reason.
      this.reason = event.status === 'failed' && this.errors[0] ? '' : (event.reason ?? '').replace(/\.$/, '');
      this.seconds = event.seconds;
      this.progress = undefined;
    },
  };

  constructor(
    readonly id: string,
    readonly name: string,
    readonly script: string,
    readonly began = Date.now(),
  ) {}

  get active(): boolean {
    return this.status === 'starting' || this.status === 'running';
  }

  take(event: RunEvent): void {
    const act = this.on[event.type] as ((event: RunEvent) => void) | undefined;
    act?.(event);
  }

  private print(stream: 'out' | 'err', text: string): void {
    const last = this.output.at(-1);
    if (last?.stream === stream && last.text.length < 20_000) last.text += text;
    else this.output.push({ stream, text });
    this.characters += text.length;
    while (this.characters > outputKept && this.output.length > 1) {
      const dropped = this.output.shift()!;
      this.characters -= dropped.text.length;
      this.outputDropped += dropped.text.length;
    }
  }

  private write(name: string, row: Record<string, Cell>, units: Record<string, string>, columns: string[]): void {
    let notebook = this.notebooks.get(name);
    if (!notebook) this.notebooks.set(name, (notebook = { name, columns: [...columns], units: {}, rows: [] }));
    // Later rows may add columns.
    for (const column of Object.keys(row)) {
      if (!notebook.columns.includes(column)) notebook.columns.push(column);
    }
    Object.assign(notebook.units, units);
    notebook.rows.push(row);
  }
}

/** "Line 3: …", or without a line. */
export function errorText(error: EventOf<'error'> | undefined): string {
  return error ? `${error.line === undefined ? '' : `Line ${error.line}: `}${error.message}` : '';
}

function liveText(run: Run, live: LiveRun): string {
  if (live.part === 'coarse')
    return `Live, coarse: 1/${Math.round(1 / live.factor)} of the cells a side; the whole follows`;
  if (run.errors[0]) return `Live: ${errorText(run.errors[0]).replace(/^Line/, 'line')}`;
  return `Live in ${duration(live.seconds)}, ${live.computed} computed, ${live.recalled} from memory`;
}

export function statusText(run: Run): string {
  if (run.live) return liveText(run, run.live);
  const took = run.seconds === undefined ? '' : duration(run.seconds);
  const after = took && ` after ${took}`;
  const texts: Record<Status, string> = {
    starting: `Waiting for its turn${run.before ? `, ${run.before} before you` : ''}`,
    running: 'Running',
    done: `Done in ${took || 'no time'}`,
    failed: `Failed${after}`,
    stopped: `Stopped${after}`,
    limit: `Ended at a limit${after}`,
    lost: 'Lost: the server forgot this run',
  };
  return texts[run.status];
}

/** With the reason of the end. */
export function endText(run: Run): string {
  return statusText(run) + (run.reason && `: ${run.reason}`);
}

const mostNames = 60; // along an axis

/** In row order; empty for other columns or too many names, as in the engine's charts. */
export function namesIn(notebook: Notebook, column: string): string[] {
  const names = new Set<string>();
  for (const row of notebook.rows) {
    const value = row[column];
    if (value === undefined || value === null || value === '') continue;
    if (typeof value !== 'string') return [];
    names.add(value);
  }
  return names.size > mostNames ? [] : [...names];
}

export function columnsAlong(notebook: Notebook): string[] {
  return notebook.columns.filter(
    (c) => notebook.rows.some((r) => typeof r[c] === 'number') || namesIn(notebook, c).length > 0,
  );
}

export function numericColumns(notebook: Notebook): string[] {
  return notebook.columns.filter((c) => notebook.rows.some((r) => typeof r[c] === 'number'));
}

export function leftText(p: EventOf<'progress'>): string {
  return p.eta_s && p.eta_s >= 1 ? `about ${duration(p.eta_s)} left` : '';
}

export function limitsText(a: About): string {
  if (!a.limits) return `Asperity ${a.version}, in this browser. Scripts and files do not leave it.`;
  const { seconds, memory_bytes: memory, output_bytes: output, runs } = a.limits;
  return (
    `Asperity ${a.version}. A run may take ${duration(seconds)}, ${bytes(memory)} of memory, ` +
    `${bytes(output)} of output, ${runs} at once.`
  );
}
