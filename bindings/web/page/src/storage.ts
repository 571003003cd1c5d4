// SPDX-License-Identifier: GPL-3.0-or-later
// What is kept in the browser between visits: the scripts as edited and the predictions made. A browser
// that keeps nothing (storage refused or full) loses only that. A script is kept twice: for the browser, where
// the tab that wrote last is found by the next visit, and for its own tab, which finds its own text after a reload
// whatever other tabs wrote.

export function kept(key: string): string | null {
  try {
    return localStorage.getItem(`asperity.${key}`);
  } catch {
    return null;
  }
}

/** Keeps the text, or forgets it when null; false if the browser would not. */
export function keep(key: string, text: string | null): boolean {
  try {
    if (text === null) localStorage.removeItem(`asperity.${key}`);
    else localStorage.setItem(`asperity.${key}`, text);
    return true;
  } catch {
    return false;
  }
}

const own = '=';
const none = '-'; // this tab went back to the script as it was given

/** The script as this tab edited it last, else as any tab of the browser did; null where nobody did. */
export function keptScript(key: string): string | null {
  try {
    const mine = sessionStorage.getItem(scriptKey(key));
    if (mine !== null) return mine === none ? null : mine.slice(own.length);
  } catch {
    // A browser that keeps nothing for a tab.
  }
  return kept(`script.${key}`);
}

/** Keeps the script as edited, or forgets it when null; false if the browser would not. */
export function keepScript(key: string, text: string | null): boolean {
  try {
    sessionStorage.setItem(scriptKey(key), text === null ? none : own + text);
  } catch {
    // The browser's copy may still do.
  }
  return keep(`script.${key}`, text);
}

/** Calls when another tab writes the script of that key, with its text. */
export function whenWrittenElsewhere(written: (key: string, text: string) => void): void {
  const lead = scriptKey('');
  addEventListener('storage', (event) => {
    if (event.storageArea === localStorage && event.key?.startsWith(lead) && event.newValue !== null)
      written(event.key.slice(lead.length), event.newValue);
  });
}

function scriptKey(key: string): string {
  return `asperity.script.${key}`;
}
