// SPDX-License-Identifier: GPL-3.0-or-later
// Live scripts: a server process for this tab answers each knob move. Only the newest move is sent; it waits
// for a pending answer, shortly and only before a coarse answer.

import { ApiError, type Api, type FieldFacts, type RunEvent, type View } from './api';
import { fieldOf, type Field } from './pictures';
import { valuesOf, type Knob } from './knobs';
import { Run } from './run';

export interface Followed {
  script: string;
  name: string;
  key: string;
}

/** Results without the numbers of the view. */
export interface LiveResults {
  part: 'coarse' | 'whole'; // coarse, then whole
  factor: number; // of `cells`
  first?: number; // the map that came; part 'others' brings the others
  seconds: number;
  computed: number; // heavy results
  recalled: number; // from memory
  events: RunEvent[];
  views: { name: string; title: string }[];
  view?: View<FieldFacts> & { name: string };
}

export type LiveFacts = LiveResults | { part: 'others' | 'outdated' | 'ended' };

/** '': the last view, no map in view. */
export interface LookedAt {
  view: string;
  map: string;
}

export interface LivePicture {
  name: string;
  first?: Field; // before the others
  fields: Promise<Field[]>; // none if a newer move came before the others
}

interface Move {
  of: Followed;
  knobs: Knob[];
  began: number; // performance.now() of the event
}

interface Under {
  move: Move;
  since: number;
  stop: AbortController;
  coarse: boolean; // has arrived
}

const patience = 250; // ms, for a pending answer
const mostPatience = 2000; // or 1.5 times the last full answer, up to this
const slow = 450; // ms
const moveAgain = 'Move the knob again, or run the script.';

export class Live {
  /** Refused by the server. */
  failed = false;
  private readonly tab = [...crypto.getRandomValues(new Uint32Array(2))].map((n) => n.toString(36)).join('');
  private session: { script: string; id: Promise<string> } | undefined;
  private wanted: Move | undefined;
  private under: Under | undefined;
  private timer = 0;
  private going = false;
  private took = 0; // ms, last full answer
  private others: (numbers: Float32Array[]) => void = () => undefined; // of the answer that has come in part

  constructor(
    private readonly api: Api,
    private readonly on: {
      answered: (run: Run, of: Followed, picture: LivePicture | undefined, began: number) => void;
      changed: () => void;
      failed: (error: unknown) => void;
      looked: () => LookedAt;
    },
  ) {
    addEventListener('pagehide', () => this.end());
  }

  get busy(): boolean {
    return this.going;
  }

  get isSlow(): boolean {
    return this.under !== undefined && performance.now() - this.under.since >= slow;
  }

  /** Starts the session before a move. */
  warm(of: Followed): void {
    if (!this.failed) this.open(of.script).catch(() => undefined);
  }

  move(of: Followed, knobs: Knob[], began: number): void {
    if (this.failed) return;
    this.wanted = { of, knobs, began };
    if (this.going) this.hurry();
    else void this.go();
  }

  forget(): void {
    this.wanted = undefined;
    this.under?.stop.abort();
  }

  /** Also ends the process. */
  end(): void {
    this.forget();
    const session = this.session;
    this.session = undefined;
    session?.id.then((id) => this.api.endLive(id)).catch(() => undefined);
  }

  private hurry(): void {
    clearTimeout(this.timer);
    const under = this.under;
    if (!under || !this.wanted) return;
    const time = Math.max(patience, Math.min(mostPatience, 1.5 * this.took));
    const left = under.coarse ? 0 : under.since + time - performance.now();
    if (left <= 0) under.stop.abort();
    else this.timer = window.setTimeout(() => this.hurry(), left);
  }

  private open(script: string): Promise<string> {
    if (this.session?.script === script) return this.session.id;
    const id = this.api.startLive(script, this.tab).then((answer) => answer.id);
    const session = { script, id };
    this.session = session;
    id.catch(() => {
      if (this.session === session) this.session = undefined;
    });
    return id;
  }

  private async go(): Promise<void> {
    this.going = true;
    this.on.changed();
    try {
      while (this.wanted) {
        const move = this.wanted;
        this.wanted = undefined;
        await this.ask(move);
      }
    } catch (error) {
      this.wanted = undefined;
      // Not live: run the whole script at rest.
      if (error instanceof ApiError && error.failure === 'refused') this.failed = true;
      else this.on.failed(error);
    } finally {
      this.going = false;
      this.on.changed();
    }
  }

