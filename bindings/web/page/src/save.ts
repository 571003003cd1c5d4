// SPDX-License-Identifier: GPL-3.0-or-later
// A run as one self-contained HTML file, with its variants at other knob values. The only script is
// `saved/player.ts`; the content policy allows its digest and nothing else. The file is serialised from a
// document: the browser escapes every text.

import type { Api } from './api';
import type { ChartPane } from './chart_pane';
import { h, prose } from './dom';
import { pictureClass, pictureType } from './files_pane';
import { lightInk } from './ink';
import { knobText } from './knobs';
import { expectationItem } from './output_pane';
import type { PicturePane } from './picture_pane';
import { statusText, type Run } from './run';
import { sequencesOf } from './saved/sequences';
import { csvOf, tableOf } from './table_pane';
import { duration } from './units';

/** Inserted by build.mjs: the bundled `saved/player.ts` and its digest. */
declare const SAVED_PLAYER: { text: string; digest: string };

const drawn = 60; // surfaces and contacts in a file

const style = `
:root { color-scheme: light; scroll-padding-top: 4rem; }
body { font: 17px/1.5 system-ui, sans-serif; color: #1c2126; background: #fff; max-width: 62rem; margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.7rem; margin: 0; } h2 { font-size: 1.25rem; margin: 2.2rem 0 .6rem; border-bottom: 1px solid #cfd5da; padding-bottom: .2rem; }
.about { color: #4d5963; margin-top: .2rem; }
pre { font: 15px/1.5 ui-monospace, "DejaVu Sans Mono", monospace; background: #f5f7f8; padding: .8rem 1rem; overflow-x: auto; }
pre.script { counter-reset: line; } pre.script span { counter-increment: line; display: block; min-height: 1.5em; padding-left: 3.2em; text-indent: -3.2em; white-space: pre-wrap; }
pre.script span::before { content: counter(line); display: inline-block; width: 2.4em; margin-right: .8em; text-indent: 0; text-align: right; color: #5f6b75; user-select: none; }
pre.script span.wrong { background: #fbe3e0; }
.error { border-left: 5px solid #b3261e; padding: .2rem .9rem; background: #fdf1f0; }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: .95em; } .err { color: #4d5963; } .held b { color: #00663f; } .failed b { color: #b3261e; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; } caption { text-align: left; color: #4d5963; padding: .3rem 0; }
th, td { padding: .2rem .8rem; border-bottom: 1px solid #dfe3e6; text-align: left; } .number, .index { text-align: right; } .index { color: #5f6b75; }
.scroll { overflow-x: auto; } figure { margin: 1rem 0; } figure svg, figure img { max-width: 100%; height: auto; } figure img.drawn { width: 100%; } figcaption { color: #4d5963; }
.scrubber, .sliders { display: flex; flex-wrap: wrap; gap: .3rem 1rem; align-items: center; } .scrubber .scrub { flex: 1; min-width: 12rem; } .choice { display: inline-flex; gap: .5rem; align-items: center; flex: 1 1 20rem; } .choice input { flex: 1; }
.sliders { position: sticky; top: 0; background: #fff; padding: .5rem 0; border-bottom: 1px solid #cfd5da; z-index: 1; } .sliders:empty { display: none; } .factor { min-width: 6em; font-variant-numeric: tabular-nums; }
button { font: inherit; min-width: 5em; padding: .2rem .8rem; } :focus-visible { outline: 3px solid #0b6fb8; outline-offset: 1px; } .frames figcaption b { display: block; color: #1c2126; }
@media screen { .away { display: none; } }
@media print { .scrubber, .sliders { display: none; } body { margin: 0; max-width: none; } figure, tr { break-inside: avoid; } }
`;

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
  missing: string[]; // names of missing parts
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
      content: `default-src 'none'; script-src '${SAVED_PLAYER.digest}'; style-src 'unsafe-inline'; img-src data:`,
    }),
    h('meta', { name: 'viewport', content: 'width=device-width, initial-scale=1' }),
    h('meta', { name: 'generator', content: `Asperity ${from.version}` }),
  );

  body.append(h('h1', {}, from.title), aboutOf(run, `Asperity ${from.version} · `));
  if (from.prediction) body.append(h('h2', {}, 'Prediction'), h('p', {}, from.prediction));
  if (run.knobs.length > 0) body.append(...knobsOf(run, from.recorded));
  body.append(h('h2', {}, 'Script'), scriptOf(run));
  const most = Math.max(2, Math.floor(drawn / from.recorded.length));
  const steps = new Map<string, number>();
  for (const one of from.recorded) {
    const several = from.recorded.length > 1;
    const results = h('section', { className: 'results' });
    results.dataset.at = JSON.stringify(
      Object.fromEntries(one.knobs.map((k) => [k.name, { value: k.value, text: knobText(k) }])),
    );
    if (one === run) results.dataset.first = '';
    if (several) results.append(h('h2', {}, `Recorded at ${valuesText(one)}`), aboutOf(one, ''));
    const lacking: string[] = [];
    await addResults(results, one, { from, missing: lacking, most, steps });
    missing.push(...lacking.map((m) => (several ? `${m} (${valuesText(one)})` : m)));
    body.append(results);
  }
  if (missing.length > 0)
    body.append(h('h2', {}, 'Not in this file'), h('ul', {}, ...missing.map((m) => h('li', {}, m))));
  // As text: the content policy forbids style and script elements even in a hidden document.
  const html = page.documentElement.outerHTML
    .replace('</head>', () => `<style>${style}</style></head>`)
    .replace(/<\/body>(?![^]*<\/body>)/, () => `<script>${SAVED_PLAYER.text}</script></body>`);
  return { html: `<!DOCTYPE html>\n${html}\n`, missing };
}

