// SPDX-License-Identifier: GPL-3.0-or-later
// The page: connects the panes, which know only their run and the laboratory's interface. The laboratory is
// the server, or the WebAssembly module in a page of static files.

import { takeDrops } from './alone/dropped';
import { Laboratory } from './alone/laboratory';
import { linked } from './alone/linked';
import { PromptDialog } from './alone/prompt';
import { ApiError, runKey, Server, tokenHint, type About, type Api, type Mark, type SharedScript } from './api';
import { chartsOf, foretell } from './chart_choice';
import { ChartPane } from './chart_pane';
import { byId, h, prose, saveAs } from './dom';
import { Editor } from './editor';
import { FilesPane } from './files_pane';
import { HandButton, Offer, sent } from './handed';
import { KnobsPane } from './knobs';
import { divider, Filling, goRound, Messages, showPane, Tabs } from './layout';
import { LessonsPane, type Opened } from './lessons_pane';
import { Live, type Followed, type LivePicture } from './live';
import { OutputPane } from './output_pane';
import { PicturePane } from './picture_pane';
import { newcomer } from './newcomer';
import type { Guess } from './prediction_box';
import { HelpButton, Room } from './room';
import { endText, errorText, leftText, limitsText, Run, statusText } from './run';
import { RecordedRuns, savedRun } from './save';
import { offerFiles } from './script_file';
import { keep, keepScript, kept, keptScript, whenWrittenElsewhere } from './storage';
import { TablePane } from './table_pane';
import { Wall } from './wall';

const oneColumn = 1150; // px, as in page.css

declare const ALONE: boolean; // by build.mjs: static files, without a server
const here = ALONE ? new Laboratory() : undefined;
const api: Api = here ?? new Server();
const messages = new Messages(() => void greet());
const { say, failed } = messages;
const status = byId('status');
const bar = byId<HTMLProgressElement>('progress');
const runButton = byId<HTMLButtonElement>('run');
const stopButton = byId<HTMLButtonElement>('stop');
const saveButton = byId<HTMLButtonElement>('save');
let about: About | undefined;
let run: Run | undefined;
let runOf = ''; // document key
let listening: AbortController | undefined;
let recording: Run | undefined; // shown after its end
const openBefore = kept('open') ?? '';
const ownScript = (script = keptScript('own') ?? newcomer): Opened => ({
  key: 'own',
  title: 'Your own script',
  script,
  original: newcomer,
});
let opened = ownScript();
const recorded = new RecordedRuns();

// Panes ------------------------------------------------------------------------------------------

const hand = new HandButton(api, () => sent(opened.title, editor.text), failed);
const editor = new Editor(byId('editor'), api, {
  changed: (text) => {
    if (!keepScript(opened.key, text === opened.original ? null : text))
      say('This browser does not keep the script.');
    lessons.prediction?.read();
    hand.forget();
    showDocument();
  },
  checked: showProblems,
  found: (script, { marks, knobs: told, charts: foretold }) => {
    foretell(script, foretold ?? []);
    draw();
    if (marks.some((m) => m.severity === 'error')) return;
    knobs.know({ script, name: opened.title, key: opened.key }, told);
  },
  failed: (error) => failed(error),
});
const output = new OutputPane(byId('output'), (line) => {
  showPane('script', true);
  editor.goTo(line);
});
const table = new TablePane(byId('table'));
const charts = new ChartPane(byId('chart'), failed);
const pictures = new PicturePane(byId('picture'), api, failed, (): boolean => knobs.held);
const files = new FilesPane(byId('files'), api, failed);
const live = new Live(api, { answered, changed: draw, failed, looked: () => pictures.lookedAt });
const knobs = new KnobsPane(api, {
  again,
  stop,
  failed,
  keyOf: () => runOf,
  known: (done) => {
    if (run === done && done.status === 'done' && done.errors.length === 0) tabs.offer(madeBy(done));
    draw();
  },
  answering: () => live.busy,
  touched: (of) => live.warm(of),
  follow: (of, values, began) => {
    leaveRecording();
    live.move(of, values, began);
    return !live.failed;
  },
});
byId('tabs').after(knobs.element);
const tabs = new Tabs(byId('tabs'), () => {
  draw();
  showResults();
});
const offer = new Offer(api, (number, { name: title, script: original }) => {
  const key = `handed.${number}`;
  open({ key, title, script: keptScript(key) ?? original, original });
  void lessons.list();
});
const lessons = new LessonsPane(
  byId('lessons'),
  api,
  open,
  () => {
    open(ownScript());
    editor.focus();
  },
  offer.entry,
  { text: () => editor.text, replace: (script) => editor.replace(script) },
  predicted,
  failed,
);

