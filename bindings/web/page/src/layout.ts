// SPDX-License-Identifier: GPL-3.0-or-later

import { ApiError, serverGoneHint, tokenHint } from './api';
import { byId, h } from './dom';
import { keep, kept } from './storage';

/** A pane with its divider and its button in the head. */
export function showPane(name: 'lessons' | 'script', on: boolean): void {
  const lessons = name === 'lessons';
  byId(name).hidden = !on;
  byId(lessons ? 'lessons-divider' : 'results-divider').hidden = !on;
  document.querySelector('.panes')!.classList.toggle(lessons ? 'plain' : 'folded', !on);
  byId(`${name}-button`).setAttribute('aria-expanded', String(on));
}

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
        const to = { ArrowRight: k + 1, ArrowLeft: k - 1, Home: 0, End: -1 }[event.key];
        if (to === undefined) return;
        event.preventDefault();
        const next = this.tabs.at(to % this.tabs.length)!;
        next.click();
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

  /** Not if the user chose a tab or has the focus in a panel. */
  offer(name: string): void {
    const stays = this.byHand || document.activeElement?.closest('[role=tabpanel]');
    if (!stays && this.selected !== name) this.select(name);
  }

  forgetChoice(): void {
    this.byHand = false;
  }

  get selected(): string {
    return this.name(this.shown);
  }

  focus(): void {
    this.shown.focus();
  }

  /** The number of items behind a tab; 0 is hidden. */
  count(name: string, count: number): void {
    const badge = this.tabs.find((t) => this.name(t) === name)!.querySelector('.count')!;
    const text = count ? String(count) : '';
    if (badge.textContent !== text) badge.textContent = text;
  }

  private get shown(): HTMLButtonElement {
    return this.tabs.find((t) => t.getAttribute('aria-selected') === 'true')!;
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
  element.addEventListener('pointerdown', (event) => element.setPointerCapture(event.pointerId));
  element.addEventListener('pointermove', (event) => {
    if (!element.hasPointerCapture(event.pointerId)) return;
    const box = frame.getBoundingClientRect();
    const share = ((event.clientX - box.left) / box.width) * 100;
    set(fromRight ? 100 - share : share);
  });
  element.addEventListener('keydown', (event) => {
    const by = { ArrowLeft: -2, ArrowRight: 2 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    set(value + (fromRight ? -by : by));
  });
}

const reachable = 'script, dialog, [aria-live], [role=alert]';

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
      for (const other of e.parentElement!.children)
        if (other !== e && !other.matches(reachable)) (other as HTMLElement).inert = on;
    }
    this.changed(on);
  }
}

/** A dialog with its button in the head; asks when it opens and every two seconds until it closes. */
export function asking(name: string, ask: () => Promise<void>, failed: (error: unknown) => void): HTMLDialogElement {
  const dialog = byId<HTMLDialogElement>(name);
  let timer = 0;
  const again = (): Promise<void> =>
    ask().catch((error: unknown) => {
      dialog.close();
      failed(error);
    });
  byId(`${name}-button`).addEventListener('click', () => {
    dialog.showModal();
    void again();
    timer = window.setInterval(again, 2000);
  });
  byId(`${name}-close`).addEventListener('click', () => dialog.close());
  dialog.addEventListener('close', () => clearInterval(timer));
  return dialog;
}

/** F6: next visible pane; Shift-F6: previous. From outside all panes: the nearest in document order. */
export function goRound(panes: { element: HTMLElement; enter: () => void }[]): void {
  document.addEventListener('keydown', (event) => {
    if (event.key !== 'F6') return;
    event.preventDefault();
    const open = panes.filter((p) => !p.element.hidden);
    const focused = document.activeElement ?? document.body;
    const follows = (p: { element: HTMLElement }): number =>
      focused.compareDocumentPosition(p.element) & Node.DOCUMENT_POSITION_FOLLOWING;
    const reached = open.filter((p) => !follows(p)).length;
    const inside = open[reached - 1]?.element.contains(focused);
    const next = event.shiftKey ? reached - (inside ? 2 : 1) : reached % open.length;
    open.at(next)!.enter();
  });
}

const askedAgain = 3000; // ms

/** The live region for screen readers, and the banner, which retries while the server is unreachable. */
export class Messages {
  private readonly live = byId('live');
  private readonly banner = byId('banner');
  private timer = 0;

  constructor(private readonly ask: () => void) {}

  get watching(): boolean {
    return this.timer !== 0;
  }

  say = (text: string): void => {
    // Screen readers skip unchanged text.
    this.live.textContent = this.live.textContent === text ? `${text} ` : text;
  };

  tell(title: string, hint: string, retry?: () => void): void {
    const again = retry ? h('button', { onclick: retry }, 'Try again') : '';
    const close = h('button', { onclick: () => this.clear() }, 'Close');
    this.banner.replaceChildren(h('p', h('strong', title), ` ${hint}`), again, close);
    this.banner.classList.remove('question');
    this.banner.hidden = false;
  }

  /** A question with its answers; the first has the focus. */
  question(question: string, answers: Record<string, () => void>): void {
    const buttons = Object.entries(answers).map(([text, act]) => {
      const onclick = (): void => {
        this.clear();
        act();
      };
      return h('button', { onclick }, text);
    });
    this.banner.replaceChildren(h('p', h('strong', question)), ...buttons);
    this.banner.hidden = false;
    this.banner.classList.add('question');
    buttons[0].focus();
  }

  clear(): void {
    this.banner.hidden = true;
  }

  answered(): void {
    clearInterval(this.timer);
    this.timer = 0;
  }

  failed = (error: unknown): void => {
    if (!(error instanceof ApiError)) {
      console.error(error);
      this.tell('This page has made a mistake.', String(error));
      return;
    }
    const title = sentence(error.message).replace(/([^.!?])$/, '$1.');
    if (error.failure === 'gone') {
      this.tell(title, serverGoneHint, this.ask);
      this.answered();
      this.timer = window.setInterval(this.ask, askedAgain);
    } else if (error.failure === 'token') {
      this.tell(title, tokenHint);
    } else {
      this.tell(title, sentence(error.hint));
    }
  };
}

function sentence(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
