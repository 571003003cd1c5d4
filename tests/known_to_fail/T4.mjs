// SPDX-License-Identifier: GPL-3.0-or-later
// T4: at 960 x 540 (a screen of 1080 lines at 200 %) three columns leave 60 px to a chart. Wanted: one column below 1150 px,
// a chart at least 16 em high, tabs on one line. The work on the page that is alive owns it.

import { charted, claim, visit } from './claims_of_page.mjs';

await visit({ width: 960, height: 540 }, async (page) => {
  await charted(page, 'local book = lab.notebook "big" -- mock.rows 9\nbook:chart{ x="v", y="i" }\n');
  const seen = await page.evaluate(() => ({
    columns: getComputedStyle(document.querySelector('.panes')).gridTemplateColumns.split(' ').length,
    high: document.querySelector('.chart svg').getBoundingClientRect().height,
    em: parseFloat(getComputedStyle(document.querySelector('.chart')).fontSize),
  }));
  claim('one column below 1150 px', seen.columns === 1, seen.columns);
  claim('a chart is at least 16 em high', seen.high >= 16 * seen.em, seen.high);
});
