// SPDX-License-Identifier: GPL-3.0-or-later
// A run as one HTML file that opens anywhere: script, output, numbers, charts and pictures, all inside,
// nothing loaded from elsewhere and nothing executed (its own content policy forbids both). It is built as
// a document and serialised, so every text is escaped by the browser.

import type { Api } from './api';
import type { ChartPane } from './chart_pane';
import { h, prose } from './dom';
import { pictureClass, pictureType } from './files_pane';
import { lightInk } from './ink';
import { knobText } from './knobs';
import type { PicturePane } from './picture_pane';
import { statusText, type Run } from './run';
import { csvOf, tableOf } from './table_pane';
import { duration } from './units';

const style = `
:root { color-scheme: light; }
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
@media print { body { margin: 0; max-width: none; } figure, tr { break-inside: avoid; } }
`;

export interface Sources {
  api: Api;
  charts: ChartPane;
  pictures: PicturePane;
  version: string;
  title: string;
  prediction: string | null;
}

/** The file's text, and what could not be put in. */
export async function savedRun(run: Run, from: Sources): Promise<{ html: string; missing: string[] }> {
  const missing: string[] = [];
  const page = document.implementation.createHTMLDocument(`${from.title} – Asperity`);
  const body = page.body;
  page.documentElement.lang = 'en';
  page.head.prepend(
    h('meta', { charset: 'utf-8' }),
    h('meta', {
      'http-equiv': 'Content-Security-Policy',
      content: "default-src 'none'; style-src 'unsafe-inline'; img-src data:",
    }),
    h('meta', { name: 'viewport', content: 'width=device-width, initial-scale=1' }),
    h('meta', { name: 'generator', content: `Asperity ${from.version}` }),
  );

  const reason = run.reason ? `: ${run.reason}` : '';
  body.append(
    h('h1', {}, from.title),
    h(
      'p',
      { className: 'about' },
      `Asperity ${from.version} · ${new Date(run.began).toLocaleString('en-GB')} · ${statusText(run, duration)}${reason}`,
    ),
  );
  if (from.prediction) body.append(h('h2', {}, 'Prediction'), h('p', {}, from.prediction));
  if (run.knobs.length > 0)
    body.append(
      h('h2', {}, 'Knobs'),
      h(
        'ul',
        {},
        ...run.knobs.map((k) => h('li', {}, `${k.name}: ${knobText(k)} (${knobText(k, k.from)} to ${knobText(k, k.to)})`)),
      ),
    );
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
  body.append(h('h2', {}, 'Script'), scriptOf(run));
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
    body.append(
      h('h2', {}, 'Expectations'),
      h(
        'ul',
        {},
        ...run.expectations.map((e) =>
          h(
            'li',
            { className: e.held ? 'held' : 'failed' },
            h('b', {}, e.held ? '✓ held: ' : '✗ not held: '),
            prose(e.text),
          ),
        ),
      ),
    );
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
  await addPictures(body, run, from, missing);
  if (missing.length > 0)
    body.append(h('h2', {}, 'Not in this file'), h('ul', {}, ...missing.map((m) => h('li', {}, m))));
  // The sheet goes in as text: even in a document that nobody sees the policy of this page forbids it.
  const html = page.documentElement.outerHTML.replace('</head>', () => `<style>${style}</style></head>`);
  return { html: `<!DOCTYPE html>\n${html}\n`, missing };
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

async function addPictures(body: HTMLElement, run: Run, from: Sources, missing: string[]): Promise<void> {
  const files = [...run.files.values()].filter((f) => pictureType(f.name));
  if (files.length > 0) body.append(h('h2', {}, 'Charts and pictures of the script'));
  for (const f of files) {
    try {
      const blob = new Blob([await from.api.file(run.id, f.name)], { type: pictureType(f.name) });
      body.append(
        h(
          'figure',
          {},
          h('img', { src: await dataAddress(blob), alt: f.name, className: pictureClass(f.name) }),
          h('figcaption', {}, f.name),
        ),
      );
    } catch {
      missing.push(`the file ${f.name}, which the server did not give`);
    }
  }
  if (run.views.length === 0) return;
  const most = 16;
  if (run.views.length > most)
    missing.push(`the first ${run.views.length - most} of ${run.views.length} surfaces and contacts`);
  try {
    const drawings = await from.pictures.drawings(run, most);
    let last = '';
    for (const d of drawings) {
      if (d.title !== last) body.append(h('h2', {}, d.title));
      last = d.title;
      body.append(h('figure', {}, d.element, h('figcaption', {}, `${d.text}. ${d.caption}.`)));
    }
  } catch {
    missing.push('surfaces and contacts, which the server did not give');
  }
}

function dataAddress(blob: Blob): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(reader.result as string);
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
  });
}