function aboutOf(run: Run, lead: string): HTMLElement {
  const reason = run.reason ? `: ${run.reason}` : '';
  const began = new Date(run.began).toLocaleString('en-GB');
  return h('p', { className: 'about' }, `${lead}${began} · ${statusText(run, duration)}${reason}`);
}

function valuesText(run: Run): string {
  return run.knobs.map((k) => `${k.name} ${knobText(k)}`).join(', ');
}

function knobsOf(run: Run, recorded: Run[]): HTMLElement[] {
  const fixed = recorded.length < 2;
  const how = fixed
    ? 'The values this run was made with. They are fixed here: it was recorded at no others.'
    : `${recorded.length} runs were recorded and are all in this file; it was saved at these values.`;
  return [
    h('h2', {}, 'Knobs'),
    h(
      'ul',
      {},
      ...run.knobs.map((k) => h('li', {}, `${k.name}: ${knobText(k)} (${knobText(k, k.from)} to ${knobText(k, k.to)})`)),
    ),
    h('p', { className: 'about' }, how),
    ...(fixed ? [] : [h('div', { className: 'sliders', role: 'group', 'aria-label': 'Recorded values of the knobs' })]),
  ];
}

async function addResults(body: HTMLElement, run: Run, filling: Filling): Promise<void> {
  const { from, missing } = filling;
  for (const e of run.errors) {
    body.append(
      h(
        'div',
        { className: 'error' },
        h('p', {}, e.line === undefined ? '' : `Line ${e.line}: `, prose(e.message)),
        e.hint ? h('p', {}, prose(e.hint)) : null,
        e.traceback ? h('pre', {}, e.traceback) : null,
      ),
    );
  }
  if (run.output.length > 0) {
    body.append(
      h('h2', {}, 'Output'),
      h(
        'pre',
        {},
        run.outputDropped ? `… the first ${run.outputDropped} characters are not kept\n` : '',
        ...run.output.map((p) => (p.stream === 'err' ? h('span', { className: 'err' }, p.text) : p.text)),
      ),
    );
  }
  if (run.expectations.length > 0) {
    body.append(h('h2', {}, 'Expectations'), h('ul', {}, ...run.expectations.map(expectationItem)));
  }
  const { drawChart } = await from.charts.library();
  const charts = from.charts.chartsFor(run);
  for (const notebook of run.notebooks.values()) {
    body.append(h('h2', {}, `Notebook: ${notebook.name}`));
    for (const { title, choice } of charts.filter((c) => c.notebook === notebook)) {
      const drawn = drawChart(notebook, choice, 860, 500, lightInk);
      const words = title === notebook.name ? '' : `${title}. `;
      body.append(h('figure', {}, drawn.element, h('figcaption', {}, `${words}${drawn.summary}.`)));
    }
    body.append(
      h('div', { className: 'scroll' }, tableOf(notebook)),
      h(
        'p',
        {},
        h(
          'a',
          {
            href: `data:text/csv;charset=utf-8,${encodeURIComponent(csvOf(notebook))}`,
            download: `${notebook.name}.csv`,
          },
          'These numbers as CSV, in SI',
        ),
      ),
    );
  }
  await addFiles(body, run, from, missing);
  await addViews(body, run, filling);
}

