// SPDX-License-Identifier: GPL-3.0-or-later
// What files of claims about the page share: a page in Chromium before the stand-in for the server, and a claim as the
// line that known_to_fail.sh reads.

import * as on from '../page/browser.mjs';
import { startMock } from '../page/mock_server.mjs';

export { on };

export const claim = (name, holds, ...seen) => console.log(`${holds ? 'holds' : 'does not hold'}: ${name}`, ...seen);

/** Opens the page and does; the browser is closed whatever happens. */
export async function visit(options, act) {
  const browser = await on.openBrowser();
  const mock = await startMock(on.pageFolder);
  try {
    const page = await on.openPage(browser, mock.url, options);
    await on.until(page, () => document.querySelector('.lessons button, .lesson'), 'the lessons should be listed');
    await act(page);
  } finally {
    await browser.close();
    await mock.close();
  }
}

/** Runs a script for the stand-in and shows what it charts, once that stays as it is. */
export async function charted(page, script) {
  await on.run(page, script);
  await on.finished(page);
  await page.click('#tab-chart');
  await page.waitForSelector('.chart svg path');
  // Rows come a few at a time, and each time the chart is drawn anew.
  let drawn = '';
  for (let still = 0; still < 5; ) {
    await new Promise((resolve) => setTimeout(resolve, 100));
    const now = await page.$eval('.chart svg', (chart) => chart.outerHTML).catch(() => '');
    still = now !== '' && now === drawn ? still + 1 : 0;
    drawn = now;
  }
}
