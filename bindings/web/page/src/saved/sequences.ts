// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that a script drew one after the other, told by their names: `press-1.png`, `press-2.png`, `press-3.png`.
// Two may be any two pictures, and drawings in lines are figures to be read, so neither are a sequence.

const least = 3; // pictures of a sequence

/** The names in their order, those of a sequence together where its first one stands. */
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