function scriptOf(run: Run): HTMLElement {
  const wrong = new Set(run.errors.map((e) => e.line));
  return h(
    'pre',
    { className: 'script' },
    ...run.script
      .replace(/\n$/, '')
      .split('\n')
      .map((line, k) => h('span', { className: wrong.has(k + 1) ? 'wrong' : '' }, line + '\n')),
  );
}

/** Numbered pictures form a sequence. */
async function addFiles(body: HTMLElement, run: Run, from: Sources, missing: string[]): Promise<void> {
  const names = [...run.files.keys()].filter((name) => pictureType(name));
  if (names.length > 0) body.append(h('h2', {}, 'Charts and pictures of the script'));
  for (const sequence of sequencesOf(names)) {
    const figures: HTMLElement[] = [];
    for (const name of sequence) {
      try {
        const blob = new Blob([await from.api.file(run.id, name)], { type: pictureType(name) });
        const image = h('img', { src: await dataAddress(blob), alt: name, className: pictureClass(name) });
        figures.push(titled(name, h('figure', {}, image, h('figcaption', {}, name))));
      } catch {
        missing.push(`the file ${name}, which the server did not give`);
      }
    }
    body.append(...framed(figures, `Picture of ${sequence.length}, ${sequence[0]} to ${sequence[sequence.length - 1]}`));
  }
}

async function addViews(body: HTMLElement, run: Run, { from, missing, most, steps }: Filling): Promise<void> {
  if (run.views.length === 0) return;
  if (run.views.length > most)
    missing.push(`the first ${run.views.length - most} of ${run.views.length} surfaces and contacts`);
  try {
    const drawings = await from.pictures.drawings(run, most, steps);
    const figures = drawings.map((d) =>
      titled(d.title, h('figure', {}, d.element, h('figcaption', {}, h('b', {}, d.title), ` ${d.text}. ${d.caption}.`))),
    );
    body.append(h('h2', {}, 'Surfaces and contacts'), ...framed(figures, 'Picture of the run'));
    if (run.viewsLeftOut > 0)
      body.append(
        h('p', { className: 'about' }, `${run.viewsLeftOut} more were made and not drawn, so as not to hold up the run.`),
      );
  } catch {
    missing.push('surfaces and contacts, which the server did not give');
  }
}

function titled(title: string, figure: HTMLElement): HTMLElement {
  figure.dataset.title = title;
  return figure;
}

function framed(figures: HTMLElement[], name: string): HTMLElement[] {
  if (figures.length < 2) return figures;
  const frames = h('div', { className: 'frames' }, ...figures);
  frames.dataset.name = name;
  return [frames];
}

function dataAddress(blob: Blob): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(reader.result as string);
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
  });
}
