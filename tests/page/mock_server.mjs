// SPDX-License-Identifier: GPL-3.0-or-later
// A stand-in for `asperity serve` with invented physics, for a long run, a limit or a broken connection on
// demand.
// Start: node mock_server.mjs DIST [PORT]

import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join, normalize } from 'node:path';
import { pathToFileURL } from 'node:url';

export const policy =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; " +
  "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

const types = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml',
  '.txt': 'text/plain; charset=utf-8',
};

const lessons = [
  {
    name: '01_roughness',
    title: 'What roughness is, and what a stylus misses',
    minutes: 15,
    question: 'Three faces have the same Ra. Are they equally rough, and can a stylus tell?',
    predict: 'A ball of 5 µm radius is drawn over the finest. What share of `Ra` does it find?',
    text:
      '**Ra** is how far heights lie from their mean. It does not say how *quickly* they change.\n\n' +
      '- `swell` has waves of 25 µm\n- `fine` has waves of 1 µm\n\n| face | slope |\n|---|---|\n| swell | 0.1 |\n| fine | 1.2 |\n\n```lua\nlocal s = lab.surface.flat{ cells=8, size=1 }\n```\n\n' +
      '<img src=x onerror="window.injected=1"> [a link](javascript:window.injected=1) & [another](https://example.org/)\n\n*Then try:* tips on the swell.',
    languages: {
      de: {
        title: 'Was Rauheit ist',
        predict: 'Eine Kugel fährt über die feinste Fläche.',
        reason: 'Warum: Die Tiefe ist {2} und nicht {1}.\n\nZweiter Absatz.',
        answers: { slope: 'Steigung', note: 'Anteile', 'the share of Ra': 'Anteil von Ra', more: 'mehr' },
        replies: { less: 'Nein.' },
      },
    },
    script:
      '-- What roughness is\nlocal lab = require "asperity"\nlocal my_guess = { Ra=nil, slope=nil } -- shares between 0 and 1\n\nlocal book = lab.notebook "tips"\nfor N = 1, 8 do\n  book:write{ N=N, ["Ra [m]"]=2.9e-6 - N * 1e-7, mu=0.3 + N / 50 }\nend\nprint "three faces"\nprose([[\nWhy: the depth is %.2f,\nnot %d %%.\n\nSecond.]], 1, 2)\n',
  },
  {
    name: '02_dimension',
    title: 'Fractal dimension and its traps',
    minutes: 10,
    question: 'Do five methods agree?',
    text: 'Plain text.',
    script: '-- two\n' + '-- its head\n'.repeat(30) + 'local lab = require "asperity"\nprint(2)\n' + '-- its end\n'.repeat(60),
  },
  {
    name: '03_boxes',
    title: 'Boxes against the half-space',
    minutes: 15,
    question: 'Does a hill know that its neighbour is being pressed?',
    text: 'Plain text.',
    script:
      '-- three\nlocal my_guess = { depth=nil, spots=nil } -- than 0.2 um\nguess.choices(my_guess, "less", "equal", "more")\n' +
      '-- mock.guess depth more\n-- mock.guess spots 47\n',
  },
  {
    name: 'springs',
    number: 1,
    title: 'Springs of my own',
    minutes: 5,
    question: 'Which spring is stiffer?',
    predict: 'By how much?',
    text: 'Plain text.',
    notes: 'Ask *why*.',
    hides_code: true,
    script: '-- Springs\nprint "a spring"\n',
  },
  { name: '02_broken.lua', title: '02_broken.lua', problem: '02_broken.lua:7: `end` expected' },
];

function wave(n, scale) {
  const values = new Float32Array(n * n);
  for (let j = 0; j < n; ++j) {
    for (let i = 0; i < n; ++i) {
      let z = 0;
      for (let k = 1, a = 1; k < 40; k = k * 1.6 + 1, a *= 0.55) {
        z += a * Math.sin((6.283 * k * (i * Math.cos(k * 7) + j * Math.sin(k * 7))) / n + k * k);
      }
      values[j * n + i] = z * scale;
    }
  }
  return values;
}

