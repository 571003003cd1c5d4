// SPDX-License-Identifier: GPL-3.0-or-later
// The script's own charts, and charts of any columns of one unit against any other. A choice stays with the
// chart's name from run to run. The drawing library is loaded with the first chart.

import type { ChartChoice } from './chart_choice';
import { Choice, h, saveAs } from './dom';
import { chartsOf, columnsLike, type RunChart } from './first_chart';
import { inkNow, lightInk } from './ink';
import { columnsAlong, numericColumns, type Run } from './run';

type Drawing = typeof import('./chart');

const several = '\n'; // y: all present columns

export class ChartPane {
  private run: Run | undefined;
  private asked = ''; // by hand
  private drawing: Drawing | undefined;
  private readonly choices = new Map<string, ChartChoice>();
  private readonly which = new Choice('Chart', (name) => {
    this.asked = name;
    this.draw();
  });
  private readonly x = new Choice('x', (x) => this.set({ x }));
  private readonly y = new Choice('y', (y) => y !== several && this.set({ y: [y] }));
  private readonly more = new Choice('and', (y) => y && this.set({ y: [...this.shown()!.choice.y, y] }));
  private readonly per = new Choice('One line per', (per) => this.set({ per }));
  private readonly logX = h('input', { type: 'checkbox', onchange: () => this.set({ logX: this.logX.checked }) });
  private readonly logY = h('input', { type: 'checkbox', onchange: () => this.set({ logY: this.logY.checked }) });
  private readonly empty = h('p', { className: 'empty' });
  private readonly frame = h('div', { className: 'chart' });
  private readonly note = h('p', { className: 'caption' });
  private readonly body: HTMLElement;

  constructor(
    readonly element: HTMLElement,
    private readonly failed: (error: unknown) => void,
  ) {
    const save = h('button', { type: 'button', onclick: () => this.save() }, 'Save SVG');
    this.body = h(
      'div',
      { className: 'charts' },
      h(
        'div',
        { className: 'choices' },
        this.which.element,
        h(
          'details',
          { className: 'axes' },
          h('summary', {}, 'Axes'),
          h(
            'div',
            { className: 'choices' },
            this.x.element,
            this.y.element,
            this.more.element,
            this.per.element,
            h('span', { className: 'pair' }, h('label', {}, this.logX, ' log x'), h('label', {}, this.logY, ' log y')),
          ),
        ),
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
    const any = this.charts().length > 0;
    this.empty.hidden = any;
    this.body.hidden = !any;
    this.empty.textContent = run?.active ? 'No row yet.' : 'Columns of a notebook are drawn here against each other.';
    if (any) this.draw();
  }

  async library(): Promise<Drawing> {
    return (this.drawing ??= await import('./chart'));
  }

  chartsFor(run: Run): RunChart[] {
    return chartsOf(run).map((chart) => {
      const known = this.choices.get(chart.name);
      const columns = numericColumns(chart.notebook);
      if (!known || !columnsAlong(chart.notebook).includes(known.x) || !known.y.every((y) => columns.includes(y))) return chart;
      const per = chart.notebook.columns.includes(known.per) ? known.per : '';
      return { ...chart, choice: { ...known, per } };
    });
  }

  private charts(): RunChart[] {
    return this.run ? this.chartsFor(this.run) : [];
  }

  private shown(): RunChart | undefined {
    const charts = this.charts();
    return charts.find((c) => c.name === this.asked) ?? charts[0];
  }

  private set(change: Partial<ChartChoice>): void {
    const present = this.shown();
    const words = { ...(change.x ? { xLabel: '' } : {}), ...(change.y ? { yLabel: '' } : {}) };
    if (present) this.choices.set(present.name, { ...present.choice, ...words, ...change });
    this.draw();
  }

  private draw(): void {
    const shown = this.shown();
    if (!shown || this.element.offsetParent === null) return;
    const { notebook, choice } = shown;
    const charts = this.charts();
    const options = (columns: string[]): { value: string; text: string }[] =>
      columns.map((c) => ({ value: c, text: c }));
    const columns = numericColumns(notebook);
    this.which.element.hidden = charts.length < 2;
    this.which.choose(
      charts.map((c) => ({ value: c.name, text: c.title })),
      shown.name,
    );
    this.x.choose(options(columnsAlong(notebook)), choice.x);
    const together = choice.y.length > 1 ? [{ value: several, text: choice.y.join(', ') }] : [];
    this.y.choose([...together, ...options(columns)], choice.y.length > 1 ? several : choice.y[0]);
    const more = columnsLike(notebook, choice.y[0]).filter((c) => c !== choice.x && !choice.y.includes(c));
    this.more.element.hidden = more.length === 0;
    this.more.choose([{ value: '', text: '(no other)' }, ...options(more)], '');
    this.per.choose(
      [
        { value: '', text: '(one line)' },
        ...options(notebook.columns.filter((c) => c !== choice.x && !choice.y.includes(c))),
      ],
      choice.per,
    );
    this.logX.disabled = !columns.includes(choice.x); // names have no logarithm
    this.logX.checked = choice.logX && !this.logX.disabled;
    this.logY.checked = choice.logY;
    if (!this.drawing) {
      this.library().then(() => this.draw(), this.failed);
      return;
    }
    const drawn = this.drawing.drawChart(
      notebook,
      choice,
      Math.max(280, this.frame.clientWidth),
      Math.max(220, this.frame.clientHeight),
      inkNow(),
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
    if (!shown || !this.drawing) return;
    const { notebook, choice } = shown;
    const drawn = this.drawing.drawChart(notebook, choice, 900, 560, lightInk).element;
    saveAs(
      `${notebook.name} ${choice.y.join(' ')} against ${choice.x}.svg`.replace(/[^\w .-]/g, '_'),
      new Blob([new XMLSerializer().serializeToString(drawn)], { type: 'image/svg+xml' }),
    );
  }
}
