// SPDX-License-Identifier: GPL-3.0-or-later
// A saved run opened from disk in Chromium, without a server: pictures in sequence, and runs at other knob
// values.

import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import * as on from './browser.mjs';
import { browser, mock } from './mock_page.mjs';

/** Saves the effect of `act`; `look` checks the file opened from disk. */
async function saved(act, look) {
  const downloads = mkdtempSync(join(tmpdir(), 'asperity-saved-'));
  try {
    const page = await on.openPage(browser, mock.url, { downloads });
    await on.until(page, () => document.querySelector('.lessons button'), 'the lessons should be listed');
    await act(page);
    const file = await on.save(page, downloads);
    await on.assertQuiet(page);
    await page.done();
    console.log(`${statSync(file).size} bytes`);
    const page2 = await on.openPage(browser);
    const asked = [];
    page2.on('request', (r) => asked.push(r.url()));
    await page2.goto(`file://${file}`);
    await look(page2, `file://${file}`);
    assert.deepEqual(
      asked.filter((a) => !a.startsWith('data:') && !a.startsWith('file:')),
      [],
    );
    await on.assertQuiet(page2);
    await page2.done();
  } finally {
    rmSync(downloads, { recursive: true });
  }
}

const seen = (page, selector) =>
  page.$$eval(selector, (all) => all.filter((e) => e.checkVisibility()).map((e) => e.dataset.title ?? e.textContent));
const place = (page, text) =>
  on.until(
    page,
    (t) => document.querySelector('.results:not(.away) .scrubber output').textContent === t,
    `it should be ${text}`,
    text,
  );

test('Saved, PicturesAreGoneThroughByKeysAloneWithPlayAndPause', () =>
  saved(
    async (page) => {
      await on.run(page, '-- mock.views 5\n');
      await on.finished(page);
    },
    async (page, address) => {
      await place(page, '7 of 7');
      assert.deepEqual(await seen(page, '.frames figure'), ['Press 1: 152.8 MPa']);
      await page.focus('.scrub');
      await page.keyboard.press('Home');
      await place(page, '1 of 7');
      assert.deepEqual(await seen(page, '.frames figure'), ['Surface 1: weierstrass_mandelbrot']);
      for (let k = 0; k < 2; ++k) await page.keyboard.press('ArrowRight');
      assert.deepEqual(await seen(page, '.frames figure'), ['contact:press at 2 MPa']);
      assert.equal(await page.$eval('.scrub', (e) => e.getAttribute('aria-valuetext')), '3 of 7: contact:press at 2 MPa');
      await on.hold(page);
      await on.chord(page, 'Shift', 'Tab');
      assert.equal(await on.focused(page), 'Play');
      await page.keyboard.press('Space');
      assert.equal(await on.focused(page), 'Pause');
      await on.tick(page);
      await place(page, '5 of 7');
      await on.until(page, () => window.held.size > 0, 'it should be shown');
      await page.keyboard.press('Space');
      assert.equal(await page.evaluate(() => window.held.size), 0, 'a pause should hold');
      await page.keyboard.press('Space');
      await on.release(page);
      await place(page, '7 of 7');
      await on.until(page, () => document.querySelector('.scrubber button').textContent === 'Play', 'it should end');
      await on.assertAccessible(page, 'a saved run');
      await page.emulateMediaType('print');
      assert.equal((await seen(page, '.frames figure')).length, 7);
      assert.deepEqual(await seen(page, '.scrubber'), []);
      await page.emulateMediaType('screen');
      // Without scripts all pictures are shown, too.
      await page.setJavaScriptEnabled(false);
      await page.goto(address);
      assert.equal((await page.$$('.frames figure:not(.away)')).length, 7);
    },
  ));

test('Saved, KnobsGoFromOneRecordedRunToTheNext', () =>
  saved(
    async (page) => {
      const printed = (text) =>
        on.until(page, (t) => document.querySelector('#output').textContent.includes(t), `it should print ${text}`, text);
      await on.openTab(page, 'output');
      await on.run(page, '-- mock.knob pressure 1e6 1e8 1e7 Pa\n-- mock.knob cells 1 5 3 one\n-- mock.views 2\n');
      await printed('pressure is 10000000');
      await on.until(page, () => document.querySelectorAll('.knob').length === 2, 'the sliders should come');
      await page.focus('.knobs input');
      await page.keyboard.press('End');
      await printed('pressure is 100000000');
      await on.finished(page);
      await page.focus('.knobs input');
      await page.keyboard.press('Home');
      await printed('pressure is 1000000\n');
      await on.finished(page);
    },
    async (page) => {
      const values = () => page.$$eval('.sliders output', (all) => all.map((e) => e.textContent));
      assert.match(await on.text(page, '.about + h2 + ul'), /pressure: 1 MPa \(1 MPa to 100 MPa\)cells: 3 one/);
      assert.match(await page.evaluate(() => document.body.innerText), /3 runs were recorded and are all in this file/);
      // An unmoved knob has no slider.
      assert.deepEqual(await page.$$eval('.sliders input', (all) => all.map((e) => [e.ariaLabel, e.max])), [['pressure', '2']]);
      assert.deepEqual(await values(), ['1 MPa']);
      const output = async () => (await seen(page, '.results pre')).join('').split('\n')[0];
      assert.equal(await output(), 'pressure is 1000000');
      // The selected picture remains.
      await page.focus('.scrub');
      await page.keyboard.press('Home');
      await page.focus('.sliders input');
      await page.keyboard.press('ArrowRight');
      assert.deepEqual(await values(), ['10 MPa']);
      assert.equal(await output(), 'pressure is 10000000');
      await place(page, '1 of 4');
      await page.keyboard.press('End');
      assert.equal(await output(), 'pressure is 100000000');
      assert.equal(await page.$eval('.sliders input', (e) => e.getAttribute('aria-valuetext')), '100 MPa, 3 of 3 that were recorded');
      assert.deepEqual(await seen(page, '.results > h2:first-child'), ['Recorded at pressure 100 MPa, cells 3 one']);
      await on.assertAccessible(page, 'a saved run with knobs');
      await page.emulateMediaType('print');
      assert.equal((await seen(page, '.results > h2:first-child')).length, 3);
    },
  ));

test('Saved, AKnobAtOneValueIsFixedAndSaysSo', () =>
  saved(
    async (page) => {
      await on.run(page, '-- mock.knob pressure 1e6 1e8 1e7 Pa\n');
      await on.finished(page);
      await on.knobSays(page, '10 MPa');
    },
    async (page) => {
      assert.match(
        await page.evaluate(() => document.body.innerText),
        /pressure: 10 MPa \(1 MPa to 100 MPa\)\s+The values this run was made with\. They are fixed here/,
      );
      assert.equal(await page.$('.sliders'), null);
    },
  ));

test('Saved, PicturesOfOneNameButForANumberAreASequence', () =>
  saved(
    async (page) => {
      await on.run(page, '-- mock.file p-1.png mock.file p-2.png mock.file p-10.png mock.file a-1.svg mock.file a-2.svg mock.file a-3.svg mock.file q.png\n');
      await on.finished(page);
    },
    async (page) => {
      const images = () => page.$$eval('figure img', (all) => all.filter((e) => e.checkVisibility()).map((e) => e.alt));
      assert.deepEqual(await images(), ['p-10.png', 'a-1.svg', 'a-2.svg', 'a-3.svg', 'q.png', 'chart.svg']);
      await page.focus('.scrub');
      await page.keyboard.press('ArrowLeft');
      assert.equal((await images())[0], 'p-2.png');
    },
  ));
