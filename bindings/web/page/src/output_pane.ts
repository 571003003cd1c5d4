// SPDX-License-Identifier: GPL-3.0-or-later
// Errors, output and expectations of a run. Long output loses its beginning. Tabular text scrolls; prose
// wraps.

import { h, prose } from './dom';
import { duration } from './units';
import { statusText, type Run } from './run';

/** Blocks end at empty lines; a block without columns is prose. */
function laidOut(text: string): (string | HTMLElement)[] {
  const parts: { text: string; columns: boolean }[] = [];
  for (const block of text.split(/(?<=\n)(?=\n)/)) {
    const columns = /\S(?: {2,}|\t)[ \t]*\S/.test(block);
    const last = parts[parts.length - 1];
    if (last?.columns === columns) last.text += block;
    else parts.push({ text: block, columns });
  }
  return parts.map((p) => (p.columns ? p.text : h('span', { className: 'prose' }, p.text)));
}

export function expectationItem(e: Run['expectations'][number]): HTMLElement {
  const verdict = h('b', {}, e.held ? '✓ held: ' : '✗ not held: ');
  return h('li', { className: e.held ? 'held' : 'failed' }, verdict, prose(e.text));
}

export class OutputPane {
  private readonly text = h('pre', { className: 'output', tabIndex: 0, 'aria-label': 'Output of the script' });
  private readonly errors = h('div', { className: 'errors' });
  private readonly expectations = h('ul', { className: 'expectations' });
  private readonly end = h('p', { className: 'end' });
  private readonly empty = h('p', { className: 'empty' }, 'Run the script to see here what it prints.');
  private drawn: { run: Run | undefined; errors: number; expectations: number } = {
    run: undefined,
    errors: -1,
    expectations: -1,
  };

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
    const fresh = this.drawn.run !== run;
    if (fresh) this.drawn = { run, errors: -1, expectations: -1 };
    if (this.drawn.errors !== run.errors.length) {
      this.drawn.errors = run.errors.length;
      this.errors.replaceChildren(...run.errors.map((e) => this.error(e)));
    }
    if (this.drawn.expectations !== run.expectations.length) {
      this.drawn.expectations = run.expectations.length;
      this.expectations.replaceChildren(...run.expectations.map(expectationItem));
    }
    const pane = this.element;
    const atEnd = fresh || pane.scrollHeight - pane.scrollTop - pane.clientHeight < 40;
    this.print(run);
    const last = run.active
      ? run.output.length
        ? ''
        : 'Nothing printed yet.'
      : statusText(run, duration) + (run.reason ? `: ${run.reason}` : '') + '.';
    this.end.textContent =
      run.status === 'done' && run.output.length === 0 && run.errors.length === 0
        ? `${last} The script printed nothing.`
        : last;
    this.end.className = `end ${run.status}`;
    if (run.errors.length > 0 && !run.active) pane.scrollTop = 0;
    else if (atEnd) pane.scrollTop = pane.scrollHeight;
  }

  private print(run: Run): void {
    const parts = run.output.flatMap((p) =>
      p.stream === 'err' ? [h('span', { className: 'err' }, ...laidOut(p.text))] : laidOut(p.text),
    );
    const dropped = run.outputDropped
      ? h('span', { className: 'dropped' }, `… the first ${run.outputDropped} characters are not shown\n`)
      : '';
    this.text.replaceChildren(dropped, ...parts);
  }

  private error(e: Run['errors'][number]): HTMLElement {
    const where =
      e.line === undefined
        ? null
        : h('button', { type: 'button', className: 'line', onclick: () => this.goTo(e.line!) }, `Line ${e.line}`);
    return h(
      'div',
      { className: 'failure' },
      h('p', {}, where, where ? ' ' : null, h('span', { className: 'message' }, prose(e.message))),
      e.hint ? h('p', { className: 'hint' }, prose(e.hint)) : null,
      e.traceback
        ? h('details', {}, h('summary', {}, 'Where it came from'), h('pre', { tabIndex: 0 }, e.traceback))
        : null,
    );
  }
}
