// SPDX-License-Identifier: GPL-3.0-or-later
// A run as the sum of its events. Events only change this record; panes draw once a frame, so that 10,000
// lines cost one drawing.

import type { Cell, RunEvent } from './api';
import { chartedIn, keysIn, type Charted } from './charted';
import type { Knob } from './knobs';
import type { Field } from './pictures';

export type Status = 'starting' | 'running' | 'done' | 'failed' | 'stopped' | 'limit' | 'lost';

export interface Notebook {
  name: string;
  columns: string[];
  units: Record<string, string>;
  rows: Record<string, Cell>[];
}

export interface OutputPart {
  stream: 'out' | 'err';
  text: string;
}

export interface RunError {
  line?: number;
  message: string;
  hint?: string;
  traceback?: string;
}

export interface LiveRun {
  coarse: boolean; // a full answer follows
  factor: number; // of `cells`
  seconds: number;
  computed: number; // heavy results
  recalled: number; // from memory
  fields: (view: string) => Promise<Field[]>;
}

/** Characters; longer output loses its beginning. */
export const outputKept = 400_000;

export class Run {
  status: Status = 'starting';
  before: number | undefined; // runs ahead
  reason = '';
  seconds: number | undefined;
  output: OutputPart[] = [];
  outputDropped = 0;
  progress: { task: string; fraction?: number; eta?: number; text?: string } | undefined;
  readonly notebooks = new Map<string, Notebook>();
  readonly files = new Map<string, { name: string; bytes: number; kind: string }>();
  readonly views: { name: string; title: string }[] = [];
  viewsLeftOut = 0; // for speed
  readonly expectations: { text: string; held: boolean }[] = [];
  knobs: Knob[] = []; // with this run's values
  live: LiveRun | undefined; // not a recorded run
  readonly errors: RunError[] = [];
  readonly keys: string[]; // of tables, in order
  readonly charted: Charted[]; // from the script's text
  private characters = 0;

  constructor(
    readonly id: string,
    readonly name: string,
    readonly script: string,
    readonly began = Date.now(),
  ) {
    this.charted = chartedIn(script);
    this.keys = keysIn(script);
  }

  get active(): boolean {
    return this.status === 'starting' || this.status === 'running';
  }

  take(event: RunEvent): void {
    switch (event.type) {
      case 'waiting':
        this.before = event.before;
        break;
      case 'started':
        this.status = 'running';
        break;
      case 'output':
        this.print(event.stream, event.text);
        break;
      case 'progress':
        this.progress = { task: event.task, fraction: event.fraction, eta: event.eta_s, text: event.text };
        break;
      case 'row':
        this.write(event.notebook, event.row, event.units ?? {}, event.columns ?? []);
        break;
      case 'file':
        this.files.set(event.name, { name: event.name, bytes: event.bytes, kind: event.kind ?? '' });
        break;
      case 'view':
        if (!this.views.some((v) => v.name === event.name)) {
          const title = event.title ?? event.name;
          const same = this.views.filter((v) => v.title === title || v.title.startsWith(`${title} (`)).length;
          this.views.push({ name: event.name, title: same ? `${title} (${same + 1})` : title });
        }
        break;
      case 'views_left_out':
        this.viewsLeftOut = event.count;
        break;
      case 'expectation':
        this.expectations.push({ text: event.text, held: event.held });
        break;
      case 'error':
        this.errors.push({ line: event.line, message: event.message, hint: event.hint, traceback: event.traceback });
        break;
      case 'finished':
        this.status = event.status;
        // An error has its own reason.
        this.reason =
          event.status === 'failed' && this.errors.length > 0 ? '' : (event.reason ?? '').replace(/\.$/, '');
        this.seconds = event.seconds;
        this.progress = undefined;
        break;
    }
  }

  private print(stream: 'out' | 'err', text: string): void {
    const last = this.output[this.output.length - 1];
    if (last && last.stream === stream && last.text.length < 20_000) {
      this.output[this.output.length - 1] = { stream, text: last.text + text };
    } else {
      this.output.push({ stream, text });
    }
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

function liveText(run: Run, live: LiveRun, seconds: (s: number) => string): string {
  if (live.coarse) return `Live, coarse: 1/${Math.round(1 / live.factor)} of the cells a side; the whole follows`;
  const first = run.errors[0];
  if (first) return `Live: ${first.line === undefined ? '' : `line ${first.line}: `}${first.message}`;
  return `Live in ${seconds(live.seconds)}, ${live.computed} computed, ${live.recalled} from memory`;
}

export function statusText(run: Run, seconds: (s: number) => string): string {
  if (run.live) return liveText(run, run.live, seconds);
  const took = run.seconds === undefined ? '' : ` ${seconds(run.seconds)}`;
  switch (run.status) {
    case 'starting':
      return run.before ? `Waiting for its turn, ${run.before} before you` : 'Waiting for its turn';
    case 'running':
      return 'Running';
    case 'done':
      return `Done in${took || ' no time'}`;
    case 'failed':
      return `Failed${took && ' after' + took}`;
    case 'stopped':
      return `Stopped${took && ' after' + took}`;
    case 'limit':
      return `Ended at a limit${took && ' after' + took}`;
    case 'lost':
      return 'Lost: the server forgot this run';
  }
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