function open(document: Opened): void {
  if (document.key !== opened.key) tabs.forgetChoice();
  opened = document;
  keep('open', document.key);
  editor.open(document.script);
  hand.forget();
  showPane('script', (kept(`script-pane.${document.key}`) ?? (document.hidesCode ? 'closed' : 'open')) === 'open');
  const code = document.script.split('\n').findIndex((line) => line.trim() && !line.startsWith('--'));
  if (code > 8) editor.showLine(code + 1);
  showDocument();
  draw();
}

/** In one column, results may be out of sight. */
function showResults(): void {
  if (innerWidth <= oneColumn) byId('results').scrollIntoView();
}

const toldAfter = 600; // ms without change
let toTell = 0;

/** For the classroom's teacher. */
function predicted(lesson: string, guesses: Guess[], why: string): void {
  if (!about?.classroom) return;
  const given = Object.fromEntries(guesses.filter((g) => g.value !== undefined).map((g) => [g.name, g.value!]));
  clearTimeout(toTell);
  toTell = window.setTimeout(() => api.predict(lesson, given, why).catch(failed), toldAfter);
}

function showDocument(): void {
  byId('script-title').textContent = opened.title;
  const edited = opened.key !== 'own' && keptScript(opened.key) !== null;
  byId('document').textContent = edited ? 'edited, kept in this browser' : '';
  byId('reset').hidden = !edited;
}

function showProblems(marks: Mark[]): void {
  const items = marks.slice(0, 20).map((m) =>
    h('li', { className: m.severity },
      h('button.line', { onclick: () => editor.goTo(m.line, m.column) }, `Line ${m.line}`),
      prose(m.message),
      m.hint ? h('span.hint', prose(`\n${m.hint}`)) : null,
    ),
  );
  byId('problems').replaceChildren(...items);
}

// The run ----------------------------------------------------------------------------------------

/** Of the open script. */
function fileName(): string {
  if (opened.key.startsWith('lesson.')) return opened.key.slice(7);
  return opened.key === 'own' ? 'script' : opened.title.slice(0, 60);
}

let asked = false;

function draw(): void {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    const shown = tabs.selected;
    knobs.show(run);
    if (shown === 'output') output.show(run);
    if (shown === 'table') table.show(run);
    if (shown === 'chart') charts.show(run);
    if (shown === 'picture') pictures.appear();
    if (shown === 'files') files.show(run);
    const rows = [...(run?.notebooks.values() ?? [])].map((n) => n.rows.length);
    tabs.count('table', rows.reduce((sum, n) => sum + n, 0));
    tabs.count('chart', run ? chartsOf(run).length : 0);
    tabs.count('picture', run?.views.length ?? 0);
    tabs.count('files', run?.files.size ?? 0);
    showWhose();
    lessons.prediction?.judge(runOf === opened.key ? run : undefined);
    showStatus();
  });
}

/** The line above the results. Results of another script are grey, with a note. */
function showWhose(): void {
  const line = byId('results-of');
  const elsewhere = run !== undefined && runOf !== opened.key;
  byId('results').classList.toggle('elsewhere', elsewhere);
  const words = [elsewhere ? 'not of the open script' : ''];
  if (run) {
    const time = new Date(run.began).toLocaleTimeString('en-GB', { hour: '2-digit', minute: '2-digit' });
    words.unshift(run.name, run.live ? 'live' : `run ${run.id}`, time);
  }
  const text = words.filter(Boolean).join(' · ') || 'No run yet';
  if (line.textContent !== text) line.textContent = text;
}

