// SPDX-License-Identifier: GPL-3.0-or-later
// The laboratory without a server, behind the server's interface: the WebAssembly module in workers. One
// worker answers checks and completions, one each run, one the script whose knobs move, one the prompt; one
// waits for the next of them. Stop ends a worker.

import { ApiError, runKey, type About, type Api, type Check, type Lesson, type LessonEntry } from '../api';
import type { Candidate, RunEvent, View } from '../api';
import type { LiveFacts, LookedAt } from '../live';
import type { Files, Task, Told } from './module';

const checkPatience = 5000; // ms, for the dry run of a script
const runsKept = 20; // with their files

const told = new Set(['progress', 'row', 'view', 'views_left_out', 'expectation', 'error', 'chart', 'study']);
let compiled: Promise<WebAssembly.Module> | undefined;
const theModule = (): Promise<WebAssembly.Module> => (compiled ??= compile());

async function compile(): Promise<WebAssembly.Module> {
  const [answer, { default: xz }] = await Promise.all([fetch('module.xz'), import('xz-decompress')]);
  if (!answer.ok) throw new ApiError('refused', 'The file module.xz is missing', 'copy the whole folder of the page');
  // Compiled while it loads.
  const headers = { 'Content-Type': 'application/wasm' };
  return WebAssembly.compileStreaming(new Response(new xz.XzReadableStream(answer.body!), { headers }));
}

class Bench {
  private static spare: Bench | undefined;
  private readonly worker = new Worker('worker.js');
  private readonly ready: Promise<void>;
  private take = (told: Told): void => {
    if ('failure' in told && Bench.spare === this) Bench.spare = undefined;
  };

  private constructor() {
    this.worker.onmessage = (event: MessageEvent<Told>): void => this.take(event.data);
    this.worker.onerror = (event): void => this.take({ failure: event.message });
    this.ready = theModule().then((module) => this.worker.postMessage({ module } satisfies Task));
    this.ready.catch((error: Error) => this.take({ failure: error.message }));
  }

  static for(take: (told: Told) => void): Bench {
    const bench = Bench.spare ?? new Bench();
    Bench.spare = undefined;
    bench.take = take;
    return bench;
  }

  /** The next bench starts without a wait. */
  static prepare(): void {
    Bench.spare ??= new Bench();
  }

  give(task: Task): void {
    void this.ready.then(() => this.worker.postMessage(task));
  }

  end(): void {
    this.worker.terminate();
  }
}

/** Answers one question after the other. */
class Desk {
  private bench: Bench | undefined;
  private last: Promise<unknown> = Promise.resolve();
  private answered: (text: string | null) => void = () => undefined;

  /** Null after the patience. */
  ask(question: object, patience = Infinity, signal?: AbortSignal): Promise<unknown> {
    const answer = this.last.then(() => (signal?.aborted ? null : this.send(question, patience)));
    this.last = answer.catch(() => undefined);
    return answer;
  }

  private async send(question: object, patience: number): Promise<unknown> {
    await theModule();
    this.bench ??= Bench.for((t) => {
      if ('answer' in t) this.answered(t.answer);
      if ('failure' in t) this.answered(null);
    });
    const bench = this.bench;
    const text = await new Promise<string | null>((resolve) => {
      this.answered = resolve;
      if (patience < Infinity) setTimeout(() => resolve(null), patience);
      bench.give({ ask: JSON.stringify(question) });
    });
    if (text === null) {
      bench.end();
      this.bench = undefined;
      if (patience === Infinity) throw new ApiError('refused', 'The laboratory ended', 'load this page again');
      return null;
    }
    const answer = JSON.parse(text) as { error?: { message: string; hint: string } };
    if (answer.error) throw new ApiError('refused', answer.error.message, answer.error.hint);
    return answer;
  }
}

class RunHere {
  readonly events: RunEvent[] = [];
  files: Files = new Map();
  readonly views = new Map<string, string>();
  private readonly began = performance.now();
  private readonly bench: Bench;
  private listeners = new Set<() => void>();
  private why = '';

  constructor(task: Task) {
    this.bench = Bench.for((t) => this.take(t));
    this.tell({ type: 'started' });
    this.bench.give(task);
  }

  get over(): boolean {
    return this.events.at(-1)?.type === 'finished';
  }

  stop(): void {
    if (!this.over) this.finish('stopped', 'it was stopped; its files are lost, its lines and rows stay');
  }

