// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs, dividers and keyboard navigation.

import { keep, kept } from './storage';

export class Tabs {
  private readonly tabs: HTMLButtonElement[];
  private byHand = false;

  constructor(
    list: HTMLElement,
    private readonly changed: (name: string) => void,
  ) {
    this.tabs = [...list.querySelectorAll<HTMLButtonElement>('[role=tab]')];
    this.tabs.forEach((tab, k) => {
      tab.addEventListener('click', () => {
        this.byHand = true;
        this.select(this.name(tab));
      });
      tab.addEventListener('keydown', (event) => {
        const to = { ArrowRight: k + 1, ArrowLeft: k - 1, Home: 0, End: this.tabs.length - 1 }[event.key];
        if (to === undefined) return;
        event.preventDefault();
        this.byHand = true;
        const next = this.tabs[(to + this.tabs.length) % this.tabs.length];
        this.select(this.name(next));
        next.focus();
      });
    });
  }

  select(name: string): void {
    for (const tab of this.tabs) {
      const on = this.name(tab) === name;
      tab.setAttribute('aria-selected', String(on));
      tab.tabIndex = on ? 0 : -1;
      document.getElementById(tab.getAttribute('aria-controls')!)!.hidden = !on;
    }
    this.changed(name);
  }

  /** Not if the user chose a tab or has the focus in a panel; then false. */
  offer(name: string): boolean {
    if (this.byHand || document.activeElement?.closest('[role=tabpanel]')) return false;
    if (this.selected !== name) this.select(name);
    return true;
  }

  forgetChoice(): void {
    this.byHand = false;
  }

  get selected(): string {
    return this.name(this.tabs.find((t) => t.getAttribute('aria-selected') === 'true')!);
  }

  focus(): void {
    this.tabs.find((t) => t.getAttribute('aria-selected') === 'true')!.focus();
  }

  /** The number of items behind a tab; 0 is hidden. */
  count(name: string, count: number): void {
    const badge = this.tabs.find((t) => this.name(t) === name)!.querySelector('.count')!;
    const text = count ? String(count) : '';
    if (badge.textContent !== text) badge.textContent = text;
  }

  private name(tab: HTMLElement): string {
    return tab.id.replace(/^tab-/, '');
  }
}

/** Moved by pointer or arrow keys; `property`: width in per cent. */
export function divider(
  element: HTMLElement,
  property: string,
  initial: number,
  least: number,
  most: number,
  fromRight = false,
): void {
  const frame = element.parentElement!;
  let value = Number(kept(property)) || initial;
  const set = (to: number): void => {
    value = Math.min(most, Math.max(least, to));
    frame.style.setProperty(`--${property}`, `${value}%`);
    element.setAttribute('aria-valuenow', String(Math.round(value)));
    keep(property, String(value));
  };
  element.setAttribute('aria-valuemin', String(least));
  element.setAttribute('aria-valuemax', String(most));
  set(value);
  element.addEventListener('pointerdown', (event) => {
    element.setPointerCapture(event.pointerId);
    const move = (e: PointerEvent): void => {
      const box = frame.getBoundingClientRect();
      const share = ((e.clientX - box.left) / box.width) * 100;
      set(fromRight ? 100 - share : share);
    };
    element.addEventListener('pointermove', move);
    element.addEventListener('lostpointercapture', () => element.removeEventListener('pointermove', move), {
      once: true,
    });
  });
  element.addEventListener('keydown', (event) => {
    const by = { ArrowLeft: -2, ArrowRight: 2 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    set(value + (fromRight ? -by : by));
  });
}

/** Fills the window with an element; only the banner stays reachable. */
export class Filling {
  constructor(
    private readonly button: HTMLButtonElement,
    private readonly element: HTMLElement,
    private readonly changed: (on: boolean) => void,
  ) {
    button.addEventListener('click', () => this.set(!this.on));
  }

  get on(): boolean {
    return this.element.classList.contains('filling');
  }

  set(on: boolean): void {
    this.element.classList.toggle('filling', on);
    this.button.setAttribute('aria-pressed', String(on));
    for (let e: HTMLElement | null = this.element; e && e !== document.body; e = e.parentElement) {
      for (const other of e.parentElement?.children ?? []) {
        if (other !== e && other instanceof HTMLElement && !other.matches('script, dialog, [aria-live], [role=alert]')) other.inert = on;
      }
    }
    this.changed(on);
  }
}

/** F6: next visible pane; Shift-F6: previous. */
export function goRound(panes: { element: HTMLElement; enter: () => void }[]): void {
  document.addEventListener('keydown', (event) => {
    if (event.key !== 'F6') return;
    event.preventDefault();
    const open = panes.filter((p) => !p.element.hidden);
    const at = open.findIndex((p) => p.element.contains(document.activeElement));
    const step = event.shiftKey ? -1 : 1;
    if (at >= 0) {
      open[(at + step + open.length) % open.length].enter();
      return;
    }
    // Outside all panes: the nearest in document order.
    const follows = (p: { element: HTMLElement }): boolean =>
      ((document.activeElement ?? document.body).compareDocumentPosition(p.element) &
        Node.DOCUMENT_POSITION_FOLLOWING) !==
      0;
    const after = open.filter(follows);
    const before = open.filter((p) => !follows(p));
    (event.shiftKey ? (before.at(-1) ?? open.at(-1)!) : (after[0] ?? open[0])).enter();
  });
}
