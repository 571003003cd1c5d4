// SPDX-License-Identifier: GPL-3.0-or-later
// A script from a file of the user's computer.

import { byId } from './dom';
import type { Messages } from './layout';
import { bytes } from './units';

const most = 1_000_000; // bytes

export function offerFiles(open: (text: string) => void, messages: Messages): void {
  const chooser = byId<HTMLInputElement>('file');
  byId('open-file').addEventListener('click', () => chooser.click());
  chooser.addEventListener('change', () => {
    const file = chooser.files?.[0];
    chooser.value = '';
    if (!file) return;
    if (file.size <= most) void file.text().then(open);
    else
      messages.tell(
        'That file is no script.',
        `${file.name} has ${bytes(file.size)}; a script of at most 1 MB is opened.`,
      );
  });
}