function showStatus(): void {
  runButton.disabled = !api.hasToken || run?.active === true;
  stopButton.disabled = run?.active !== true && !live.busy;
  saveButton.disabled = !run || run.active || run.live !== undefined;
  bar.hidden = run?.active !== true;
  status.className = `status ${run?.status ?? ''}`;
  if (live.isSlow && !run?.active && run?.live?.part !== 'coarse') {
    status.textContent = 'Live, computing …';
    return;
  }
  if (!run) {
    status.textContent = api.hasToken ? 'Ready' : 'No token';
    return;
  }
  const p = run.active ? run.progress : undefined;
  if (p?.fraction === undefined) bar.removeAttribute('value');
  else bar.value = p.fraction;
  const parts = [statusText(run), run.live && recording ? 'being recorded' : ''];
  if (p) {
    parts.push(p.task);
    if (p.fraction !== undefined) parts.push(`${Math.floor(100 * p.fraction)} %`);
    parts.push(leftText(p));
  }
  status.textContent = parts.filter(Boolean).join(' · ');
  status.title = status.textContent;
}

let announced = 0;

function announce(): void {
  const p = run?.progress;
  if (p?.fraction === undefined || Date.now() - announced < 8000) return;
  announced = Date.now();
  say([`${Math.floor(100 * p.fraction)} per cent`, leftText(p)].filter(Boolean).join(', '));
}

let waitsForEnd = false; // shown by the banner
const askedWithout = new Set<string>(); // lessons

/** Once for each lesson: whether to run without a prediction. */
function asksFirst(): boolean {
  const { prediction } = lessons;
  if (!prediction?.isOpen || opened.key !== `lesson.${prediction.lesson}` || askedWithout.has(opened.key)) return false;
  askedWithout.add(opened.key);
  const before = document.activeElement as HTMLElement | null;
  const back = (): void => (before === byId('editor') ? editor.focus() : before?.focus());
  messages.question('Run without a prediction?', {
    'Predict first': () => {
      showLessons(true);
      prediction.focus();
    },
    'Run anyway': () => {
      back();
      void start();
    },
  });
  return true;
}

function isBusy(): boolean {
  if (!run?.active) return false;
  waitsForEnd = true;
  messages.tell('A script is still running.', 'Stop it with Escape, or wait until it has ended; then run this one.');
  return true;
}

async function start(): Promise<void> {
  if (!api.hasToken) return;
  if (isBusy() || asksFirst()) return;
  const script = editor.text;
  leaveRecording();
  editor.showRunMarks([]);
  runButton.disabled = true;
  try {
    const { id } = await api.start(script, fileName());
    messages.clear();
    follow(new Run(id, opened.title, script), opened.key);
    say('The script runs.');
  } catch (error) {
    failed(error);
  }
  showStatus();
}

/** Runs a script with other knob values; false if a run is active. */
async function again(of: Followed, values: Record<string, string>): Promise<boolean> {
  if (run?.active) return false;
  const quietly = run?.live !== undefined && run.script === of.script;
  const { id } = await api.start(of.script, of.name, values);
  messages.clear();
  follow(new Run(id, of.name, of.script), of.key, quietly);
  return true;
}

function answered(next: Run, of: Followed, picture: LivePicture | undefined, began: number): void {
  if (run?.active) return;
  run = next;
  runOf = of.key;
  if (next.live?.part === 'whole') charts.tried(next);
  pictures.succeed(next, picture, began);
  draw();
}

function leaveRecording(): void {
  if (!recording) return;
  listening?.abort();
  api.stop(recording.id).catch(failed);
  recording = undefined;
}

/** `quietly`: live results stay until the end. */
function follow(next: Run, key: string, quietly = false): void {
  listening?.abort();
  const mine = (listening = new AbortController());
  const { id, name, script, began } = next;
  sessionStorage.setItem(runKey, JSON.stringify({ id, name, script, began, key }));
  announced = Date.now();
  if (quietly) {
    recording = next;
  } else {
    recording = undefined;
    live.forget();
    run = next;
    runOf = key;
    pictures.show(run);
  }
  draw();
  api
    .events(
      next.id,
      0,
      (event) => {
        next.take(event);
        if (recording === next && event.type === 'finished') {
          recording = undefined;
          run = next;
          runOf = key;
          pictures.succeed(next);
        }
        if (run !== next) return;
        if (event.type === 'error') markError();
        if (event.type === 'finished') ended(next);
        announce();
        draw();
      },
      (error) => (error ? failed(error) : messages.clear()),
      mine.signal,
    )
    .catch((error) => {
      if (mine.signal.aborted || (run !== next && recording !== next)) return;
      recording = undefined;
      next.status = 'lost';
      failed(error);
      draw();
    });
}

