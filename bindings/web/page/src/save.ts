// SPDX-License-Identifier: GPL-3.0-or-later
// A run as one self-contained HTML file, with its variants at other knob values. The content policy allows
// one script, `saved/player.ts`, by its digest. The file is serialised from a document: the browser escapes
// every text.

import type { Api } from './api';
import type { ChartPane } from './chart_pane';
import { h, prose } from './dom';
import { pictureClass, pictureType } from './files_pane';
import { lightInk } from './colour';
import { knobText, readKnobs, valuesText, type Knob } from './knobs';
import { expectationItem } from './output_pane';
import { leftOutText, type PicturePane } from './picture_pane';
import { endText, errorText, type Run } from './run';
import { csvOf, tableOf } from './table_pane';
import { grouped } from './units';

/** Inserted by build.mjs: `saved/saved.css`, and the bundled `saved/player.ts` with its digest. */
declare const SAVED: { style: string; script: string; digest: string };

const drawn = 60; // in a file

export interface Sources {
  api: Api;
  charts: ChartPane;
  pictures: PicturePane;
  version: string;
  title: string;
  prediction: string | null;
  recorded: Run[]; // at several knob values
}

/** `most` drawings; `steps`: exaggeration by relief. */
interface Filling {
  from: Sources;
  missing: string[]; // missing parts
  most: number;
  steps: Map<string, number>;
}

export async function savedRun(run: Run, from: Sources): Promise<{ html: string; missing: string[] }> {
  const missing: string[] = [];
  const page = document.implementation.createHTMLDocument(`${from.title} – Asperity`);
  const body = h('main');
  page.body.append(body);
  page.documentElement.lang = 'en';
  page.head.prepend(
    h('meta', { charset: 'utf-8' }),
    h('meta', {
      'http-equiv': 'Content-Security-Policy',
      content: `default-src 'none'; script-src '${SAVED.digest}'; style-src 'unsafe-inline'; img-src data:`,
    }),
    h('meta', { name: 'viewport', content: 'width=device-width, initial-scale=1' }),
    h('meta', { name: 'generator', content: `Asperity ${from.version}` }),
  );

  body.append(h('h1', from.title), aboutOf(run, `Asperity ${from.version} · `));
  if (from.prediction) body.append(h('h2', 'Prediction'), h('p', from.prediction));
  if (run.knobs.length > 0) body.append(...knobsOf(run, from.recorded));
  body.append(h('h2', 'Script'), scriptOf(run));
  const most = Math.max(2, Math.floor(drawn / from.recorded.length));
  const steps = new Map<string, number>();
  for (const one of from.recorded) {
    const several = from.recorded.length > 1;
    const at = Object.fromEntries(one.knobs.map((k) => [k.name, { value: k.value, text: knobText(k) }]));
    const first = one === run || undefined;
    const results = h('section.results', { 'data-at': JSON.stringify(at), 'data-first': first });
    if (several) results.append(h('h2', `Recorded at ${valuesText(one.knobs)}`), aboutOf(one, ''));
    const lacking: string[] = [];
    await addResults(results, one, { from, missing: lacking, most, steps });
    missing.push(...lacking.map((m) => (several ? `${m} (${valuesText(one.knobs)})` : m)));
    body.append(results);
  }
  if (missing.length > 0)
    body.append(h('h2', 'Not in this file'), h('ul', ...missing.map((m) => h('li', m))));
  // As text: the content policy forbids style and script elements even in a hidden document.
  const html = page.documentElement.outerHTML
    .replace('</head>', () => `<style>${SAVED.style}</style></head>`)
    .replace(/<\/body>(?![^]*<\/body>)/, () => `<script>${SAVED.script}</script></body>`);
  return { html: `<!DOCTYPE html>\n${html}\n`, missing };
}

function aboutOf(run: Run, lead: string): HTMLElement {
  const began = new Date(run.began).toLocaleString('en-GB');
  return h('p.about', `${lead}${began} · ${endText(run)}`);
}

const boundsText = (k: Knob): string => `${knobText(k, k.from)} to ${knobText(k, k.to)}`;

function knobsOf(run: Run, recorded: Run[]): HTMLElement[] {
  const fixed = recorded.length < 2;
  const how = fixed
    ? 'The values this run was made with. They are fixed here: it was recorded at no others.'
    : `${recorded.length} runs were recorded and are all in this file; it was saved at these values.`;
  return [
    h('h2', 'Knobs'),
    h('ul', ...run.knobs.map((k) => h('li', `${k.name}: ${knobText(k)} (${boundsText(k)})`))),
    h('p.about', how),
    ...(fixed ? [] : [h('div.sliders', { role: 'group', 'aria-label': 'Recorded values of the knobs' })]),
  ];
}

