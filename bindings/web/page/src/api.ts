// SPDX-License-Identifier: GPL-3.0-or-later
// The typed interface to the laboratory, and to the server behind it; all requests to a server are made here. The token arrives in the address fragment,
// which browsers never send. It moves to the tab's session storage at once, hidden from projectors, and is
// sent only in the Authorization header.

import { framesOf, type LiveFacts, type LookedAt } from './live';

export interface Mark {
  line: number;
  column?: number;
  severity: 'error' | 'warning' | 'note';
  message: string;
  hint?: string;
}

export interface Check {
  marks: Mark[];
  checked_to?: number;
  knobs?: unknown;
  charts?: ChartEvent[];
}

export interface Candidate {
  text: string;
  kind: string;
  detail?: string;
  help?: string;
}

export interface LessonTexts {
  title?: string;
  question?: string;
  predict?: string;
  text?: string;
  reason?: string;
  answers?: Record<string, string>;
  replies?: Record<string, string>;
}

export interface LessonEntry extends LessonTexts {
  name: string;
  title: string;
  number?: number;
  minutes?: number;
  languages?: Record<string, LessonTexts>;
  problem?: string; // for the teacher
}

export interface Lesson extends LessonEntry {
  script: string;
  hides_code?: boolean;
  notes?: string; // for the teacher
}

/** A script that passes between the teacher and a student. */
export interface SharedScript {
  name: string;
  script: string;
}

export interface About {
  version: string;
  limits?: { memory_bytes: number; seconds: number; output_bytes: number; runs: number };
  classroom?: boolean;
  documents?: boolean;
  teacher?: boolean;
  help?: boolean;
}

/** A run as shown to the teacher. */
export interface RoomRun {
  id: string;
  name: string;
  owner: string;
  state: string;
}

/** A person as shown to the teacher. */
export interface RoomPerson {
  name: string;
  help: boolean;
  script?: boolean; // came with the request for help
  predictions: { lesson: string; name: string; value: number | string }[];
  whys: { lesson: string; text: string }[];
}

/** A map without its numbers. */
export interface FieldFacts {
  name: string;
  unit: string;
  nx: number;
  ny: number;
  size_x: number; // m
  size_y: number;
  from_nx: number; // nodes of the grid
  from_ny: number;
  not_measured?: number; // number
  reduction: string;
}

export interface View<Field = FieldFacts & { data: string }> {
  title?: string;
  fields: Field[];
}

export type Cell = number | string | boolean | null;
type Row = Record<string, Cell>;

/** A chart as the script writes it: columns, and rows that it takes. */
export interface Charted {
  x: string;
  y: string[];
  per: string;
  log_x: boolean;
  log_y: boolean;
  title: string;
  x_label: string;
  y_label: string;
  where: Record<string, Cell[]>;
  points: boolean;
  spread: boolean;
}

/** The chart of a notebook, or of a study of work and precision. */
export type ChartEvent = { type: 'chart' } & ({ notebook: string; chart: Charted } | { study: string });

export type RunEvent = { n: number } & (
  | { type: 'waiting'; before: number }
  | { type: 'started' }
  | { type: 'output'; stream: 'out' | 'err'; text: string }
  | { type: 'progress'; task: string; fraction?: number; eta_s?: number }
  | { type: 'row'; notebook: string; row: Record<string, Cell>; units?: Record<string, string>; columns?: string[] }
  | ChartEvent
  | { type: 'study'; name: string; rows: ({ knobs: Row } & Row)[]; seconds: (number | null)[] }
  | { type: 'file'; name: string; bytes: number }
  | { type: 'view'; name: string; title?: string }
  | { type: 'views_left_out'; count: number }
  | { type: 'expectation'; text: string; held: boolean }
  | { type: 'error'; line?: number; message: string; hint?: string; traceback?: string }
  | {
      type: 'finished';
      status: 'done' | 'failed' | 'stopped' | 'limit';
      exit?: number;
      seconds?: number;
      reason?: string;
    }
);