  /** Resolves at the next event, or at the signal. */
  changed(signal: AbortSignal): Promise<void> {
    return new Promise((resolve) => {
      const done = (): void => {
        this.listeners.delete(done);
        signal.removeEventListener('abort', done);
        resolve();
      };
      this.listeners.add(done);
      signal.addEventListener('abort', done);
    });
  }

  private take(t: Told): void {
    if (this.over) return;
    if ('stream' in t) this.tell({ type: 'output', ...t });
    if ('view' in t) this.views.set(t.view, t.text);
    if ('line' in t) this.event(JSON.parse(t.line) as { type: string; why?: string });
    if ('failure' in t) this.finish('failed', `the module ended: ${t.failure}`);
    if ('exit' in t) {
      this.files = t.files;
      for (const [name, bytes] of t.files)
        if (!name.startsWith('store/')) this.tell({ type: 'file', name, bytes: bytes.length });
      this.finish(t.exit === 0 ? 'done' : 'failed', this.why, t.exit);
    }
  }

  private event(event: { type: string; why?: string }): void {
    if (event.type === 'ended') this.why = event.why ?? '';
    else if (told.has(event.type)) this.tell(event as Omit<RunEvent, 'n'>);
  }

  private finish(status: 'done' | 'failed' | 'stopped', reason: string, exit = 1): void {
    this.bench.end();
    Bench.prepare();
    const seconds = (performance.now() - this.began) / 1000;
    this.tell({ type: 'finished', status, exit, seconds, ...(reason && { reason }) });
  }

  private tell(event: Omit<RunEvent, 'n'> & Record<string, unknown>): void {
    this.events.push({ n: this.events.length + 1, ...event } as RunEvent);
    for (const done of [...this.listeners]) done();
  }
}

/** Output of a line of the prompt; its end, with the files so far. */
export type Line = { stream: 'out' | 'err'; text: string } | { next: 'line' | 'more' | 'end'; files: Files };

export interface Lines {
  enter(line: string): void;
  end(): void;
}

class LiveHere {
  private readonly bench: Bench;
  private moves = 0;
  private under: { move: number; take: (facts: LiveFacts, numbers: Float32Array[]) => void } | undefined;
  private free: Promise<void> = Promise.resolve();
  private moved: () => void = () => undefined;

  constructor(private readonly script: string) {
    this.bench = Bench.for((t) => {
      if ('facts' in t) {
        const facts = JSON.parse(t.facts) as LiveFacts & { move: number };
        if (facts.move === this.under?.move) this.under.take(facts, t.numbers);
      }
      if ('failure' in t) this.under?.take({ part: 'ended' }, []);
      if ('failure' in t || 'moved' in t) this.moved();
    });
  }

  /** Resolves when the answers have come, or at the signal; the next move waits for the answers. */
  async move(
    knobs: Record<string, string>,
    looked: LookedAt,
    take: (facts: LiveFacts, numbers: Float32Array[]) => void,
    signal: AbortSignal,
  ): Promise<void> {
    const aborted = new Promise<void>((resolve) => signal.addEventListener('abort', () => resolve()));
    await Promise.race([this.free, aborted]);
    if (signal.aborted) return;
    const move = ++this.moves;
    this.under = { move, take };
    this.free = new Promise((resolve) => (this.moved = resolve));
    this.bench.give({ move: JSON.stringify({ script: this.script, move, knobs, ...looked }) });
    await Promise.race([this.free, aborted]);
  }

  end(): void {
    this.bench.end();
    this.moved();
  }
}

/** A stored run after a reload, or a person of a classroom. */
const absent = (what: string): Promise<never> =>
  Promise.reject(new ApiError('refused', `${what} is not in this page.`));

export class Laboratory implements Api {
  readonly hasToken = true;
  readonly addressDamaged = false;
  /** Files of the user, which every run can read. */
  readonly given: Files = new Map();
  private readonly desk = new Desk();
  private readonly runs = new Map<string, RunHere>();
  private readonly lives = new Map<string, LiveHere>();
  private count = 0;

  constructor() {
    sessionStorage.removeItem(runKey); // runs end with the page
    // Its copies of all files would slow the first run. Without it the page needs the network.
    setTimeout(() => navigator.serviceWorker?.register('offline.js').catch(() => undefined), 5000);
  }

