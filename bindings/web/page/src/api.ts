// SPDX-License-Identifier: GPL-3.0-or-later
// The typed interface to the server; all requests are made here. The token arrives in the address fragment,
// which browsers never send. It moves to the tab's session storage at once, hidden from projectors, and is
// sent only in the Authorization header.

import { framesOf, type LiveFacts } from './live';

export interface Mark {
  line: number;
  column?: number;
  severity: 'error' | 'warning' | 'note';
  message: string;
  hint?: string;
}

export interface Candidate {
  text: string;
  kind: string;
  detail?: string;
  help?: string;
}

export interface LessonEntry {
  name: string;
  title: string;
  question?: string;
  minutes?: number;
}

export interface Lesson {
  name: string;
  title: string;
  text: string;
  script: string;
  question?: string;
  predict?: string;
}

export interface About {
  version: string;
  limits?: { memory_bytes?: number; seconds?: number; output_bytes?: number; runs?: number };
  classroom?: boolean;
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
  predictions: { lesson: string; name: string; value: number }[];
}

export interface ViewField {
  name: string;
  unit: string;
  nx: number;
  ny: number;
  size_x: number;
  size_y: number;
  from_nx: number;
  from_ny: number;
  not_measured?: number; // number
  reduction: string;
  data: string;
}

export interface View {
  title?: string;
  event?: string | number;
  fields: ViewField[];
}

export type Cell = number | string | boolean | null;

export type RunEvent = { n: number } & (
  | { type: 'waiting'; before: number }
  | { type: 'started' }
  | { type: 'output'; stream: 'out' | 'err'; text: string }
  | { type: 'progress'; task: string; fraction?: number; eta_s?: number; text?: string }
  | { type: 'row'; notebook: string; row: Record<string, Cell>; units?: Record<string, string>; columns?: string[] }
  | { type: 'file'; name: string; bytes: number; kind?: string }
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

export class Api {
  private token: string;

  constructor() {
    const given = decodeURIComponent(location.hash.slice(1));
    if (given) {
      sessionStorage.setItem(tokenKey, given);
      history.replaceState(null, '', location.pathname);
    }
    this.token = given || sessionStorage.getItem(tokenKey) || '';
  }

  get hasToken(): boolean {
    return this.token !== '';
  }

  about = (): Promise<About> => this.json('GET', '/api/about');
  lessons = (): Promise<LessonEntry[]> => this.json('GET', '/api/lessons');
  lesson = (name: string): Promise<Lesson> => this.json('GET', `/api/lessons/${encodeURIComponent(name)}`);
  check = (script: string, signal?: AbortSignal): Promise<{ marks: Mark[]; checked_to?: number; knobs?: unknown }> =>
    this.json('POST', '/api/check', { script }, signal);
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
  predict = (lesson: string, numbers: Record<string, number>): Promise<unknown> =>
    this.json('POST', '/api/predictions', { lesson, numbers });
  askForHelp = (wanted: boolean): Promise<unknown> => this.json('POST', '/api/help', { wanted });
  stop = (id: string): Promise<unknown> => this.json('DELETE', `/api/runs/${encodeURIComponent(id)}`);
  view = (id: string, name: string): Promise<View> =>
    this.json('GET', `/api/runs/${encodeURIComponent(id)}/views/${encodeURIComponent(name)}`);

  startLive = (script: string, tab: string): Promise<{ id: string }> =>
    this.json('POST', '/api/live', { script, tab });

  /** Streams the results at these values. */
  async moveLive(
    id: string,
    knobs: Record<string, string>,
    view: string,
    take: (facts: LiveFacts, numbers: Float32Array[]) => void,
    signal: AbortSignal,
  ): Promise<void> {
    const answer = await this.request('POST', `/api/live/${encodeURIComponent(id)}`, { knobs, view }, signal);
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
    void fetch(`/api/live/${encodeURIComponent(id)}`, {
      method: 'DELETE',
      keepalive: true,
      headers: { Authorization: `Bearer ${this.token}` },
    }).catch(() => undefined);
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
        const answer = await this.request(
          'GET',
          `/api/runs/${encodeURIComponent(id)}/events?after=${seen}`,
          undefined,
          signal,
        );
        if (broken) gone(null);
        broken = false;
        const reader = answer
          .body!.pipeThrough(new TextDecoderStream() as ReadableWritablePair<string, Uint8Array>)
          .getReader();
        let rest = '';
        for (;;) {
          const { value, done } = await reader.read();
          if (done) break;
          const parts = (rest + value).split('\n');
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
    const answer = await this.request(method, path, body, signal);
    const text = await answer.text();
    return (text ? JSON.parse(text) : null) as T;
  }

  private async request(method: string, path: string, body?: unknown, signal?: AbortSignal): Promise<Response> {
    let answer: Response;
    try {
      answer = await fetch(path, {
        method,
        signal,
        cache: 'no-store',
        headers: {
          Authorization: `Bearer ${this.token}`,
          ...(body === undefined ? {} : { 'Content-Type': 'application/json' }),
        },
        body: body === undefined ? undefined : JSON.stringify(body),
      });
    } catch (error) {
      if (signal?.aborted) throw error;
      throw new ApiError('gone', serverGone);
    }
    if (answer.ok) return answer;
    const { sentence, hint } = await reason(answer);
    if (answer.status === 401 || answer.status === 403) throw new ApiError('token', tokenWrong, sentence);
    if (answer.status === 429 || answer.status === 503) {
      throw new ApiError(
        'limit',
        sentence || 'the server runs as many scripts as it may',
        hint || 'wait until one has ended, or stop one',
      );
    }
    throw new ApiError('refused', sentence || `the server answered with ${answer.status}`, hint);
  }
}

const serverGone = 'The server does not answer.';
export const serverGoneHint =
  'If asperity serve was ended, start it again and open the address it prints. What you wrote is kept in this browser.';
const tokenWrong = 'The server does not know this page’s token.';
export const tokenHint =
  'Open the whole address that asperity serve printed, with what stands after the #. A server that was started again has a new one.';

async function reason(answer: Response): Promise<{ sentence: string; hint: string }> {
  try {
    const body = (await answer.json()) as Record<string, unknown>;
    const inner = (typeof body.error === 'object' && body.error ? body.error : body) as Record<string, unknown>;
    const sentence = [inner.message, inner.error, inner.sentence].find((s) => typeof s === 'string') as
      | string
      | undefined;
    return { sentence: sentence ?? '', hint: typeof inner.hint === 'string' ? inner.hint : '' };
  } catch {
    return { sentence: '', hint: '' };
  }
}

function pause(milliseconds: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    const timer = setTimeout(resolve, milliseconds);
    signal.addEventListener('abort', () => (clearTimeout(timer), resolve()), { once: true });
  });
}