function markError(): void {
  if (!run || editor.text !== run.script) return;
  const marks = run.errors.flatMap(({ line, message, hint }): Mark[] =>
    line === undefined ? [] : [{ line, severity: 'error', message, hint }],
  );
  editor.showRunMarks(marks);
}

function ended(done: Run): void {
  if (waitsForEnd) messages.clear();
  waitsForEnd = false;
  recorded.add(done);
  charts.tried(done);
  if (tabs.selected === 'output') output.show(done); // before another tab is shown
  if (done.errors.length > 0 || (done.status === 'limit' && done.notebooks.size === 0)) tabs.select('output');
  else if (done.status === 'done') tabs.offer(madeBy(done));
  else if (done.status === 'failed') tabs.offer('output'); // by exit status only
  if (runOf === opened.key) showResults();
  say(`${endText(done)}. ${errorText(done.errors[0])}`.trim());
}

/** Charts of the script, then pictures, then output. A picture follows knobs, printed lines do not. */
function madeBy(done: Run): string {
  if (chartsOf(done).some((c) => c.asked)) return 'chart';
  if ([...done.files.keys()].some((name) => name.endsWith('.png'))) return 'files';
  if (done.views.length > 0 && (done.output.length === 0 || done.knobs.length > 0)) return 'picture';
  if (done.output.length > 0) return 'output';
  return done.notebooks.size > 0 ? 'table' : 'output';
}

async function stop(): Promise<void> {
  if (live.busy) {
    live.end();
    draw();
  }
  if (!run?.active) return;
  stopButton.disabled = true;
  say('Stopping.');
  try {
    await api.stop(run.id);
  } catch (error) {
    failed(error);
    stopButton.disabled = false;
  }
}

async function save(): Promise<void> {
  if (!run || run.active || run.live) return;
  saveButton.disabled = true;
  saveButton.textContent = 'Saving …';
  say('The run is being gathered.');
  try {
    const lesson = opened.key.startsWith('lesson.') ? opened.key.slice(7) : '';
    const { html, missing } = await savedRun(run, {
      api,
      charts,
      pictures,
      version: about?.version ?? '',
      title: run.name,
      recorded: await recorded.beside(run, api),
      prediction: runOf === opened.key && lesson ? kept(`prediction.${lesson}`) : null,
    });
    const words = run.name.toLowerCase().match(/[\p{L}\p{N}]+/gu) ?? ['run'];
    saveAs(`${words.join('-')}.html`, new Blob([html], { type: 'text/html;charset=utf-8' }));
    say(missing.length ? `Saved, without ${missing.join(', ')}.` : 'Saved.');
  } catch (error) {
    failed(error);
  }
  saveButton.textContent = 'Save run';
  showStatus();
}

// The start --------------------------------------------------------------------------------------

function showLessons(on: boolean): void {
  showPane('lessons', on);
  keep('lessons', on ? null : 'closed');
}

/** Repeated after a failure. */
async function greet(): Promise<void> {
  if (!api.hasToken) {
    messages.tell(
      api.addressDamaged
        ? 'The address of this page is damaged: after its # a percent sign begins no character.'
        : 'This page was opened without its token.',
      tokenHint,
    );
    return;
  }
  try {
    const again = about !== undefined || messages.watching;
    about = await api.about();
    messages.answered();
    if (again) {
      messages.clear();
      editor.checkSoon(0);
    }
    byId('about').textContent = limitsText(about);
    byId('documents').hidden = about.documents !== true;
    const student = about.classroom === true && about.teacher !== true;
    room?.offer(about.teacher === true);
    hand.offer(about.teacher === true);
    wall?.offer(about.teacher === true);
    help.offer(student, about.help === true);
    offer.begin(student);
    if (!lessons.element.querySelector('.lessons, .lesson')) await firstLessons();
  } catch (error) {
    if (!messages.watching || !(error instanceof ApiError) || error.failure !== 'gone') failed(error);
  }
}

