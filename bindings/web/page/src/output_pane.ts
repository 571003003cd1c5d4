// SPDX-License-Identifier: GPL-3.0-or-later
// Errors, output and expectations of a run. Long output loses its beginning. Tabular text scrolls; prose
// wraps.

import { h, prose } from './dom';
import { endText, type Run } from './run';

/** Blocks end at empty lines; a block without columns is prose. */
function laidOut(text: string): (string | HTMLElement)[] {
  const parts: { text: string; columns: boolean }[] = [];
  for (const block of text.split(/(?<=\n)(?=\n)/)) {
    const columns = /\S(?: {2,}|\t)[ \t]*\S/.test(block);
    const last = parts[parts.length - 1];
    if (last?.columns === columns) last.text += block;
    else parts.push({ text: block, columns });
  }
  return parts.map((p) => (p.columns ? p.text : h('span.prose', p.text)));
}

export function expectationItem(e: Run['expectations'][number]): HTMLElement {
  const verdict = h('b', e.held ? '✓ held: ' : '✗ not held: ');
  return h('li', { className: e.held ? 'held' : 'failed' }, verdict, prose(e.text));
}

export class OutputPane {
  private readonly text = h('pre.output', { tabIndex: 0, 'aria-label': 'Output of the script' });
  private readonly errors = h('div.errors');
  private readonly expectations = h('ul.expectations');
  private readonly end = h('p.end');
  private readonly empty = h('p.empty', 'Run the script to see here what it prints.');
  private drawn: Run | undefined;

  constructor(
    readonly element: HTMLElement,
    private readonly goTo: (line: number) => void,
  ) {
    element.append(this.empty, this.errors, this.text, this.expectations, this.end);
  }

  show(run: Run | undefined): void {
    this.empty.hidden = run !== undefined;
    this.text.hidden = run === undefined || run.output.length === 0;
    if (!run) return;
    const fresh = this.drawn !== run;
    this.drawn = run;
    if (fresh) [this.errors, this.expectations].forEach((list) => list.replaceChildren());
    // Tracebacks and selections stay open.
    this.errors.append(...run.errors.slice(this.errors.childElementCount).map((e) => this.error(e)));
    const drawn = this.expectations.childElementCount;
    this.expectations.append(...run.expectations.slice(drawn).map(expectationItem));
    const pane = this.element;
    const atEnd = fresh || pane.scrollHeight - pane.scrollTop - pane.clientHeight < 40;
    this.print(run);
    const silent = run.output.length === 0;
    if (run.active) this.end.textContent = silent ? 'Nothing printed yet.' : '';
    else if (run.status !== 'done' || !silent || run.errors.length > 0) this.end.textContent = `${endText(run)}.`;
    else this.end.textContent = `${endText(run)}. The script printed nothing.`;
    this.end.className = `end ${run.status}`;
    if (run.errors.length > 0 && !run.active) pane.scrollTop = 0;
    else if (atEnd) pane.scrollTop = pane.scrollHeight;
  }

  private print(run: Run): void {
    const parts = run.output.flatMap((p) =>
      p.stream === 'err' ? [h('span.err', ...laidOut(p.text))] : laidOut(p.text),
    );
    const dropped = run.outputDropped
      ? h('span.dropped', `… the first ${run.outputDropped} characters are not shown\n`)
      : '';
    this.text.replaceChildren(dropped, ...parts);
  }

  private error(e: Run['errors'][number]): HTMLElement {
    const where = e.line !== undefined && h('button.line', { onclick: () => this.goTo(e.line!) }, `Line ${e.line}`);
    return h('div.failure',
      h('p', where, where && ' ', h('span.message', prose(e.message))),
      e.hint && h('p.hint', prose(e.hint)),
      e.traceback && h('details', h('summary', 'Where it came from'), h('pre', { tabIndex: 0 }, e.traceback)),
    );
  }
}