  private async ask(move: Move, again = true): Promise<void> {
    const under: Under = { move, since: performance.now(), stop: new AbortController(), coarse: false };
    this.under = under;
    setTimeout(() => this.on.changed(), slow + 10);
    const mine = this.session?.script === move.of.script;
    try {
      const id = await this.open(move.of.script);
      under.since = performance.now();
      let gone = false;
      const take = (facts: LiveFacts, numbers: Float32Array[]): void => {
        if (under.stop.signal.aborted) return;
        if (facts.part === 'ended') gone = true;
        if (facts.part === 'others') this.others(numbers);
        if (facts.part !== 'coarse' && facts.part !== 'whole') return;
        under.coarse ||= facts.part === 'coarse';
        this.take(move, facts, numbers);
        this.hurry();
      };
      await this.api.moveLive(id, valuesOf(move.knobs), this.on.looked(), take, under.stop.signal);
      if (gone && !under.stop.signal.aborted) {
        this.session = undefined;
        if (again && mine) await this.ask(move, false);
        else throw new ApiError('limit', 'The script that follows its knobs was ended.', moveAgain);
      }
    } catch (error) {
      if (under.stop.signal.aborted) return;
      // Idle or replaced process: start another.
      if (again && mine && error instanceof ApiError && error.failure === 'refused') {
        this.session = undefined;
        return this.ask(move, false);
      }
      throw error;
    } finally {
      clearTimeout(this.timer);
      if (this.under === under) this.under = undefined;
    }
  }

  private take(move: Move, facts: LiveResults, numbers: Float32Array[]): void {
    const { of } = move;
    if (facts.part === 'whole') this.took = 1000 * facts.seconds;
    const run = new Run('', of.name, of.script);
    run.live = { ...facts, fields: (name) => this.look(move, name) };
    run.knobs = move.knobs;
    run.status = 'done';
    for (const event of facts.events) run.take(event);
    if (run.errors.length > 0) run.status = 'failed';
    for (const { name, title } of facts.views) run.take({ n: 0, type: 'view', name, title });
    this.on.answered(run, of, this.pictureIn(facts, numbers), move.began);
  }

  private async look(move: Move, name: string): Promise<Field[]> {
    let found: Promise<Field[]> | Field[] = [];
    const id = await this.open(move.of.script);
    const take = (facts: LiveFacts, numbers: Float32Array[]): void => {
      const picture = facts.part === 'whole' ? this.pictureIn(facts, numbers) : undefined;
      if (picture?.name === name) found = picture.fields;
    };
    await this.api.moveLive(id, valuesOf(move.knobs), { view: name, map: '' }, take, new AbortController().signal);
    return found;
  }

  private pictureIn({ view, first }: LiveResults, numbers: Float32Array[]): LivePicture | undefined {
    if (!view) return undefined;
    const { name } = view;
    const fieldsOf = (of: Float32Array[]): Field[] => view.fields.map((f, k) => fieldOf(f, of[k]));
    if (first === undefined) return { name, fields: Promise.resolve(fieldsOf(numbers)) };
    const fields = new Promise<Field[]>((resolve) => {
      this.others = (rest) => resolve(fieldsOf([...rest.slice(0, first), numbers[0], ...rest.slice(first)]));
      this.under?.stop.signal.addEventListener('abort', () => resolve([]));
    });
    return { name, first: fieldOf(view.fields[first], numbers[0]), fields };
  }
}

/** Frames: a number of texts, then each after its length. */
export async function framesOf(body: ReadableStream<Uint8Array>, take: (texts: Uint8Array[]) => void): Promise<void> {
  const reader = body.getReader();
  let bytes = new Uint8Array();
  for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
    const more = new Uint8Array(bytes.length + piece.value.length);
    more.set(bytes);
    more.set(piece.value, bytes.length);
    bytes = more;
    for (let end; (end = whole(bytes, take)) > 0; ) bytes = bytes.slice(end);
  }
}

/** The end of the first complete frame; 0 if incomplete. */
function whole(bytes: Uint8Array, take: (texts: Uint8Array[]) => void): number {
  const numbers = new DataView(bytes.buffer);
  if (bytes.length < 8) return 0;
  const texts: Uint8Array[] = [];
  let at = 8;
  for (let left = numbers.getBigUint64(0, true); left > 0; --left) {
    if (at + 8 > bytes.length) return 0;
    const end = at + 8 + Number(numbers.getBigUint64(at, true));
    if (end > bytes.length) return 0;
    texts.push(bytes.slice(at + 8, end));
    at = end;
  }
  take(texts);
  return at;
}
