// SPDX-License-Identifier: GPL-3.0-or-later
// Numbered pictures: `press-1.png`, `press-2.png`, `press-3.png`. Two pictures, and SVG drawings, form no
// sequence.

const least = 3; // pictures

/** A sequence is at its first name. */
export function sequencesOf(names: string[]): string[][] {
  const kinds = new Map<string, string[]>();
  for (const name of names) {
    const kind = name.replace(/\d+/g, '#');
    kinds.set(kind, [...(kinds.get(kind) ?? []), name]);
  }
  return [...kinds].flatMap(([kind, alike]) =>
    /#.*\.png$/i.test(kind) && alike.length >= least ? [alike] : alike.map((name) => [name]),
  );
}