const field = (name, unit, n, values, reduction = 'mean of 8 x 8 nodes', from = 8 * n) => ({
  name,
  unit,
  nx: n,
  ny: n,
  size_x: 1e-3,
  size_y: 1e-3,
  from_nx: from,
  from_ny: from,
  reduction,
  data: Buffer.from(values.buffer).toString('base64'),
});

function viewOf(name) {
  const n = 128;
  const deep = name.startsWith('deep') ? 20 : 1;
  const z = wave(n, 1.2e-6 * deep);
  if (name.startsWith('surface')) return { title: 'Surface 1', event: 1, fields: [field('height', 'm', n, z)] };
  const top = 1.9e-6 * deep - 2e-7 * Number(/^state-(\d+)$/.exec(name)?.[1] ?? 0);
  return {
    title: 'Press 1',
    event: 2,
    fields: [
      field(
        'gap',
        'm',
        n,
        z.map((v) => Math.max(0, top - v)),
      ),
      field(
        'pressure',
        'Pa',
        n,
        z.map((v) => Math.max(0, v - top) * 2e15),
      ),
      field(
        'contact',
        '',
        n,
        z.map((v) => (v > top ? 1 : 0)),
      ),
    ],
  };
}

// Like gnuplot: a viewBox and no size.
const chart =
  '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 200"><style>path{stroke:#0b4f7d}</style><rect width="400" height="200" fill="white"/><path d="M20 180L380 20" fill="none"/><text x="30" y="40">Ra against N</text></svg>';

const pixel = Buffer.from(
  'iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==',
  'base64',
);

// A failed setting has no error.
const study = {
  rows: [
    { way: 'finer grid', knobs: { cells: 16 }, end: 'measured', value: 1.0054, error: 0.0054 },
    { way: 'finer grid', knobs: { cells: 32 }, end: 'measured', value: 1.00032, error: 0.00032 },
    { way: 'tighter, 64 cells', knobs: { cells: 64 }, end: 'measured', value: 1.0005, error: 0.0005 },
    { way: 'tighter, 64 cells', knobs: { cells: 64 }, end: 'failed', reason: 'no "answer", it says' },
  ],
  seconds: [0.0005, 0.0013, 0.0045, null],
};

/** "mock.knob NAME FROM TO VALUE UNIT [MOST]"; the script fails above MOST. */
function knobIn(line, given) {
  const found = /mock\.knob (\w+) (\S+) (\S+) (\S+) (\w+)(?: (\S+))?/.exec(line);
  if (!found) return undefined;
  const [, name, from, to, value, unit, most] = found;
  return {
    name,
    value: Number(given[name] ?? value),
    from: Number(from),
    to: Number(to),
    log: Number(from) > 0,
    unit,
    most: Number(most ?? Infinity),
  };
}

function knobsIn(script, given = {}) {
  const found = script.split('\n').flatMap((line) => knobIn(line, given) ?? []);
  return Object.fromEntries(found.map((k) => [k.name, k]));
}

/** The charts of a script, as the check and the run report them. Only literal keys at the beginning of a line. */
function chartsIn(script) {
  const found = [];
  let notebook = '';
  const valueOf = (table) => {
    const texts = [];
    const bare = table.replace(/"[^"]*"/g, (text) => `@${texts.push(text) - 1}@`);
    const lists = bare.replace(/\{([^{}=]*)\}/g, '[$1]').replace(/(\w+)=/g, '"$1":').replace(/,\s*}/g, '}');
    return JSON.parse(lists.replace(/@(\d+)@/g, (_, k) => texts[k]));
  };
  for (const [, name, table, study] of script.matchAll(/lab\.notebook ?\(?"(\w+)"|^book:chart(\{[^]*?\})\n|^(study):chart/gm)) {
    if (name) notebook = name;
    if (study) found.push({ type: 'chart', study: 'work_precision' });
    if (!table) continue;
    const { one_line_per: per = '', y, ...given } = valueOf(table);
    const usual = { log_x: false, log_y: false, title: '', x_label: '', y_label: '', where: {}, points: true, spread: false };
    found.push({ type: 'chart', notebook, chart: { ...usual, ...given, per, y: [y].flat() } });
  }
  return found;
}

