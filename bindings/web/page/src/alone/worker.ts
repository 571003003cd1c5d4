// SPDX-License-Identifier: GPL-3.0-or-later
// The worker: an instance of the WebAssembly module with files in memory. A script reads the user's files in
// /files and writes its run directory /run.

import type { Files, Task, Told } from './module';

interface Folder {
  mkdir(path: string): void;
  chdir(path: string): void;
  readdir(path: string): string[];
  stat(path: string): { mode: number; mtime: Date };
  isDir(mode: number): boolean;
  readFile(path: string): Uint8Array;
  writeFile(path: string, bytes: Uint8Array): void;
  mkdirTree(path: string): void;
}
interface Module {
  FS: Folder;
  ccall(name: string, returns: string | null, types: string[], values: string[]): unknown;
}
declare const asperityModule: (settings: object) => Promise<Module>;
const scope = self as unknown as {
  importScripts(file: string): void;
  postMessage(told: Told): void;
  onmessage: (event: MessageEvent<Task>) => void;
};
scope.importScripts('module.js');

const flushEvery = 50; // ms
const runFolder = '/run';

/** Output comes byte by byte, and is told in pieces that end with a line. */
class Stream {
  private bytes: number[] = [];
  private told = 0;

  constructor(
    private readonly stream: 'out' | 'err',
    private readonly other: () => Stream,
  ) {}

  take = (byte: number | null): void => {
    if (byte === null) return;
    if (this.bytes.length === 0) this.other().tell();
    this.bytes.push(byte & 255);
    if (byte === 10 && performance.now() - this.told > flushEvery) this.tell();
  };

  tell(): void {
    if (this.bytes.length === 0) return;
    scope.postMessage({ stream: this.stream, text: new TextDecoder().decode(new Uint8Array(this.bytes)) });
    this.bytes = [];
    this.told = performance.now();
  }
}
const out: Stream = new Stream('out', () => err);
const err: Stream = new Stream('err', () => out);
const tellOutput = (): void => [out, err].forEach((s) => s.tell());

let compiled: WebAssembly.Module;
let instance: Promise<Module> | undefined;
let files: Folder | undefined; // of the instance

/** An instance holds the state of one script; the desk keeps its own. */
function module(): Promise<Module> {
  instance ??= asperityModule({
    instantiateWasm: (imports: WebAssembly.Imports, ready: (made: WebAssembly.Instance) => void) => {
      void WebAssembly.instantiate(compiled, imports).then(ready);
      return {};
    },
    stdin: () => null,
    stdout: out.take,
    stderr: err.take,
    told: (line: string) => {
      tellOutput();
      const view = /^{"type":"view","name":"([\w-]+)"/.exec(line)?.[1];
      if (view && files) {
        const text = new TextDecoder().decode(files.readFile(`${runFolder}/.views/${view}.json`));
        scope.postMessage({ view, text });
      }
      scope.postMessage({ line });
    },
    answered: (facts: string, numbers: Float32Array[]) => scope.postMessage({ facts, numbers }),
  }).then((made) => {
    files = made.FS;
    for (const folder of [runFolder, '/files']) made.FS.mkdir(folder);
    made.FS.chdir('/files');
    return made;
  });
  return instance;
}

const toldFiles = new Map<string, number>(); // with the time of their last change

/** Files that changed since the last call, without hidden files. */
function changedFiles(fs: Folder, folder: string, found: Files = new Map(), under = ''): Files {
  for (const name of fs.readdir(folder)) {
    if (name.startsWith('.')) continue;
    const path = `${folder}/${name}`;
    const { mode, mtime } = fs.stat(path);
    if (fs.isDir(mode)) changedFiles(fs, path, found, `${under}${name}/`);
    else if (toldFiles.get(path) !== mtime.getTime()) {
      toldFiles.set(path, mtime.getTime());
      found.set(under + name, fs.readFile(path));
    }
  }
  return found;
}

/** The exit status; os.exit unwinds the module by an exception. */
function status(act: () => unknown): number {
  try {
    return act() as number;
  } catch (error) {
    const { name, status: code } = error as { name?: string; status?: number };
    if (name === 'ExitStatus' && code !== undefined) return code;
    throw error;
  }
}

async function work(task: Task): Promise<void> {
  if ('module' in task) {
    compiled = task.module;
    await module();
    return;
  }
  const lab = await module();
  if ('ask' in task) {
    scope.postMessage({ answer: lab.ccall('asperity_ask', 'string', ['string'], [task.ask]) as string });
  } else if ('move' in task) {
    if (status(() => lab.ccall('asperity_move', 'number', ['string'], [task.move])) !== 0)
      throw new Error('the script could not be followed');
    scope.postMessage({ moved: true });
  } else {
    for (const [path, bytes] of task.files) {
      lab.FS.mkdirTree(`/files/${path}`.replace(/\/[^/]*$/, ''));
      lab.FS.writeFile(`/files/${path}`, bytes);
    }
    if ('line' in task) {
      let taken = 2; // os.exit ends the session
      status(() => (taken = lab.ccall('asperity_line', 'number', ['string'], [task.line]) as number));
      tellOutput();
      scope.postMessage({ taken, files: changedFiles(lab.FS, runFolder) });
      return;
    }
    const [act, asked] = 'run' in task ? ['asperity_run', task.run] : ['asperity_replay', task.replay];
    const exit = status(() => lab.ccall(act, 'number', ['string'], [asked]));
    tellOutput();
    scope.postMessage({ exit, files: changedFiles(lab.FS, runFolder) });
  }
}

scope.onmessage = ({ data }) => {
  work(data).catch((error: unknown) => {
    tellOutput();
    scope.postMessage({ failure: error instanceof Error ? error.message : String(error) });
  });
};
