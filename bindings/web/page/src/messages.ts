// SPDX-License-Identifier: GPL-3.0-or-later
// Messages of the page: the live region for screen readers, and the banner, which retries while the server is
// unreachable.

import { ApiError, serverGoneHint, tokenHint } from './api';
import { byId, h } from './dom';

const askedAgain = 3000; // ms

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