/** Lines with instructions: `error "…"`, `os.exit(3)`, `mock.plain`, `while true`, `mock.limit`,
    `mock.flood`, `mock.alike`, `mock.rows N`, `mock.wide N`, `mock.columns NAME`, `mock.file NAME`, `mock.names N`,
    `mock.waits N`, `mock.guess NAME FOUND`, `mock.views N`, `mock.deep`, `mock.knob NAME FROM TO VALUE UNIT`. */
function* eventsOf(script, knobs, mock) {
  const lines = script.split('\n');
  const waits = Number(/mock\.waits (\d+)/.exec(script)?.[1] ?? 0);
  if (waits) {
    yield { type: 'waiting', before: waits };
    while (mock.full) yield 20;
  }
  yield { type: 'started' };
  if (!/mock\.plain/.test(script)) yield { type: 'view', name: 'surface-1', title: 'Surface 1: weierstrass_mandelbrot' };
  for (const [k, line] of lines.entries()) {
    const failing = /^\s*error\s*"(.*)"/.exec(line);
    if (failing) {
      yield { type: 'output', stream: 'err', text: 'about to fail\n' };
      yield {
        type: 'error',
        line: k + 1,
        message: failing[1],
        hint: 'mend that line',
        traceback: `script.lua:${k + 1}: in main chunk`,
      };
      yield { type: 'finished', status: 'failed', exit: 1, seconds: 0.2 };
      return;
    }
    const knob = knobIn(line, knobs);
    if (knob) {
      if (knob.value > knob.most) {
        yield { type: 'error', line: k + 1, message: `${knob.name} is too much` };
        yield { type: 'finished', status: 'failed', exit: 1, seconds: 0.2 };
        return;
      }
      yield { type: 'output', stream: 'out', text: `${knob.name} is ${knob.value}\n` };
    }
    const printed = /print\s*\(?"(.*)"/.exec(line);
    if (printed) yield { type: 'output', stream: 'out', text: printed[1] + '\n' };
    if (/mock\.flood/.test(line))
      for (let m = 0; m < 30000; ++m)
        yield { type: 'output', stream: 'out', text: `line ${m} of many, to fill the pane\n` };
    const rows = Number(/mock\.rows (\d+)/.exec(line)?.[1] ?? 0);
    for (let i = 1; i <= rows; ++i)
      yield { type: 'row', notebook: 'big', row: { level: 0.3 + i * 1e-14, i, v: i * i * 1e-6 }, units: { v: 'm' } };
    if (/mock\.alike/.test(line))
      for (const way of ['one', 'two'])
        for (let i = 1; i <= 4; ++i)
          yield { type: 'row', notebook: 'ways', row: { i, v: i < 4 ? i * i : way === 'one' ? 3 : 1, way } };
    if (/os\.exit\(3\)/.test(line)) {
      yield { type: 'finished', status: 'failed', exit: 3, seconds: 0.1, reason: 'os.exit(3)' };
      return;
    }
    const wide = Number(/mock\.wide (\d+)/.exec(line)?.[1] ?? 0);
    const columns = /mock\.columns (\S+)/.exec(line)?.[1] ?? 'column ';
    for (let i = 1; i <= wide; ++i) {
      const row = { i };
      for (let k = 0; k < wide; ++k) row[`${columns}${k}`] = i * 1e-6 * (k + 1);
      yield { type: 'row', notebook: 'wide', row, units: Object.fromEntries(Object.keys(row).slice(1).map((c) => [c, 'm'])) };
    }
    const [, guess, found] = /mock\.guess (\w+) (\S+)/.exec(line) ?? [];
    if (guess) yield { type: 'row', notebook: 'guesses', row: { guess, found: Number(found) || found } };
    if (/lab\.work_precision/.test(line)) yield { type: 'study', name: 'work_precision', ...study };
    const views = Number(/mock\.views (\d+)/.exec(line)?.[1] ?? 0);
    for (let v = 1; v <= views; ++v) yield { type: 'view', name: `state-${v}`, title: `contact:press at ${v} MPa` };
    for (const [, name] of line.matchAll(/mock\.file (\S+)/g))
      yield { type: 'file', name, bytes: chart.length, kind: 'chart' };
    const names = Number(/mock\.names (\d+)/.exec(line)?.[1] ?? 0);
    for (let i = 0; i < names; ++i)
      for (const rule of ['elastic', 'yielding'])
        yield {
          type: 'row',
          notebook: 'shares',
          row: { part: `part ${i + 1} of what the error is made of`, rule, share: (i + 1) / names + (rule === 'elastic' ? 0.1 : 0) },
        };
    if (/mock\.limit/.test(line)) {
      yield { type: 'finished', status: 'limit', exit: 1, seconds: 30, reason: 'the run took longer than 30 s' };
      return;
    }
    if (/while true/.test(line)) {
      for (let m = 0; ; m = Math.min(m + 1, 599)) {
        yield 100;
        yield {
          type: 'progress',
          task: 'half-space solve',
          fraction: m / 600,
          eta_s: (600 - m) / 10,
        };
      }
    }
    if (/for N/.test(line)) {
      for (let N = 1; N <= 8; ++N) {
        yield 30;
        yield { type: 'progress', task: 'events', fraction: N / 8, eta_s: 8 - N };
        for (const face of ['swell', 'fine']) {
          yield {
            type: 'row',
            notebook: 'tips',
            row: {
              N,
              face,
              Ra: (face === 'fine' ? 2.9e-6 : 2.2e-6) - N * 1e-7,
              mu: 0.3 + N / 50 + (face === 'fine' ? 0.05 : 0),
            },
            units: { Ra: 'm' },
          };
        }
        yield { type: 'output', stream: 'out', text: `event ${N}: Ra ${(2.9 - N / 10).toFixed(2)} um\n` };
      }
    }
  }
  if (!/mock\.plain/.test(script))
    yield { type: 'view', name: /mock\.deep/.test(script) ? 'deep-1' : 'press-1', title: 'Press 1: 152.8 MPa' };
  if (!/mock\.plain/.test(script)) yield { type: 'views_left_out', count: 7 };
  yield* chartsIn(script);
  yield { type: 'file', name: 'tips.csv', bytes: 512, kind: 'table' };
  yield { type: 'file', name: 'chart.svg', bytes: chart.length, kind: 'chart' };
  yield { type: 'expectation', text: 'Ra falls with N', held: true };
  yield { type: 'expectation', text: 'mu at most 0.4', held: false };
  yield { type: 'finished', status: 'done', exit: 0, seconds: 1.23 };
}

/** Two students; the mock's token is the teacher's, or a student's with `room: 'student'`. */
const people = [
  {
    name: 'Ada',
    help: false,
    predictions: [
      { lesson: '01_roughness', name: 'Ra', value: 0.5 },
      { lesson: '01_roughness', name: 'slope', value: 0.1 },
      { lesson: '03_boxes', name: 'depth', value: 'equal' },
    ],
    whys: [{ lesson: '03_boxes', text: 'springs <b>do not</b> know' }],
  },
  {
    name: 'Émilie',
    help: true,
    script: true,
    predictions: [
      { lesson: '01_roughness', name: 'Ra', value: 0.9 },
      { lesson: '03_boxes', name: 'depth', value: 'equal' },
    ],
    whys: [],
  },
];

/** Two dozen estimates around 30 and one of a million. */
const many = Array.from({ length: 25 }, (_, k) => ({
  name: `student ${k}`,
  help: false,
  predictions: [{ lesson: '03_boxes', name: 'spots', value: k === 9 ? 1e6 : 20 + k }],
  whys: [],
}));

export async function startMock(folder, { token = 'testtoken', port = 0, most = 2, room = '', crowd = false } = {}) {
  const told = []; // students' predictions
  let handed = { number: 0 };
  const runs = new Map();
  let cut = 0; // event streams to break
  const mock = { full: false }; // while true, runs of `mock.waits` wait
  const start = (script, name, knobs = {}) => {
    const run = { id: String(runs.size + 1), name, script, knobs, events: [], waiters: new Set(), stopped: false };
    const put = (event) => {
      run.events.push({ n: run.events.length + 1, ...event });
      run.waiters.forEach((w) => w());
    };
    runs.set(run.id, run);
    (async () => {
      for (const event of eventsOf(script, knobs, mock)) {
        if (run.stopped) return put({ type: 'finished', status: 'stopped', exit: 130, seconds: 0.5 });
        if (typeof event === 'number') await new Promise((r) => setTimeout(r, event));
        else put(event);
      }
    })();
    return run;
  };
  const over = (run) => run.events.at(-1)?.type === 'finished';

  const server = createServer(async (request, response) => {
    const url = new URL(request.url, 'http://x');
    const headers = {
      'Content-Security-Policy': policy,
      'X-Content-Type-Options': 'nosniff',
      'Referrer-Policy': 'no-referrer',
      'Cache-Control': 'no-store',
    };
    const send = (status, body, type = 'application/json') => {
      response.writeHead(status, { ...headers, 'Content-Type': type });
      response.end(type === 'application/json' ? JSON.stringify(body) : body);
    };
    try {
      if (!url.pathname.startsWith('/api/')) {
        const path = normalize(url.pathname === '/' ? '/index.html' : url.pathname);
        return send(200, await readFile(join(folder, path)), types[extname(path)] ?? 'application/octet-stream');
      }
      if (request.headers.authorization !== `Bearer ${token}`)
        return send(401, { error: { message: 'the token is missing or not this server’s' } });
      let text = '';
      for await (const piece of request) text += piece;
      const body = text ? JSON.parse(text) : {};
      const [, , what, id, part, ...rest] = url.pathname.split('/').map(decodeURIComponent);
      if (what === 'about')
        return send(200, {
          version: '0.3.0',
          limits: { memory_bytes: 1e9, seconds: 30, output_bytes: 1e6, runs: most },
          classroom: room !== '',
          documents: true,
          teacher: room === 'teacher',
        });
      if (room && (what === 'predictions' || what === 'help') && request.method === 'POST') {
        told.push({ what, ...body });
        return send(200, {});
      }
      if (room && what === 'handed') {
        if (request.method === 'POST') handed = { number: handed.number + 1, ...body };
        const known = url.searchParams.get('after') === String(handed.number);
        return send(200, known ? { number: handed.number } : handed);
      }
      if (room === 'teacher' && what === 'people' && id) return send(200, { name: 'Tilt it', script: 'local mu = "mine"\n' });
      if (room === 'teacher' && what === 'people') return send(200, crowd ? many : people);
      if (room === 'teacher' && what === 'room')
        return send(200, [
          { id: '1', name: '01_roughness', state: 'done', owner: 'Ada' },
          { id: '2', name: '02_dimension', state: 'running', owner: 'Émilie' },
        ]);
      if (what === 'lessons') {
        if (!id)
          return send(
            200,
            lessons.map(({ text: _t, script: _s, ...entry }) => entry),
          );
        const lesson = lessons.find((l) => l.name === id);
        return lesson ? send(200, lesson) : send(404, { error: { message: 'no such lesson' } });
      }
      if (what === 'check') {
        const marks = [];
        body.script.split('\n').forEach((line, k) => {
          const column = line.indexOf('amplitud=');
          if (column >= 0)
            marks.push({
              line: k + 1,
              column: column + 1,
              severity: 'error',
              message: 'unknown key `amplitud`',
              hint: 'did you mean `amplitude`?',
            });
        });
        const charts = chartsIn(body.script).filter((c) => c.notebook);
        return send(200, { marks, charts, knobs: knobsIn(body.script), checked_to: body.script.split('\n').length });
      }
      if (what === 'complete') {
        const before = body.text.slice(0, body.position);
        const word = /\w*$/.exec(before)[0];
        const all = /surface\.\w*$/.test(before)
          ? [
              ['flat', 'module', '{ cells, size }', 'A flat at height zero.'],
              ['sine', 'module', '{ cells, size, amplitude, … }', 'Waves along one way or two.'],
              [
                'self_affine',
                'module',
                '{ cells, size, hurst, … }',
                'A self-affine surface: its spectrum falls as a power of the wave number between roll-off and the shortest wave.',
              ],
            ]
          : [
              ['lab', 'global', 'the laboratory', 'Everything there is.'],
              ['local', 'keyword', '', ''],
            ];
        return send(200, {
          from: body.position - word.length,
          candidates: all
            .filter(([t]) => t.startsWith(word))
            .map(([t, kind, detail, help]) => ({ text: t, kind, detail, help })),
        });
      }
      if (what === 'runs' && !id) {
        if (request.method === 'GET')
          return send(
            200,
            [...runs.values()].map((r) => ({ id: r.id, name: r.name, state: over(r) ? 'finished' : 'running' })),
          );
        if ([...runs.values()].filter((r) => !over(r)).length >= most)
          return send(429, {
            error: {
              message: `${most} runs are going, as many as this server allows`,
              hint: 'wait until one has ended, or stop one',
            },
          });
        return send(201, { id: start(body.script, body.name, body.knobs).id });
      }
      const run = runs.get(id);
      if (!run) return send(404, { error: { message: `there is no run ${id}` } });
      if (request.method === 'DELETE') {
        run.stopped = true;
        return send(200, {});
      }
      if (part === 'events') {
        response.writeHead(200, { ...headers, 'Content-Type': 'application/x-ndjson' });
        let seen = Number(url.searchParams.get('after') ?? 0);
        const broken = cut > 0 && cut--;
        for (;;) {
          const news = run.events.slice(seen);
          seen += news.length;
          if (news.length) response.write(news.map((e) => JSON.stringify(e) + '\n').join(''));
          if (over(run) && seen === run.events.length) return response.end();
          if (broken && seen > 4) return response.destroy();
          await new Promise((r) => {
            run.waiters.add(r);
          });
          if (response.destroyed) return undefined;
        }
      }
      if (part === 'views') return send(200, viewOf(rest[0]));
      if (part === 'files' && rest[0] === 'manifest.json') {
        return send(200, { status: 'done', knobs: knobsIn(run.script, run.knobs) });
      }
      if (part === 'files')
        return rest[0].endsWith('.svg')
          ? send(200, chart, 'image/svg+xml')
          : rest[0].endsWith('.png')
            ? send(200, pixel, 'image/png')
          : send(200, 'N,Ra [m]\n1,2.8e-06\n', 'text/csv');
      return send(404, { error: { message: 'nothing is there' } });
    } catch (error) {
      if (!response.headersSent) send(error.code === 'ENOENT' ? 404 : 500, { error: { message: String(error) } });
      return undefined;
    }
  });
  await new Promise((r) => server.listen(port, '127.0.0.1', r));
  const address = `http://127.0.0.1:${server.address().port}`;
  return Object.assign(mock, {
    address,
    runs,
    url: `${address}/#${token}`,
    cut: (count) => (cut = count),
    told,
    quiet: () => [...runs.values()].every(over),
    close: () => {
      runs.forEach((run) => (run.stopped = true));
      return new Promise((r) => (server.closeAllConnections?.(), server.close(r)));
    },
  });
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const mock = await startMock(process.argv[2], { port: Number(process.argv[3] ?? 0) });
  console.log(mock.url);
}
