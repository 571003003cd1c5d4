// SPDX-License-Identifier: GPL-3.0-or-later
// T3: output and chart of one lesson stay beside the next one that is opened, without a word. Wanted: a line over the tabs
// names script, run and time, greyed where it is not the open script's. The work on the page that is alive owns it.

import { claim, on, visit } from './claims_of_page.mjs';

await visit({}, async (page) => {
  await page.click('.lessons button');
  await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
  await on.run(page, 'print "of the first"\n');
  await on.finished(page);
  await page.click('.back');
  await page.waitForSelector('.lessons li:nth-child(2) button');
  await page.click('.lessons li:nth-child(2) button');
  await on.until(page, () => document.querySelector('.lesson h2, .lesson'), 'the other lesson should open');
  const results = await page.$eval('#results', (e) => e.innerText);
  if (!results.includes('of the first')) claim('results of another script are gone', true);
  else claim('results of another script say whose they are', /What roughness is|run 1\b/i.test(results), results.slice(0, 120));
});
