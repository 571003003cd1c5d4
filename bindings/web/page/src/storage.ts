// SPDX-License-Identifier: GPL-3.0-or-later
// What is kept in the browser between visits: the scripts as edited and the predictions made. A browser
// that keeps nothing (storage refused or full) loses only that.

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
