// SPDX-License-Identifier: GPL-3.0-or-later
// T10: labels of ticks collide, logarithmic axes run to the next decade, axes of whole numbers show 1.5. Wanted: labels
// apart, axes as long as the data, whole ticks of whole numbers. The work on the page that is alive owns it.

import { charted, claim, visit } from './claims_of_page.mjs';

await visit({}, async (page) => {
  const labels = () =>
    page.$$eval('.chart svg > text[text-anchor=middle]:not([transform])', (texts) =>
      texts.slice(0, -1).map((t) => t.textContent),
    );
  await charted(page, 'local book = lab.notebook "big" -- mock.rows 3\nbook:chart{ x="i", y="v" }\n');
  const whole = await labels();
  claim('an axis of whole numbers has whole ticks', whole.every((t) => !t.includes('.')), whole.join(' '));
  await charted(page, 'local book = lab.notebook "big" -- mock.rows 300\nbook:chart{ x="i", y="v", log_x=true }\n');
  const decades = await labels();
  claim('a logarithmic axis ends where its data end', !decades.includes('1000'), decades.join(' '));
});
