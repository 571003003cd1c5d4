// SPDX-License-Identifier: GPL-3.0-or-later
// Edited scripts and predictions in the browser's storage, which may be refused or full. Scripts are stored
// for the browser (next visit: last version of any tab) and for the tab (reload: its own text).

export function kept(key: string): string | null {
  try {
    return localStorage.getItem(`asperity.${key}`);
  } catch {
    return null;
  }
}

/** Null deletes; false if the browser refuses. */
export function keep(key: string, text: string | null): boolean {
  try {
    if (text === null) localStorage.removeItem(`asperity.${key}`);
    else localStorage.setItem(`asperity.${key}`, text);
    return true;
  } catch {
    return false;
  }
}

/** Of this tab, else of any tab; null if none. */
export function keptScript(key: string): string | null {
  try {
    const mine = sessionStorage.getItem(scriptKey(key));
    if (mine !== null) return JSON.parse(mine) as string | null;
  } catch {
  }
  return kept(`script.${key}`);
}

/** Null restores the original script; false if the browser refuses. */
export function keepScript(key: string, text: string | null): boolean {
  try {
    sessionStorage.setItem(scriptKey(key), JSON.stringify(text));
  } catch {
  }
  return keep(`script.${key}`, text);
}

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
