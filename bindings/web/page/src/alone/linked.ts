// SPDX-License-Identifier: GPL-3.0-or-later
// What the documents link to beside this page: #lesson=NAME, #example=FILE, #script=TEXT.

import { ApiError } from '../api';
import type { Laboratory } from './laboratory';

export interface Linked {
  kind: 'lesson' | 'example' | 'script';
  name: string; // of a lesson or a file
  script: string; // empty for a lesson
}

async function fileOf(path: string): Promise<Response> {
  const answer = await fetch(path);
  if (!answer.ok) throw new ApiError('refused', `There is no ${path} beside this page`, 'copy the whole folder of the page');
  return answer;
}

/** Undefined without a link. The data files of an example are given to its script. */
export async function linked(laboratory: Laboratory): Promise<Linked | undefined> {
  const [, kind, text] = /^#(lesson|example|script)=(.+)/s.exec(location.hash) ?? [];
  if (!kind) return undefined;
  history.replaceState(null, '', location.pathname);
  const name = decodeURIComponent(text);
  if (kind === 'lesson') return { kind, name, script: '' };
  if (kind === 'script') return { kind, name: 'From the documents', script: name };
  if (!/^[\w/]+\.lua$/.test(name)) throw new ApiError('refused', `There is no example ${name}`);
  const script = await (await fileOf(`examples/${name}`)).text();
  for (const [, data] of script.matchAll(/"\/(data\/\w+\.csv)"/g))
    laboratory.given.set(data, new Uint8Array(await (await fileOf(`examples/${data}`)).arrayBuffer()));
  return { kind: 'example', name, script };
}
