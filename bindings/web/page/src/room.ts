// SPDX-License-Identifier: GPL-3.0-or-later
// The teacher's view of the classroom, polled while open: runs, names, requests for help with the student's script.
// Also the student's help button.

import type { Api, RoomPerson, RoomRun, SharedScript } from './api';
import { byId, h, table } from './dom';
import { asking } from './layout';

export class Room {
  private readonly list = byId('room-runs');
  private readonly people = byId('room-people');
  private readonly script = byId('room-script');

  constructor(
    private readonly api: Api,
    private readonly open: (student: string, script: SharedScript) => void,
    private readonly failed: (error: unknown) => void,
  ) {
    asking('room', () => this.ask(), failed);
  }

  offer(teacher: boolean): void {
    byId('room-button').hidden = !teacher;
  }

  private async ask(): Promise<void> {
    const [runs, people] = await Promise.all([this.api.room(), this.api.people()]);
    this.show(runs.filter((run) => run.state === 'running' || run.state === 'waiting'));
    this.showPeople(people, runs);
  }

  private show(runs: RoomRun[]): void {
    const focused = this.list.contains(document.activeElement) ? document.activeElement!.id : '';
    const items = runs.map(({ id, name, owner, state }) => {
      const label = `Stop ${name || 'the script'} of ${owner}`;
      const stop = { id: `room-stop-${id}`, 'aria-label': label, onclick: () => this.stop(id).catch(this.failed) };
      return h('li', h('span', `${owner}: ${name || 'script'}, ${state}`), h('button', stop, 'Stop'));
    });
    this.list.replaceChildren(...(items.length ? items : [h('li', 'No script runs or waits.')]));
    if (focused) document.getElementById(focused)?.focus();
  }

  /** Requests for help first. */
  private showPeople(people: RoomPerson[], runs: RoomRun[]): void {
    const last = new Map(runs.map((run) => [run.owner, run]));
    const sorted = [...people.filter((p) => p.help), ...people.filter((p) => !p.help)];
    const rows = sorted.map((p) => {
      const run = last.get(p.name);
      return [
        h('th', { scope: 'row' }, p.name),
        h('td', run ? `${run.name || 'script'}, ${run.state}` : 'none'),
        h('td', p.help ? 'asks for help ' : '', p.script ? this.lookAt(p.name) : ''),
      ];
    });
    const made = table(['Student', 'Last run', 'Help'].map((t) => h('th', { scope: 'col' }, t)), rows);
    sorted.forEach((p, k) => made.tBodies[0].rows[k].classList.toggle('asks', p.help));
    const focused = this.people.contains(document.activeElement) ? document.activeElement!.id : '';
    this.people.replaceChildren(made);
    if (focused) document.getElementById(focused)?.focus();
  }

  private lookAt(name: string): HTMLElement {
    const onclick = () => this.look(name).catch(this.failed);
    return h('button', { id: `room-look-${name}`, 'aria-label': `Show script of ${name}`, onclick }, 'Show script');
  }

  private async look(student: string): Promise<void> {
    const shown = await this.api.shownBy(student);
    const title = h('h3', { tabIndex: -1 }, `Script of ${student}: ${shown.name}`);
    const take = (): void => {
      this.script.closest('dialog')!.close();
      this.open(student, shown);
    };
    const text = h('pre.sample', { tabIndex: 0 }, shown.script);
    this.script.replaceChildren(title, text, h('button', { onclick: take }, 'Open a copy'));
    title.focus();
  }

  private async stop(id: string): Promise<void> {
    await this.api.stop(id);
    await this.ask();
  }
}

export class HelpButton {
  private readonly button = byId<HTMLButtonElement>('help-button');
  private wanted = false;

  constructor(api: Api, script: () => SharedScript, failed: (error: unknown) => void) {
    this.button.addEventListener('click', () => {
      const wanted = !this.wanted;
      api.askForHelp(wanted, wanted ? script() : undefined).then(() => this.show(wanted), failed);
    });
  }

  offer(inRoom: boolean, wanted: boolean): void {
    this.button.hidden = !inRoom;
    this.show(wanted);
  }

  private show(wanted: boolean): void {
    this.wanted = wanted;
    this.button.textContent = wanted ? 'Help is asked for' : 'Ask for help';
    this.button.setAttribute('aria-pressed', String(wanted));
  }
}