export type EventOf<Type extends RunEvent['type']> = Extract<RunEvent, { type: Type }>;

export type Failure = 'gone' | 'token' | 'limit' | 'refused';

/** With a sentence for the user. */
export class ApiError extends Error {
  constructor(
    readonly failure: Failure,
    message: string,
    readonly hint = '',
  ) {
    super(message);
  }
}

const tokenKey = 'asperity.token';
/** The tab's last run, in the session storage. */
export const runKey = 'asperity.run';

/** Null if a percent sign begins no character. */
function decoded(text: string): string | null {
  try {
    return decodeURIComponent(text);
  } catch {
    return null;
  }
}

/** Of the server, or of the page alone (alone/laboratory.ts). */
export type Api = Pick<Server, keyof Server>;

export class Server {
  /** Null if the address is damaged. */
  private readonly token: string | null;

  constructor() {
    const given = decoded(location.hash.slice(1));
    const before = sessionStorage.getItem(tokenKey);
    if (given) sessionStorage.setItem(tokenKey, given);
    if (given && given !== before) sessionStorage.removeItem(runKey); // a run of another server or person
    if (location.hash) history.replaceState(null, '', location.pathname);
    this.token = given === '' ? (before ?? '') : given;
    addEventListener('hashchange', () => location.reload()); // another address in the same tab
  }

  get hasToken(): boolean {
    return Boolean(this.token);
  }

  get addressDamaged(): boolean {
    return this.token === null;
  }

  about = (): Promise<About> => this.json('GET', '/api/about');
  lessons = (): Promise<LessonEntry[]> => this.json('GET', '/api/lessons');
  lesson = (name: string): Promise<Lesson> => this.json('GET', `/api/lessons/${encodeURIComponent(name)}`);
  check = (script: string, signal?: AbortSignal): Promise<Check> => this.json('POST', '/api/check', { script }, signal);
  complete = (
    text: string,
    position: number,
    signal?: AbortSignal,
  ): Promise<{ from: number; candidates: Candidate[] }> =>
    this.json('POST', '/api/complete', { text, position }, signal);
  start = (script: string, name: string, knobs: Record<string, string> = {}): Promise<{ id: string }> =>
    this.json('POST', '/api/runs', { script, name, views: true, knobs });
  room = (): Promise<RoomRun[]> => this.json('GET', '/api/room');
  people = (): Promise<RoomPerson[]> => this.json('GET', '/api/people');
  predict = (lesson: string, guesses: Record<string, number | string>, why: string): Promise<unknown> =>
    this.json('POST', '/api/predictions', { lesson, guesses, why });
  askForHelp = (wanted: boolean, shown?: SharedScript): Promise<unknown> =>
    this.json('POST', '/api/help', { wanted, ...shown });
  shownBy = (student: string): Promise<SharedScript> => this.json('GET', `/api/people/${encodeURIComponent(student)}`);
  hand = (script?: SharedScript): Promise<unknown> => this.json('POST', '/api/handed', { ...script });
  handed = (after: number): Promise<{ number: number } & Partial<SharedScript>> =>
    this.json('GET', `/api/handed?after=${after}`);
  stop = (id: string): Promise<unknown> => this.json('DELETE', `/api/runs/${encodeURIComponent(id)}`);
  view = (id: string, name: string): Promise<View> =>
    this.json('GET', `/api/runs/${encodeURIComponent(id)}/views/${encodeURIComponent(name)}`);

  startLive = (script: string, tab: string): Promise<{ id: string }> =>
    this.json('POST', '/api/live', { script, tab });

  /** Streams the results at these values. */
  async moveLive(
    id: string,
    knobs: Record<string, string>,
    looked: LookedAt,
    take: (facts: LiveFacts, numbers: Float32Array[]) => void,
    signal: AbortSignal,
  ): Promise<void> {
    const answer = await this.request('POST', `/api/live/${encodeURIComponent(id)}`, { knobs, ...looked }, { signal });
    const text = new TextDecoder();
    await framesOf(answer.body!, (texts) =>
      take(
        JSON.parse(text.decode(texts[0])) as LiveFacts,
        texts.slice(1).map((t) => new Float32Array(t.buffer)),
      ),
    );
  }

