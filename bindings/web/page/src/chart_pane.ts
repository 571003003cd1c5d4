// SPDX-License-Identifier: GPL-3.0-or-later
// Any column of a notebook against any other: which axes, a line for each value of which column, axes
// linear or logarithmic. It begins with what the script charts; a choice that is made stays with the
// notebook's name from run to run.

import { darkInk, drawChart, lightInk, type ChartChoice } from './chart';
import { Choice, h, saveAs } from './dom';
import { firstChoice, firstNotebook } from './first_chart';
import { numericColumns, type Notebook, type Run } from './run';

export class ChartPane {
  private run: Run | undefined;
  private asked = ''; // the notebook that was chosen by hand
  private readonly choices = new Map<string, ChartChoice>();
  private readonly which = new Choice('Notebook', (name) => {
    this.asked = name;
    this.draw();
  });
  private readonly x = new Choice('x', (x) => this.set({ x }));
  private readonly y = new Choice('y', (y) => this.set({ y }));
  private readonly per = new Choice('One line per', (per) => this.set({ per }));
  private readonly logX = h('input', { type: 'checkbox', onchange: () => this.set({ logX: this.logX.checked }) });
  private readonly logY = h('input', { type: 'checkbox', onchange: () => this.set({ logY: this.logY.checked }) });
  private readonly empty = h('p', { className: 'empty' });
  private readonly frame = h('div', { className: 'chart' });
  private readonly note = h('p', { className: 'caption' });
  private readonly body: HTMLElement;

  constructor(readonly element: HTMLElement) {
    const save = h('button', { type: 'button', onclick: () => this.save() }, 'Save SVG');
    this.body = h(
      'div',
      { className: 'charts' },
      h(
        'div',
        { className: 'choices' },
        this.which.element,
        this.x.element,
        this.y.element,
        this.per.element,
        h('span', { className: 'pair' }, h('label', {}, this.logX, ' log x'), h('label', {}, this.logY, ' log y')),
      ),
      this.frame,
      h('div', { className: 'below' }, this.note, save),
    );
    element.append(this.empty, this.body);
    new ResizeObserver(() => this.draw()).observe(this.frame);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.draw());
  }

  show(run: Run | undefined): void {
    this.run = run;
    const names = this.names();
    this.empty.hidden = names.length > 0;
    this.body.hidden = names.length === 0;
    this.empty.textContent = run?.active ? 'No row yet.' : 'Columns of a notebook are drawn here against each other.';
    if (names.length) this.draw();
  }

  /** The chart of a notebook as it is chosen, or as it would be at first. */
  choiceFor(run: Run, notebook: Notebook): ChartChoice | undefined {
    const columns = numericColumns(notebook);
    if (columns.length < 2) return undefined;
    const known = this.choices.get(notebook.name);
    if (known && columns.includes(known.x) && columns.includes(known.y)) {
      return notebook.columns.includes(known.per) ? known : { ...known, per: '' };
    }
    return firstChoice(run, notebook);
  }

  private names(): string[] {
    return [...(this.run?.notebooks.values() ?? [])].filter((n) => numericColumns(n).length >= 2).map((n) => n.name);
  }

  /** The notebook that is shown, and how. */
  private shown(): { notebook: Notebook; choice: ChartChoice } | undefined {
    const names = this.names();
    if (!this.run || names.length === 0) return undefined;
    const name = names.includes(this.asked) ? this.asked : firstNotebook(this.run, names);
    const notebook = this.run.notebooks.get(name)!;
    return { notebook, choice: this.choiceFor(this.run, notebook)! };
  }

  private set(change: Partial<ChartChoice>): void {
    const present = this.shown();
    if (present) this.choices.set(present.notebook.name, { ...present.choice, ...change });
    this.draw();
  }

  private draw(): void {
    const shown = this.shown();
    if (!shown || this.element.offsetParent === null) return;
    const { notebook, choice } = shown;
    const names = this.names();
    const options = (columns: string[]): { value: string; text: string }[] =>
      columns.map((c) => ({ value: c, text: c }));
    this.which.element.hidden = names.length < 2;
    this.which.choose(options(names), notebook.name);
    this.x.choose(options(numericColumns(notebook)), choice.x);
    this.y.choose(options(numericColumns(notebook)), choice.y);
    this.per.choose(
      [{ value: '', text: '(one line)' }, ...options(notebook.columns.filter((c) => c !== choice.x && c !== choice.y))],
      choice.per,
    );
    this.logX.checked = choice.logX;
    this.logY.checked = choice.logY;
    const ink = matchMedia('(prefers-color-scheme: dark)').matches ? darkInk : lightInk;
    const drawn = drawChart(
      notebook,
      choice,
      Math.max(280, this.frame.clientWidth),
      Math.max(220, this.frame.clientHeight),
      ink,
    );
    this.frame.replaceChildren(drawn.element);
    this.note.textContent =
      `${drawn.summary}.` +
      (drawn.left
        ? ` ${drawn.left} ${drawn.left === 1 ? 'row is' : 'rows are'} left out: no number${choice.logX || choice.logY ? ', or none above zero for a logarithmic axis' : ' in both columns'}.`
        : '');
  }

  private save(): void {
    const shown = this.shown();
    if (!shown) return;
    const { notebook, choice } = shown;
    const drawn = drawChart(notebook, choice, 900, 560, lightInk).element;
    saveAs(
      `${notebook.name} ${choice.y} against ${choice.x}.svg`.replace(/[^\w .-]/g, '_'),
      new Blob([new XMLSerializer().serializeToString(drawn)], { type: 'image/svg+xml' }),
    );
  }
}