async function firstLessons(): Promise<void> {
  await lessons.list();
  const link = here && (await linked(here));
  if (link?.kind === 'lesson') return lessons.show(link.name, true);
  if (link) {
    const { name: title, script: original } = link;
    const key = `linked.${title}`;
    return open({ key, title, script: link.kind === 'script' ? original : (keptScript(key) ?? original), original });
  }
  if (openBefore.startsWith('lesson.')) await lessons.show(openBefore.slice(7), false);
}

/** After a reload. */
function resume(): void {
  try {
    const last = JSON.parse(sessionStorage.getItem(runKey) ?? 'null') as (Run & { key: string }) | null;
    if (last && api.hasToken) follow(new Run(last.id, last.name, last.script, last.began), last.key);
  } catch {
    sessionStorage.removeItem(runKey);
  }
}

whenWrittenElsewhere((key, text) => {
  if (key !== opened.key || text === editor.text) return;
  messages.tell(
    'This script is also being edited in another tab.',
    'Each tab keeps its own text, also when it is loaded again; a new tab shows what was written last.',
  );
});
runButton.addEventListener('click', () => void start());
stopButton.addEventListener('click', () => void stop());
saveButton.addEventListener('click', () => void save());
byId('reset').addEventListener('click', () => {
  editor.replace(opened.original);
  editor.focus();
  say('The lesson’s own script is back. Control Z brings your edits again.');
});
byId('save-script').addEventListener('click', () =>
  saveAs(`${fileName()}.lua`, new Blob([editor.text], { type: 'text/plain;charset=utf-8' })),
);
function openText(text: string): void {
  open(ownScript(text));
  keepScript('own', text);
  void lessons.list();
  editor.focus();
}
offerFiles(openText, messages);
if (here)
  takeDrops(here, messages, {
    opened: openText,
    replayed: (folder) => {
      if (isBusy()) return;
      here.replay(folder).then(({ id }) => follow(new Run(id, `Replay of ${folder}`, ''), 'replay'), failed);
    },
  });
byId('lessons-button').addEventListener('click', () => showLessons(byId('lessons').hidden));
byId('script-button').addEventListener('click', () => {
  showPane('script', byId('script').hidden);
  keep(`script-pane.${opened.key}`, byId('script').hidden ? 'closed' : 'open');
});
const openOf = (student: string, { name, script }: SharedScript): void => {
  open({ key: `of.${student}`, title: `${name} of ${student}`, script, original: script });
  void lessons.list();
};
const room = ALONE ? undefined : new Room(api, openOf, failed);
const wall = ALONE ? undefined : new Wall(api, failed);
const help = new HelpButton(api, () => sent(opened.title, editor.text, 20_000), failed);
const filling = new Filling(byId<HTMLButtonElement>('fill'), byId('results'), (on) => {
  byId('fill').textContent = on ? 'Put it back' : 'Fill the window';
  draw();
});
const keys = byId<HTMLDialogElement>('keys');
byId('keys-close').addEventListener('click', () => keys.close());
byId('keys-button').addEventListener('click', () => keys.showModal());
const openDialog = (): Element | null => document.querySelector('dialog[open]');
document.addEventListener(
  'keydown',
  (event) => {
    if (event.key === 'Enter' && (event.ctrlKey || event.metaKey)) {
      event.preventDefault();
      void start();
    } else if (event.key === 'Escape' && filling.on && !openDialog()) {
      filling.set(false);
    } else if (event.key === 'Escape' && (run?.active || live.busy) && !openDialog() && !editor.wantsEscape) {
      void stop();
    }
  },
  true,
);
divider(byId('lessons-divider'), 'lessons-width', 23, 15, 45);
divider(byId('results-divider'), 'results-width', 37, 25, 65, true);
goRound([
  { element: byId('lessons'), enter: () => byId('lessons').querySelector<HTMLElement>('button')?.focus() },
  { element: byId('script'), enter: () => editor.focus() },
  { element: byId('results'), enter: () => tabs.focus() },
]);
showLessons(kept('lessons') !== 'closed');
open(opened);
showStatus();
draw();
resume();
void greet();
if (here) new PromptDialog(here, byId('keys-button'));
performance.mark('asperity-ready');