  /** Also while the page unloads. */
  endLive(id: string): void {
    const path = `/api/live/${encodeURIComponent(id)}`;
    this.request('DELETE', path, undefined, { keepalive: true }).catch(() => undefined);
  }

  async file(id: string, name: string): Promise<Blob> {
    const path = name.split('/').map(encodeURIComponent).join('/');
    return (await this.request('GET', `/api/runs/${encodeURIComponent(id)}/files/${path}`)).blob();
  }

  /** Passes on a run's events after number `after` to the end. Broken connections are resumed; `gone`
      gets the error, and null after recovery. */
  async events(
    id: string,
    after: number,
    take: (event: RunEvent) => void,
    gone: (error: ApiError | null) => void,
    signal: AbortSignal,
  ): Promise<void> {
    let seen = after;
    let finished = false;
    let broken = false;
    const line = (text: string): void => {
      if (!text) return;
      const event = JSON.parse(text) as RunEvent;
      if (event.n <= seen) return;
      seen = event.n;
      finished ||= event.type === 'finished';
      take(event);
    };
    while (!finished) {
      try {
        const path = `/api/runs/${encodeURIComponent(id)}/events?after=${seen}`;
        const answer = await this.request('GET', path, undefined, { signal });
        if (broken) gone(null);
        broken = false;
        const reader = answer.body!.getReader();
        const text = new TextDecoder();
        let rest = '';
        for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
          const parts = (rest + text.decode(piece.value, { stream: true })).split('\n');
          rest = parts.pop()!;
          parts.forEach(line);
        }
        line(rest);
        if (!finished) await pause(300, signal);
      } catch (error) {
        if (signal.aborted) return;
        const known = error instanceof ApiError ? error : new ApiError('gone', serverGone);
        if (known.failure !== 'gone') throw known;
        broken = true;
        gone(known);
        await pause(1500, signal);
      }
    }
  }

  private async json<T>(method: string, path: string, body?: unknown, signal?: AbortSignal): Promise<T> {
    const answer = await this.request(method, path, body, { signal });
    const text = await answer.text();
    return (text ? JSON.parse(text) : null) as T;
  }

  private async request(method: string, path: string, body?: unknown, more: RequestInit = {}): Promise<Response> {
    const headers: Record<string, string> = { Authorization: `Bearer ${this.token ?? ''}` };
    if (body !== undefined) headers['Content-Type'] = 'application/json';
    let answer: Response;
    try {
      answer = await fetch(path, { method, cache: 'no-store', headers, body: JSON.stringify(body), ...more });
    } catch (error) {
      if (more.signal?.aborted) throw error;
      throw new ApiError('gone', serverGone);
    }
    if (answer.ok) return answer;
    const told = (await answer.json().catch(() => null)) as { error?: { message?: string; hint?: string } } | null;
    const { message = '', hint = '' } = told?.error ?? {};
    if (answer.status === 401 || answer.status === 403) throw new ApiError('token', tokenWrong, message);
    if (answer.status === 429 || answer.status === 503)
      throw new ApiError(
        'limit',
        message || 'the server runs as many scripts as it may',
        hint || 'wait until one has ended, or stop one',
      );
    throw new ApiError('refused', message || `the server answered with ${answer.status}`, hint);
  }
}

const serverGone = 'The server does not answer.';
export const serverGoneHint =
  'If asperity serve was ended, start it again and open the address it prints. What you wrote is kept in this browser.';
const tokenWrong = 'The server does not know this page’s token.';
export const tokenHint =
  'Open the whole address that asperity serve printed, with what stands after the #. A server that was started again has a new one.';

function pause(milliseconds: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    const timer = setTimeout(resolve, milliseconds);
    signal.addEventListener('abort', () => (clearTimeout(timer), resolve()), { once: true });
  });
}