async function addResults(body: HTMLElement, run: Run, filling: Filling): Promise<void> {
  const { from, missing } = filling;
  for (const e of run.errors) {
    const [hint, traceback] = [e.hint && h('p', prose(e.hint)), e.traceback && h('pre', e.traceback)];
    body.append(h('div.error', h('p', prose(errorText(e))), hint, traceback));
  }
  if (run.output.length > 0) {
    const dropped = run.outputDropped ? `… the first ${run.outputDropped} characters are not kept\n` : '';
    const printed = run.output.map((p) => (p.stream === 'err' ? h('span.err', p.text) : p.text));
    body.append(h('h2', 'Output'), h('pre', dropped, ...printed));
  }
  if (run.expectations.length > 0) {
    body.append(h('h2', 'Expectations'), h('ul', ...run.expectations.map(expectationItem)));
  }
  const { drawChart } = await from.charts.library();
  const charts = from.charts.chartsFor(run);
  for (const notebook of run.notebooks.values()) {
    body.append(h('h2', `Notebook: ${notebook.name}`));
    for (const { title, choice } of charts.filter((c) => c.notebook === notebook)) {
      const drawn = drawChart(notebook, choice, 860, 500, lightInk);
      const words = title === notebook.name ? '' : `${title}. `;
      body.append(h('figure', drawn.element, h('figcaption', `${words}${drawn.summary}.`)));
    }
    const href = `data:text/csv;charset=utf-8,${encodeURIComponent(csvOf(notebook))}`;
    const file = h('a', { href, download: `${notebook.name}.csv` }, 'These numbers as CSV, in SI');
    body.append(h('div.scroll', tableOf(notebook)), h('p', file));
  }
  await addFiles(body, run, from, missing);
  await addViews(body, run, filling);
}

function scriptOf(run: Run): HTMLElement {
  const wrong = new Set(run.errors.map((e) => e.line));
  const lines = run.script.replace(/\n$/, '').split('\n');
  return h('pre.script', ...lines.map((line, k) => h(wrong.has(k + 1) ? 'span.wrong' : 'span', `${line}\n`)));
}

/** Numbered pictures form a sequence. */
async function addFiles(body: HTMLElement, run: Run, from: Sources, missing: string[]): Promise<void> {
  const names = [...run.files.keys()].filter((name) => pictureType(name));
  if (names.length > 0) body.append(h('h2', 'Charts and pictures of the script'));
  for (const sequence of sequencesOf(names)) {
    const figures: HTMLElement[] = [];
    for (const name of sequence) {
      try {
        const blob = new Blob([await from.api.file(run.id, name)], { type: pictureType(name) });
        const image = h('img', { src: await dataAddress(blob), alt: name, className: pictureClass(name) });
        figures.push(h('figure', { 'data-title': name }, image, h('figcaption', name)));
      } catch {
        missing.push(`the file ${name}, which the server did not give`);
      }
    }
    body.append(...framed(figures, `Picture of ${sequence.length}, ${sequence[0]} to ${sequence.at(-1)}`));
  }
}

async function addViews(body: HTMLElement, run: Run, { from, missing, most, steps }: Filling): Promise<void> {
  if (run.views.length === 0) return;
  if (run.views.length > most)
    missing.push(`the first ${run.views.length - most} of ${run.views.length} surfaces and contacts`);
  try {
    const drawings = await from.pictures.drawings(run, most, steps);
    const figures = drawings.map(({ title, text, caption, element }) =>
      h('figure', { 'data-title': title }, element, h('figcaption', h('b', title), ` ${text}. ${caption}.`)),
    );
    body.append(h('h2', 'Surfaces and contacts'), ...framed(figures, 'Picture of the run'));
    if (run.viewsLeftOut > 0)
      body.append(h('p.about', leftOutText(run)));
  } catch {
    missing.push('surfaces and contacts, which the server did not give');
  }
}

function framed(figures: HTMLElement[], name: string): HTMLElement[] {
  return figures.length < 2 ? figures : [h('div.frames', { 'data-name': name }, ...figures)];
}

function dataAddress(blob: Blob): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(reader.result as string);
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
  });
}

/** `press-1.png`, `press-2.png`, `press-3.png`, at the first name. Two pictures, and SVG drawings, form no
    sequence. */
function sequencesOf(names: string[]): string[][] {
  return [...grouped(names, (name) => name.replace(/\d+/g, '#'))].flatMap(([kind, alike]) =>
    /#.*\.png$/i.test(kind) && alike.length >= 3 ? [alike] : alike.map((name) => [name]),
  );
}

const mostRuns = 40; // stored

/** This tab's runs of one script at several knob values. Later runs replace runs with the same values. */
export class RecordedRuns {
  private runs: Run[] = [];

  add(run: Run): void {
    if (run.script !== this.runs[0]?.script) this.runs = [];
    this.runs = [...this.runs, run].slice(-mostRuns);
  }

  /** Ordered by value. */
  async beside(run: Run, api: Api): Promise<Run[]> {
    const ended = this.runs.filter((r) => r.script === run.script && (r.status === 'done' || r.status === 'failed'));
    await Promise.all([run, ...ended].map((r) => readKnobs(r, api))); // perhaps none yet
    if (run.knobs.length === 0) return [run];
    const alike = ended.filter((r) => namesOf(r) === namesOf(run));
    const known = new Map([...alike, run].map((r) => [valuesOf(r).join(), r]));
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
