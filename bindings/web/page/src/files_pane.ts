// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a run, fetched on request; pictures with the pane.

import type { Api } from './api';
import { h, saveAs } from './dom';
import type { Run } from './run';
import { bytes } from './units';

const types: Record<string, string> = { svg: 'image/svg+xml', png: 'image/png' };

export function pictureType(name: string): string | undefined {
  return types[name.slice(name.lastIndexOf('.') + 1).toLowerCase()];
}

/** SVG may lack a size and then fills the width. */
export function pictureClass(name: string): string {
  return pictureType(name) === types.svg ? 'drawn' : '';
}

/** Full page, until Escape or Close. */
function enlarged(name: string, address: string): void {
  const dialog = h('dialog.enlarged', { 'aria-label': name, onclose: () => dialog.remove() });
  const close = h('button.primary', { onclick: () => dialog.close() }, 'Close');
  dialog.append(h('img', { src: address, alt: `The picture ${name} of the run` }), h('p', close, name));
  document.body.append(dialog);
  dialog.showModal();
}

export class FilesPane {
  private run: Run | undefined;
  private drawn = '';
  private readonly addresses = new Map<string, string>();
  private readonly empty = h('p.empty');
  private readonly list = h('ul.files');
  private readonly previews = h('div.previews');

  constructor(
    readonly element: HTMLElement,
    private readonly api: Api,
    private readonly failed: (error: unknown) => void,
  ) {
    element.append(this.empty, this.previews, this.list);
  }

  show(run: Run | undefined): void {
    if (run !== this.run) {
      for (const address of this.addresses.values()) URL.revokeObjectURL(address);
      this.addresses.clear();
      this.previews.replaceChildren();
      this.drawn = '';
      this.run = run;
    }
    const files = [...(run?.files.values() ?? [])];
    this.empty.hidden = files.length > 0;
    this.empty.textContent = run?.active
      ? 'No file yet.'
      : 'Tables, charts and pictures that a run leaves behind can be saved from here.';
    if (this.element.offsetParent === null) return;
    const now = files.map((f) => `${f.name} ${f.bytes}`).join('\n');
    if (now === this.drawn) return;
    this.drawn = now;
    const items = files.map(({ name, bytes: size }) => {
      const save = { 'aria-label': `Save ${name}, ${bytes(size)}`, onclick: () => this.save(name).catch(this.failed) };
      return h('li', h('button.file', save, name), h('span.bytes', bytes(size)));
    });
    this.list.replaceChildren(...items);
    for (const f of files) if (pictureType(f.name)) void this.preview(f.name, f.bytes);
  }

  private async save(name: string): Promise<void> {
    saveAs(name.split('/').pop()!, await this.api.file(this.run!.id, name));
  }

  private async preview(name: string, size: number): Promise<void> {
    const run = this.run!;
    const key = `${name} ${size}`;
    if (this.addresses.has(key)) return;
    this.addresses.set(key, '');
    try {
      const blob = new Blob([await this.api.file(run.id, name)], { type: pictureType(name) });
      if (run !== this.run) return;
      const address = URL.createObjectURL(blob);
      this.addresses.set(key, address);
      const alt = `The picture ${name} of the run`;
      const image = h('img', { src: address, alt, className: pictureClass(name) });
      const act = { 'aria-label': `Enlarge ${name}`, onclick: () => enlarged(name, address) };
      const figure = h('figure', h('button', act, image), h('figcaption', name));
      figure.dataset.name = name;
      const old = [...this.previews.children].find((e) => (e as HTMLElement).dataset.name === name);
      if (old) old.replaceWith(figure);
      else this.previews.append(figure);
    } catch (error) {
      this.addresses.delete(key);
      this.failed(error);
    }
  }
}
