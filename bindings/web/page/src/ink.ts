// SPDX-License-Identifier: GPL-3.0-or-later
// Colours for light and dark paper; chart lines in Okabe and Ito's colours for all kinds of colour vision,
// adjusted for contrast.

export interface Ink {
  text: string;
  muted: string;
  grid: string;
  paper: string;
  series: string[];
}

export const lightInk: Ink = {
  text: '#1c2126',
  muted: '#4d5963',
  grid: '#dfe3e6',
  paper: '#ffffff',
  series: ['#0b5fa5', '#b04a00', '#00765a', '#9a4480', '#6b5b00', '#3a3f47', '#3d86b8', '#c2611f'],
};
export const darkInk: Ink = {
  text: '#e6eaed',
  muted: '#aeb9c2',
  grid: '#343c44',
  paper: '#14181c',
  series: ['#6fb7ee', '#f0964b', '#4fc9a4', '#e194c4', '#e0cd4e', '#c6ccd2', '#9fd3f2', '#ffbf8f'],
};

export function inkNow(): Ink {
  return matchMedia('(prefers-color-scheme: dark)').matches ? darkInk : lightInk;
}
