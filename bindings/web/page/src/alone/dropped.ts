// SPDX-License-Identifier: GPL-3.0-or-later
// Files that the user drops on the page: a script opens, a run directory is replayed, other files can be read
// by every script. They stay in this browser.

import type { Messages } from '../layout';
import { bytes } from '../units';
import type { Laboratory } from './laboratory';

const most = 200_000_000; // bytes in all; each run gets a copy

interface Dropped {
  opened: (script: string, name: string) => void;
  replayed: (folder: string) => void;
}

async function filesOf(entry: FileSystemEntry, found: Map<string, File>): Promise<void> {
  const path = entry.fullPath.slice(1);
  if (entry.isFile) {
    found.set(path, await new Promise<File>((done, failed) => (entry as FileSystemFileEntry).file(done, failed)));
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (;;) {
    // A reader gives at most 100 entries at a time.
    const some = await new Promise<FileSystemEntry[]>((done, failed) => reader.readEntries(done, failed));
    if (some.length === 0) return;
    for (const one of some) await filesOf(one, found);
  }
}

export function takeDrops(laboratory: Laboratory, messages: Messages, on: Dropped): void {
  const take = async (transfer: DataTransfer): Promise<void> => {
    const entries = [...transfer.items].map((item) => item.webkitGetAsEntry()); // at once: they go with the event
    const found = new Map([...transfer.files].map((file) => [file.name, file]));
    for (const entry of entries.filter((e) => e?.isDirectory)) {
      found.delete(entry!.name);
      await filesOf(entry!, found);
    }
    await takeFiles(found);
  };
  const takeFiles = async (found: Map<string, File>): Promise<void> => {
    const size = [...found.values()].reduce((sum, f) => sum + f.size, 0);
    if (size > most) {
      messages.tell('The files are too large.', `They have ${bytes(size)}; the page takes ${bytes(most)}.`);
      return;
    }
    const [first] = found;
    if (found.size === 1 && first[0].endsWith('.lua')) return on.opened(await first[1].text(), first[0]);
    for (const [path, file] of found) laboratory.given.set(path, new Uint8Array(await file.arrayBuffer()));
    const journal = [...found.keys()].find((path) => path.endsWith('/journal.jsonl'));
    if (journal) return on.replayed(journal.replace('/journal.jsonl', ''));
    const names = [...found.keys()];
    const read = names.slice(0, 3).join(', ') + (names.length > 3 ? ` and ${names.length - 3} more` : '');
    messages.tell(`A script can now read ${read}.`, `Example: lab.surface.read "${names[0]}". The files stay in this browser.`);
  };
  document.addEventListener('dragover', (event) => {
    if (event.dataTransfer?.types.includes('Files')) event.preventDefault();
  });
  document.addEventListener('drop', (event) => {
    if (!event.dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    take(event.dataTransfer).catch((error: Error) => messages.tell('The files could not be read.', error.message));
  }, true);
}
