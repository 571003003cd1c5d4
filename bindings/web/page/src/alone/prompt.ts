// SPDX-License-Identifier: GPL-3.0-or-later
// The prompt: each line runs at once in a worker of its own, and shows its value. Stop and `exit` end the session.

import { h, saveAs } from '../dom';
import type { Laboratory, Line, Lines } from './laboratory';
import type { Files } from './module';

const greeting = 'help() explains, help "how do I turn" finds sentences, who lists variables, Tab completes, exit ends.\n';

export class PromptDialog {
  private readonly log = h('pre.output', { tabIndex: 0, role: 'log', 'aria-label': 'What the prompt shows' }, greeting);
  private readonly input = h('input', {
    type: 'text',
    autocomplete: 'off',
    spellcheck: false,
    'aria-label': 'A line of Lua',
    onkeydown: (event: KeyboardEvent) => this.key(event),
  });
  private readonly files = h('div.files', { role: 'group', 'aria-label': 'Files to save' });
  private readonly stop = h('button', { disabled: true, onclick: () => this.end('stopped: all variables are lost') }, 'Stop');
  private readonly close = h('button', { onclick: () => this.dialog.close() }, 'Close');
  private readonly dialog: HTMLDialogElement = h('dialog.prompt', { 'aria-label': 'Prompt' },
    h('h2', 'Prompt'), this.log, this.input, this.stop, this.close, this.files,
  );
  private lines: Lines | undefined;
  private readonly before: string[] = []; // earlier lines
  private at = 0; // place in them
  private continued = false;

  /** The button stands before `next`. */
  constructor(
    private readonly lab: Laboratory,
    next: HTMLElement,
  ) {
    document.body.append(this.dialog);
    const open = (): void => {
      this.dialog.showModal();
      this.input.focus();
    };
    next.before(h('button', { id: 'prompt-button', 'aria-haspopup': 'dialog', onclick: open }, 'Prompt'));
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (step !== undefined) {
      event.preventDefault();
      this.at = Math.min(this.before.length, Math.max(0, this.at + step));
      this.input.value = this.before[this.at] ?? '';
    } else if (event.key === 'Enter' && !this.busy) {
      const line = this.input.value;
      this.input.value = '';
      if (line.trim()) this.before.push(line);
      this.at = this.before.length;
      this.show(`${this.continued ? '>>' : '>'} ${line}\n`, 'said');
      this.lines ??= this.lab.prompt((told) => this.take(told));
      this.busy = true;
      this.lines.enter(line);
    } else if (event.key === 'Tab' && !event.shiftKey && /[\w.:]$/.test(this.input.value)) {
      event.preventDefault();
      this.complete().catch(() => undefined);
    }
  }

  /** Completes the last word as far as all candidates agree; after that, shows the candidates. */
  private async complete(): Promise<void> {
    const typed = this.input.value;
    const text = [...this.before, typed].join('\n');
    const { from, candidates } = await this.lab.complete(text, text.length);
    const begun = text.slice(from);
    const found = candidates.map((c) => c.text).filter((c) => c.startsWith(begun));
    if (found.length === 0 || this.input.value !== typed) return;
    let common = found[0];
    while (!found.every((c) => c.startsWith(common))) common = common.slice(0, -1);
    this.input.value = typed.slice(0, typed.length - begun.length) + common;
    if (common === begun) this.show(`${found.join('  ')}\n`, 'said');
  }

  private get busy(): boolean {
    return !this.stop.disabled;
  }

  private set busy(busy: boolean) {
    this.stop.disabled = !busy;
  }

  private take(told: Line): void {
    if ('text' in told) return this.show(told.text, told.stream);
    this.offer(told.files);
    if (told.next === 'end') return this.end('the session has ended; the next line begins another');
    this.continued = told.next === 'more';
    this.busy = false;
  }

  private end(why: string): void {
    this.lines?.end();
    this.lines = undefined;
    this.continued = this.busy = false;
    this.show(`${why}\n`, 'err');
    this.input.focus();
  }

  private offer(files: Files): void {
    const shown = [...files].filter(([name]) => !name.startsWith('store/'));
    const buttons = shown.map(([name, bytes]) => {
      const save = (): void => saveAs(name.split('/').pop()!, new Blob([bytes as BlobPart]));
      return h('button', { 'aria-label': `Save ${name}`, onclick: save }, name);
    });
    this.files.replaceChildren('Save: ', ...buttons);
  }

  private show(text: string, kind: string): void {
    this.log.append(h(`span.${kind}`, text));
    this.log.scrollTop = this.log.scrollHeight;
  }
}
