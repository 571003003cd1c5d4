// SPDX-License-Identifier: GPL-3.0-or-later
// The line above the results. Results of another script are grey, with a note.

import { byId } from './dom';
import type { Run } from './run';

export function showWhose(run: Run | undefined, key: string, opened: string): void {
  const line = byId('results-of');
  const elsewhere = run !== undefined && key !== opened;
  byId('results').classList.toggle('elsewhere', elsewhere);
  const time = run ? new Date(run.began).toLocaleTimeString('en-GB', { hour: '2-digit', minute: '2-digit' }) : '';
  const words = run ? `${run.name} · ${run.live ? 'live' : `run ${run.id}`} · ${time}${elsewhere ? ' · not of the open script' : ''}` : 'No run yet';
  if (line.textContent !== words) line.textContent = words;
}
