// SPDX-License-Identifier: GPL-3.0-or-later
// T2: the page's chart shows one of the columns that the script charts against each other. Wanted: each y of one unit is a
// line. The work on the page that is alive owns it.

import { charted, claim, visit } from './claims_of_page.mjs';

await visit({}, async (page) => {
  await charted(page, 'local book = lab.notebook "big" -- mock.rows 9\nbook:chart{ x="v", y={ "level", "i" } }\n');
  const lines = await page.$$eval('.chart svg path[fill=none]', (paths) => paths.length);
  claim('each y of the script is a line', lines >= 2, lines);
});
