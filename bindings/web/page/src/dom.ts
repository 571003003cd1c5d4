// SPDX-License-Identifier: GPL-3.0-or-later
// Elements in one expression. Text always becomes text nodes: no output, file name or lesson can inject
// markup. Styles are properties: the content policy forbids style attributes.

type Child = Node | string | number | null | undefined | false;
type Properties = Record<string, unknown>;
type Tag = keyof HTMLElementTagNameMap;
type TagOf<Name> = Extract<Name extends `${infer T}.${string}` ? T : Name, Tag>;

/** `h('p.empty', { hidden: true }, 'text')`: tag with classes, properties if any, children. */
export function h<Name extends Tag | `${Tag}.${string}`>(
  name: Name,
  ...rest: [Properties, ...Child[]] | Child[]
): HTMLElementTagNameMap[TagOf<Name>] {
  const [tag, ...classes] = name.split('.');
  const element = document.createElement(tag as TagOf<Name>);
  if (classes.length > 0) element.className = classes.join(' ');
  if (element instanceof HTMLButtonElement) element.type = 'button'; // there is no form
  const given = rest[0]?.constructor === Object;
  for (const [key, value] of Object.entries(given ? (rest[0] as Properties) : {})) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith('on') && typeof value === 'function') {
      element.addEventListener(key.slice(2), value as EventListener);
    } else if (key in element && !key.startsWith('aria') && key !== 'list' && key !== 'role') {
      (element as unknown as Properties)[key] = value;
    } else {
      element.setAttribute(key, value === true ? '' : String(value));
    }
  }
  append(element, rest.slice(given ? 1 : 0) as Child[]);
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

export function table(head: Child[], rows: Child[][], ...before: Child[]): HTMLTableElement {
  const lines = rows.map((row) => h('tr', ...row));
  return h('table', ...before, h('thead', h('tr', ...head)), h('tbody', ...lines));
}

/** Backquoted `names` become code elements. */
export function prose(text: string): DocumentFragment {
  const fragment = document.createDocumentFragment();
  text
    .split(/`([^`\n]+)`/)
    .forEach((part, k) => fragment.append(k % 2 ? h('code.quoted', part) : part));
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
    this.element = h('label.choice', h('span', label), this.select);
  }

  get value(): string {
    return this.select.value;
  }

  choose(given: (string | { value: string; text: string })[], value: string): void {
    const options = given.map((o) => (typeof o === 'string' ? { value: o, text: o } : o));
    const same =
      options.length === this.select.options.length &&
      options.every((o, i) => this.select.options[i].value === o.value && this.select.options[i].text === o.text);
    if (!same) this.select.replaceChildren(...options.map((o) => h('option', { value: o.value }, o.text)));
    this.select.value = value;
  }
}

/** A labelled slider from 0 to `most`, with its value as text. */
export function slider(label: string, most: number, moved: (place: number) => void) {
  const value = h('output.factor');
  const input = h('input', {
    type: 'range',
    min: '0',
    max: String(most),
    step: '1',
    'aria-label': label,
    oninput: () => moved(Number(input.value)),
  });
  /** `spoken`: for screen readers. */
  const tell = (place: number, text: string, spoken = text): void => {
    input.value = String(place);
    input.setAttribute('aria-valuetext', spoken);
    value.textContent = text;
  };
  return { element: h('label.choice', h('span', label), input, value), input, tell };
}

export function saveAs(name: string, blob: Blob): void {
  const address = URL.createObjectURL(blob);
  h('a', { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}
