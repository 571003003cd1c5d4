// SPDX-License-Identifier: GPL-3.0-or-later
// Map colours, as in engine/plot/palette.cpp. Viridis and cividis are perceptually uniform. Heat, inferno
// from orange to black, has a contrast of at least 3:1 with its grey.

export interface Palette {
  colours: number[]; // 0xRRGGBB, equal steps, lowest first
  none?: number; // colour of the lowest value, if special
}

export const palettes: Record<string, Palette> = {
  viridis: {
    colours: [
      0x440154, 0x48186a, 0x472d7b, 0x424086, 0x3b528b, 0x33638d, 0x2c728e, 0x26828e, 0x21918c, 0x1fa088, 0x28ae80,
      0x3fbc73, 0x5ec962, 0x84d44b, 0xaddc30, 0xd8e219, 0xfde725,
    ],
  },
  cividis: {
    colours: [0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173, 0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46],
  },
  heat: {
    colours: [0xdf5337, 0xcb4149, 0xb1325a, 0x932667, 0x751d6c, 0x57106e, 0x380962, 0x190c3e, 0x000004],
    none: 0xe6eaed,
  },
  contact: { colours: [0xe6e6e6, 0x08306b] },
};

const ofField: Record<string, string> = { gap: 'cividis', pressure: 'heat', plastic: 'heat', contact: 'contact' };

export function paletteOf(field: string): Palette {
  return palettes[ofField[field] ?? 'viridis'];
}

export function bytesOf(colour: number): [number, number, number] {
  return [colour >> 16, (colour >> 8) & 255, colour & 255];
}
