// SPDX-License-Identifier: GPL-3.0-or-later
// Elements in one expression. Text always becomes text nodes: no output, file name or lesson can inject
// markup. Styles are set as properties, because the content policy forbids style attributes.

type Child = Node | string | number | null | undefined | false;
type Properties = Record<string, unknown>;

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith('on') && typeof value === 'function') {
      element.addEventListener(key.slice(2), value as EventListener);
    } else if (key in element && !key.startsWith('aria') && key !== 'list' && key !== 'role') {
      (element as unknown as Properties)[key] = value;
    } else {
      element.setAttribute(key, value === true ? '' : String(value));
    }
  }
  append(element, children);
  return element;
}

export function svg(tag: string, attributes: Record<string, string | number> = {}, ...children: Child[]): SVGElement {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  append(element, children);
  return element;
}

function append(element: Element, children: Child[]): void {
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    element.append(typeof child === 'number' ? String(child) : child);
  }
}

/** Backquoted `names` become code elements. */
export function prose(text: string): DocumentFragment {
  const fragment = document.createDocumentFragment();
  text
    .split(/`([^`\n]+)`/)
    .forEach((part, k) => fragment.append(k % 2 ? h('code', { className: 'quoted' }, part) : part));
  return fragment;
}

/** The element of index.html with this id, which is known to be there. */
export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (!element) throw new Error(`index.html has no #${id}`);
  return element as T;
}

/** A labelled choice; `choose` fills it and keeps the present value where it is still offered. */
export class Choice {
  readonly element: HTMLElement;
  readonly select: HTMLSelectElement;

  constructor(label: string, changed: (value: string) => void) {
    this.select = h('select', { onchange: () => changed(this.select.value) });
    this.element = h('label', { className: 'choice' }, h('span', {}, label), this.select);
  }

  get value(): string {
    return this.select.value;
  }

  choose(options: { value: string; text: string }[], value: string): void {
    const same =
      options.length === this.select.options.length &&
      options.every((o, i) => this.select.options[i].value === o.value && this.select.options[i].text === o.text);
    if (!same) this.select.replaceChildren(...options.map((o) => h('option', { value: o.value }, o.text)));
    this.select.value = value;
  }
}

export function saveAs(name: string, blob: Blob): void {
  const address = URL.createObjectURL(blob);
  h('a', { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}
