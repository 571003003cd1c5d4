// SPDX-License-Identifier: GPL-3.0-or-later
// What the page says by itself: for listeners in the live region, for all in the banner. A server that is
// gone is asked again until it answers, and the banner goes by itself.

import { ApiError, serverGoneHint, tokenHint } from './api';
import { byId, h } from './dom';

const askedAgain = 3000; // ms

export class Messages {
  private readonly live = byId('live');
  private readonly banner = byId('banner');
  private timer = 0;

  constructor(private readonly ask: () => void) {}

  /** A server that was gone is being asked. */
  get watching(): boolean {
    return this.timer !== 0;
  }

  say = (text: string): void => {
    // The same words again are heard only if something changed.
    this.live.textContent = this.live.textContent === text ? `${text} ` : text;
  };

  tell(title: string, hint: string, retry?: () => void): void {
    const again = retry && h('button', { type: 'button', onclick: retry }, 'Try again');
    const close = h('button', { type: 'button', onclick: () => this.clear() }, 'Close');
    this.banner.replaceChildren(h('p', {}, h('strong', {}, title), ` ${hint}`), ...(again ? [again] : []), close);
    this.banner.hidden = false;
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