  about = async (): Promise<About> => ({
    version: await this.desk.ask({ ask: 'version' }).then((version) => (Bench.prepare(), version as string)),
    documents: await fetch('docs/index.html', { method: 'HEAD' }).then((answer) => answer.ok, () => false),
  });
  lessons = (): Promise<LessonEntry[]> => this.desk.ask({ ask: 'lessons' }) as Promise<LessonEntry[]>;
  lesson = (name: string): Promise<Lesson> => this.desk.ask({ ask: 'lesson', name }) as Promise<Lesson>;

  async check(script: string, signal?: AbortSignal): Promise<Check> {
    const answer = (await this.desk.ask({ ask: 'check', script }, checkPatience, signal)) as Partial<Check> | null;
    const note = { line: 1, severity: 'note' as const, message: 'the check did not come to an end' };
    return { marks: [note], ...answer };
  }

  async complete(text: string, position: number, signal?: AbortSignal): Promise<{ from: number; candidates: Candidate[] }> {
    const answer = await this.desk.ask({ ask: 'complete', text, position }, checkPatience, signal);
    return (answer ?? { from: position, candidates: [] }) as { from: number; candidates: Candidate[] };
  }

  start = (script: string, _name: string, knobs: Record<string, string> = {}): Promise<{ id: string }> =>
    this.begin({ run: JSON.stringify({ script, knobs }), files: this.given });

  /** Replays the run directory at `folder` of the given files. */
  replay = (folder: string): Promise<{ id: string }> =>
    this.begin({ replay: folder, files: this.given });

  /** A session of the prompt, which reads the given files. */
  prompt = (take: (line: Line) => void): Lines => {
    const made: Files = new Map();
    const given: Files = new Map();
    const bench = Bench.for((t) => {
      if ('stream' in t) take(t);
      if ('failure' in t) take({ stream: 'err', text: `the module ended: ${t.failure}\n` });
      if ('failure' in t) take({ next: 'end', files: made });
      if ('taken' in t) {
        t.files.forEach((bytes, path) => made.set(path, bytes));
        take({ next: (['line', 'more'] as const)[t.taken] ?? 'end', files: made });
      }
    });
    const enter = (line: string): void => {
      const files = new Map([...this.given].filter(([path, bytes]) => given.get(path) !== bytes));
      files.forEach((bytes, path) => given.set(path, bytes));
      bench.give({ line, files });
    };
    return { enter, end: () => bench.end() };
  };

  stop = (id: string): Promise<unknown> => this.of(id).then((run) => run.stop());

  async events(
    id: string,
    after: number,
    take: (event: RunEvent) => void,
    _gone: (error: ApiError | null) => void,
    signal: AbortSignal,
  ): Promise<void> {
    const run = await this.of(id);
    for (let next = after; !signal.aborted; ) {
      while (next < run.events.length) take(run.events[next++]);
      if (run.over) return;
      await run.changed(signal);
    }
  }

  async file(id: string, name: string): Promise<Blob> {
    const bytes = (await this.of(id)).files.get(name);
    return bytes ? new Blob([bytes as BlobPart]) : absent(`The file ${name}`);
  }

  async view(id: string, name: string): Promise<View> {
    const text = (await this.of(id)).views.get(name);
    return text ? (JSON.parse(text) as View) : absent(`The picture ${name}`);
  }

  startLive(script: string, tab: string): Promise<{ id: string }> {
    this.endLive(tab);
    this.lives.set(tab, new LiveHere(script));
    return Promise.resolve({ id: tab });
  }

  moveLive = (
    id: string,
    knobs: Record<string, string>,
    looked: LookedAt,
    take: (facts: LiveFacts, numbers: Float32Array[]) => void,
    signal: AbortSignal,
  ): Promise<void> => this.lives.get(id)?.move(knobs, looked, take, signal) ?? absent('This script');

  endLive(id: string): void {
    this.lives.get(id)?.end();
    this.lives.delete(id);
  }

  // A classroom needs a server.
  room = (): Promise<never> => absent('A classroom');
  people = this.room;
  predict = this.room;
  askForHelp = this.room;
  shownBy = this.room;
  hand = this.room;
  handed = this.room;

  private begin(task: Task): Promise<{ id: string }> {
    const id = String(++this.count);
    this.runs.set(id, new RunHere(task));
    this.runs.delete(String(this.count - runsKept));
    return Promise.resolve({ id });
  }

  private of(id: string): Promise<RunHere> {
    const run = this.runs.get(id);
    return run ? Promise.resolve(run) : absent('This run');
  }
}
