// SPDX-License-Identifier: GPL-3.0-or-later
// Messages between the page and a worker that holds one instance of the WebAssembly module.

export type Files = Map<string, Uint8Array>; // by path

/** The first message has the compiled module; each worker does one kind of work. */
export type Task =
  | { module: WebAssembly.Module }
  | { ask: string } // JSON, as bindings/wasm/page.cpp takes it
  | { run: string; files: Files } // JSON
  | { replay: string; files: Files } // a run directory
  | { line: string; files: Files } // of the prompt, with the files given since the line before
  | { move: string }; // JSON

export type Told =
  | { answer: string } // JSON
  | { line: string } // an event in JSON
  | { view: string; text: string } // before its event
  | { stream: 'out' | 'err'; text: string }
  | { facts: string; numbers: Float32Array[] } // of a live script
  | { moved: true }
  // A line of the prompt, with the files that changed; 1: the statement goes on, from 2: the session has ended.
  | { taken: number; files: Files }
  | { exit: number; files: Files }
  | { failure: string }; // the module is lost
