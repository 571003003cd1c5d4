// SPDX-License-Identifier: GPL-3.0-or-later
// What a teacher sees of the room: whose scripts run and wait, and a button to stop each. It is asked for while it is
// open and not otherwise.

import type { Api, RoomRun } from './api';
import { byId, h } from './dom';

const askedAgain = 2000; // ms

export class Room {
  private readonly dialog = byId<HTMLDialogElement>('room');
  private readonly list = byId('room-runs');
  private timer = 0;

  constructor(
    private readonly api: Api,
    private readonly failed: (error: unknown) => void,
  ) {
    byId('room-button').addEventListener('click', () => {
      this.dialog.showModal();
      void this.ask();
      this.timer = window.setInterval(() => void this.ask(), askedAgain);
    });
    byId('room-close').addEventListener('click', () => this.dialog.close());
    this.dialog.addEventListener('close', () => clearInterval(this.timer));
  }

  /** Whether this is the teacher's page. */
  offer(teacher: boolean): void {
    byId('room-button').hidden = !teacher;
  }

  private async ask(): Promise<void> {
    try {
      const runs = await this.api.room();
      this.show(runs.filter((run) => run.state === 'running' || run.state === 'waiting'));
    } catch (error) {
      this.dialog.close();
      this.failed(error);
    }
  }

  private show(runs: RoomRun[]): void {
    const focused = this.list.contains(document.activeElement) ? document.activeElement!.id : '';
    this.list.replaceChildren(
      ...(runs.length
        ? runs.map((run) =>
            h(
              'li',
              {},
              h('span', {}, `${run.owner}: ${run.name || 'script'}, ${run.state}`),
              h(
                'button',
                {
                  type: 'button',
                  id: `room-stop-${run.id}`,
                  'aria-label': `Stop ${run.name || 'the script'} of ${run.owner}`,
                  onclick: () => void this.stop(run.id),
                },
                'Stop',
              ),
            ),
          )
        : [h('li', {}, 'No script runs or waits.')]),
    );
    if (focused) document.getElementById(focused)?.focus();
  }

  private async stop(id: string): Promise<void> {
    try {
      await this.api.stop(id);
      await this.ask();
    } catch (error) {
      this.failed(error);
    }
  }
}
