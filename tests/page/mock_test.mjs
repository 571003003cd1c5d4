// SPDX-License-Identifier: GPL-3.0-or-later
// The page in Chromium against the stand-in server.

import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { test } from 'node:test';
import * as on from './browser.mjs';
import { browser, mock, visit } from './mock_page.mjs';
import { startMock } from './mock_server.mjs';

// Printed only: the time depends on the machine.
test('Start, OfFewRequestsAndBytes', async () => {
  const page = await on.openPage(browser, mock.url);
  await on.ready(page);
  const { requests, bytes, ms } = await on.start(page);
  console.log(`interactive after ${requests} requests, ${bytes} bytes, ${Math.round(ms)} ms`);
  assert.ok(requests >= 2 && requests <= 6, `${requests} requests`);
  assert.ok(bytes > 100_000 && bytes < 650_000, `${bytes} bytes`);
  await page.done();
});

test('Token, LeavesTheAddressAndOutlivesAReload', () =>
  visit({}, async (page) => {
    assert.equal(page.url(), `${mock.address}/`);
    await page.reload();
    await on.ready(page);
    assert.equal(await page.$eval('#banner', (e) => e.hidden), true);
  }));

test('Lesson, OpenedEditedKeptReset', () =>
  visit({}, async (page) => {
    await page.click('.lessons button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    assert.match(await on.text(page, '#lessons'), /Three faces have the same Ra/);
    assert.match(await on.text(page, '#lessons'), /A ball of 5 µm radius/);
    assert.match(await on.editorText(page), /lab\.notebook "tips"/);
    await on.write(page, 'print "mine"\n');
    await page.type('.prediction textarea', 'about half');
    await page.reload();
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should be open again');
    assert.equal((await on.editorText(page)).trim(), 'print "mine"');
    assert.equal(await page.$eval('.prediction textarea', (e) => e.value), 'about half');
    await page.click('#reset');
    assert.match(await on.editorText(page), /lab\.notebook "tips"/);
    assert.equal(await page.$eval('#reset', (e) => e.hidden), true);
  }));

for (const [width, height] of [
  [1280, 720],
  [960, 540],
  [390, 844],
])
  test(`Lesson, BeginsWithItsQuestionAndItsCodeAt${width}x${height}`, () =>
    visit({ width, height }, async (page) => {
      await page.click('.lessons li:nth-child(2) button');
      await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
      await on.settled(page, () => page.$eval('#lessons .called', (e) => JSON.stringify(e.getBoundingClientRect())));
      const { top, bottom } = await page.$eval('#lessons .called', (e) => e.getBoundingClientRect().toJSON());
      assert.ok(top >= 0 && bottom <= height, `the question is at ${top} to ${bottom}`);
      await on.until(
        page,
        () => {
          const root = document.querySelector('#editor').shadowRoot;
          const from = root.querySelector('.cm-scroller').getBoundingClientRect().top;
          const first = [...root.querySelectorAll('.cm-line')].find((l) => l.getBoundingClientRect().bottom > from + 4);
          return first?.textContent.startsWith('local lab');
        },
        'the editor should begin with the code',
      );
    }));

test('Lesson, BackGoesToTheListAndForwardToTheLesson', () =>
  visit({}, async (page) => {
    const { address } = mock;
    const lesson = () => on.until(page, () => document.querySelector('.lesson'), 'the lesson should be open');
    const list = () => on.until(page, () => document.querySelector('.lessons li'), 'the list should be there');
    await page.click('.lessons button');
    await lesson();
    await (await page.$('>>> .cm-content')).focus();
    await page.keyboard.type('-- mine');
    await page.goBack();
    await list();
    assert.equal(page.url(), `${address}/`, 'it is the page still');
    await page.click('.lessons li:nth-child(2) button');
    await on.until(page, () => /Fractal/.test(document.querySelector('#lessons h2').textContent), 'the second should open');
    await page.click('.back');
    await list();
    await page.goBack();
    await on.until(page, () => /Fractal/.test(document.querySelector('#lessons h2').textContent), 'the second again');
    await page.goBack();
    await list();
    await page.goForward();
    await lesson();
    await page.reload();
    await lesson();
    assert.equal(await on.text(page, '#script-title'), 'Fractal dimension and its traps');
    await page.click('.back');
    await list();
    await page.click('.lessons li:first-child button');
    await lesson();
    assert.match(await on.editorText(page), /-- mine/, 'what was written is kept');
  }));

test('Lesson, PredictedBeforeItsTextIsRead', () =>
  visit({}, async (page) => {
    await page.click('.lessons button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    assert.match(
      await on.text(page, '#lessons'),
      /Question.*Three faces.*Predict.*A ball of 5 µm.*Your prediction.*its run compares them.*Ra is how far.*Then try:/s,
    );
    const box = await on.placeOf(page, '.prediction textarea');
    assert.ok(box.y + box.height < 720, 'the box is seen without scrolling');
    assert.equal(
      await page.$eval(
        '.prediction textarea',
        (e) => document.getElementById(e.getAttribute('aria-describedby')).textContent,
      ),
      'Kept here and with a saved run.',
    );
    await page.click('.back');
    await page.waitForSelector('.lessons li:nth-child(2) button');
    await page.click('.lessons li:nth-child(2) button');
    await on.until(page, () => document.querySelector('.lesson'), 'the other lesson should open');
    assert.equal(await page.$('.prediction input'), null);
  }));

test('Lesson, MarkupInItsTextStaysText', () =>
  visit({}, async (page) => {
    await page.click('.lessons button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    assert.match(await on.text(page, '.lesson'), /<img src=x onerror="window.injected=1">/);
    assert.equal(await page.$('.lesson img'), null);
    assert.deepEqual(await page.$$eval('.lesson a', (links) => links.map((l) => l.href)), ['https://example.org/']);
    assert.equal(await page.evaluate(() => window.injected), undefined);
  }));

test('Run, OutputRowsExpectationsAndFiles', () =>
  visit({}, async (page) => {
    await on.run(page, 'print "before <b>"\nfor N = 1, 8 do end\n');
    await on.finished(page);
    assert.match(await on.text(page, '.output'), /^before <b>\nevent 1: Ra 2\.80 um\n/);
    assert.match(await on.text(page, '.expectations'), /held: Ra falls with N.*not held: mu at most 0\.4/);
    await on.openTab(page, 'table');
    await on.until(
      page,
      () => document.querySelectorAll('#table tbody tr').length === 16,
      'a row of the table for every row of the notebooks',
    );
    assert.deepEqual(await page.$$eval('#table thead th', (h) => h.map((e) => e.textContent)), [
      '#',
      'N',
      'face',
      'Ra [µm]',
      'mu',
    ]);
    assert.deepEqual(await page.$$eval('#table tbody tr:first-child td', (h) => h.map((e) => e.textContent)), [
      '1',
      '1',
      'swell',
      '2.1',
      '0.32',
    ]);
    await on.openTab(page, 'files');
    await on.until(
      page,
      () => document.querySelector('.previews img')?.complete,
      'the chart should be shown',
    );
    const preview = await on.placeOf(page, '.previews img');
    const room = await page.$eval('.previews', (e) => e.clientWidth);
    // As wide as its place, or as its letters need.
    assert.ok(room > 300 && Math.abs(preview.width - Math.max(800, room)) < 4, `${preview.width} of ${room}`);
    assert.ok(Math.abs(preview.height - preview.width / 2) < 4, `in its own shape: ${preview.height}`);
    assert.deepEqual(await page.$$eval('.files button', (b) => b.map((e) => e.textContent)), ['tips.csv', 'chart.svg']);
    await page.click('.previews button');
    assert.equal(await page.$eval('dialog.enlarged', (e) => e.open), true);
    await page.keyboard.press('Escape');
    await on.until(page, () => !document.querySelector('dialog.enlarged'), 'Escape should close it');
  }));

test('Run, TablesAreNotWrappedAndScrollByKeys', () =>
  visit({}, async (page) => {
    const wide = 'pressure   touching   in the spots   '.repeat(6);
    await on.run(page, `print "${wide}|"\nprint "elastic"\n`);
    await on.finished(page);
    const sizes = await page.$eval('.output', (e) => ({
      lines: Math.round(e.clientHeight / parseFloat(getComputedStyle(e).lineHeight)),
      scrolls: document.querySelector('#output').scrollWidth > document.querySelector('#output').clientWidth,
      bar: document.querySelector('#output').getBoundingClientRect().bottom <= innerHeight, // the scroll bar's
    }));
    assert.deepEqual(sizes, { lines: 2, scrolls: true, bar: true });
    await page.focus('.output');
    const left = () => page.$eval('#output', (e) => e.scrollLeft);
    await on.comesTrue(async () => {
      await page.keyboard.press('ArrowRight');
      await on.painted(page);
      return (await left()) > 0;
    }, 'arrow keys should scroll it');
    // A key's smooth scrolling may still be on its way.
    await on.comesTrue(async () => {
      await page.$eval('#output', (e) => (e.scrollLeft = 0));
      await on.painted(page);
      await on.painted(page);
      return (await left()) === 0;
    }, 'it should rest at its beginning');
    await on.assertFits(page, 'a wide table');
    await on.assertAccessible(page, 'a wide table');
    const sentence = 'And that is why friction is a coefficient. '.repeat(4);
    await on.run(page, `print "${wide}|"\nprint ""\nprint "${sentence}"\n`);
    await on.until(
      page,
      () => /friction.*\n$/.test(document.querySelector('.output .prose')?.textContent),
      'the sentence should be told apart',
    );
    assert.equal(await on.text(page, '.output'), `${wide}|\n\n${sentence}\n`);
    assert.equal(
      await page.$eval('.output .prose', (e) => {
        // A trailing space may overhang.
        const lines = [...e.getClientRects()];
        return lines.length > 3 && lines.every((l) => l.width < e.parentElement.clientWidth + 12);
      }),
      true,
    );
  }));

test('Run, ProgressAndStopByEscape', () =>
  visit({}, async (page) => {
    await on.run(page, 'while true do end\n');
    await on.until(
      page,
      () => /half-space solve · [1-9]\d* % · about \d+ s left/.test(document.querySelector('#status').textContent),
      'progress should be told',
    );
    assert.ok((await page.$eval('#progress', (e) => e.value)) > 0);
    assert.equal(await page.$eval('#run', (e) => e.disabled), true);
    await page.keyboard.press('Escape');
    await on.finished(page, 'Stopped');
    assert.equal(await page.$eval('#run', (e) => e.disabled), false);
  }));

test('Run, StopByButton', () =>
  visit({}, async (page) => {
    await on.run(page, 'while true do end\n');
    await page.waitForSelector('#stop:not([disabled])');
    await page.click('#stop');
    await on.finished(page, 'Stopped');
  }));

test('Run, TakenUpAgainAfterAReload', () =>
  visit({}, async (page) => {
    await on.run(page, 'print "early"\nwhile true do end\n');
    await on.until(
      page,
      () => document.querySelector('.output').textContent.includes('early'),
      'the output should come',
    );
    await page.reload();
    await on.until(
      page,
      () =>
        document.querySelector('.output')?.textContent.includes('early') && !document.querySelector('#stop').disabled,
      'the run should go on',
    );
    await page.click('#stop');
    await on.finished(page, 'Stopped');
  }));

test('Run, ABrokenConnectionIsTakenUpWhereItWas', () =>
  visit({}, async (page) => {
    mock.cut(2);
    await on.run(page, 'for N = 1, 8 do end\n');
    await on.finished(page);
    assert.equal((await on.text(page, '.output')).match(/event \d/g).length, 8);
  }));

test('Run, LongOutputKeepsItsEndAndSaysSo', () =>
  visit({}, async (page) => {
    await on.run(page, '-- mock.flood\n');
    await on.finished(page);
    const shown = await on.text(page, '.output');
    assert.match(shown, /^… the first \d+ characters are not shown/);
    assert.ok(shown.endsWith('line 29999 of many, to fill the pane\n'));
  }));

test('Mistakes, MarkedAtTheirLine', () =>
  visit({}, async (page) => {
    await on.write(page, 'local lab = require "asperity"\nlab.surface.sine{ amplitud=1 }\n');
    await on.until(page, () => document.querySelector('#problems li'), 'the check should find it');
    assert.equal(await on.text(page, '#problems li'), 'Line 2unknown key amplitud\ndid you mean amplitude?');
    assert.equal((await page.$$('>>> .cm-lintRange-error')).length, 1);
    await on.run(page, 'local x = 1\nerror "no `such` load"\n');
    await on.finished(page, 'Failed');
    assert.match(await on.text(page, '#output .failure'), /^Line 2 no such loadmend that line/);
    const marked = () => page.$$eval('>>> .cm-lintRange-error', (parts) => parts.map((e) => e.textContent).join(''));
    await on.comesTrue(async () => (await marked()) === 'error "no `such` load"', 'its line should be marked, and no other');
    assert.match(await on.text(page, '#live'), /Line 2: no `such` load/);
  }));

test('Completion, ByTypingAndByKey', () =>
  visit({}, async (page) => {
    await on.write(page, '');
    await page.keyboard.type('x = lab.surface.se');
    await on.accept(page, 'self_affine');
    assert.equal(await on.editorText(page), 'x = lab.surface.self_affine');
    await on.write(page, 'lab.surface.');
    await on.chord(page, 'Control', ' ');
    await on.inEditor(page, '.cm-tooltip-autocomplete li');
    assert.equal((await page.$$('>>> .cm-tooltip-autocomplete li')).length, 3);
    await page.keyboard.press('Escape');
  }));

test('Chart, AnyColumnAgainstAnyOther', () =>
  visit({}, async (page) => {
    await on.run(page, 'for N = 1, 8 do end\n');
    await on.finished(page);
    await on.openTab(page, 'chart');
    await page.waitForSelector('.chart svg circle');
    await page.click('.charts summary');
    const [x, y, , per] = (await page.$$('.charts select')).slice(-4);
    assert.match(await on.text(page, '.charts .caption'), /^Ra \[µm\] against N: 16 points, 2 lines, one per face\./);
    await per.select('');
    assert.match(await on.text(page, '.charts .caption'), /^Ra \[µm\] against N: 16 points\./);
    await x.select('Ra');
    await y.select('mu');
    await per.select('face');
    assert.match(await on.text(page, '.charts .caption'), /^mu against Ra \[µm\]: 16 points, 2 lines, one per face\./);
    // One line and eight marks per face, and one mark each in the legend.
    const marks = (shape) => page.$$eval(`.chart svg .dot ${shape}`, (all) => all.length);
    assert.deepEqual([await marks('circle'), await marks('path'), (await page.$$('.chart svg .line path')).length], [9, 9, 2]);
    for (const box of await page.$$('.charts input[type=checkbox]')) await box.click();
    assert.match(await on.text(page, '.chart svg'), /0\.4/);
    await on.assertFits(page, 'the chart');
  }));

test('Chart, BeginsWithWhatTheScriptCharts', () =>
  visit({}, async (page) => {
    const shown = async (script) => {
      await on.run(page, script);
      await on.finished(page);
      const [logX, logY] = await page.$$eval('.charts input[type=checkbox]', (boxes) => boxes.map((b) => b.checked));
      return { caption: await on.text(page, '.charts .caption'), logX, logY };
    };
    await on.run(page, 'for N = 1, 8 do end\n');
    await on.finished(page);
    await on.openTab(page, 'chart');
    // The second notebook; of a list, the columns of one unit.
    assert.deepEqual(
      await shown(
        'local none, book = 1, lab.notebook "big"\nfor N = 1, 8 do end -- mock.rows 9\n' +
          '-- book:chart{ x="v", y="i" }\n' +
          'book:chart{ x="i", y={ "v", "level" }, where={ i={ 1, 2, 3 } }, log_x=true,\n  title="a: book:chart{ x=1 }" }\n',
      ),
      { caption: 'v [µm] against i: 3 points.', logX: true, logY: false },
    );
    assert.deepEqual(
      await shown(
        'local book = lab.notebook("tips")\nfor N = 1, 8 do end\n' +
          'book:chart{ x="Ra", y="mu", one_line_per="face", log_x=true, log_y=true }\n',
      ),
      { caption: 'mu against Ra [µm]: 16 points, 2 lines, one per face.', logX: true, logY: true },
    );
    // Else the columns that vary.
    const loop = 'for _, y in ipairs(all) do book:chart{ x=x, y=y } end -- mock.rows 9\n';
    assert.equal((await shown(loop)).caption, 'v [µm] against i: 9 points.');
    assert.equal(
      (await shown('book:write{ level=0, ["v [m]"]=v, i=i } -- mock.rows 9\n')).caption,
      'i against v [µm]: 9 points.',
    );
    // A manual choice remains.
    const [, y] = (await page.$$('.charts select')).slice(-4);
    await y.select('level');
    assert.equal((await shown(loop)).caption, 'level against v [µm]: 9 points.');
  }));

test('Chart, LinesOnEachOtherAreBothSeen', () =>
  visit({}, async (page) => {
    await on.openTab(page, 'chart');
    const dashed = () => page.$$eval('.chart svg .line path', (all) => all.map((e) => getComputedStyle(e).strokeDasharray !== 'none'));
    await on.run(page, '-- mock.alike\n');
    await on.finished(page);
    await page.waitForSelector('.chart svg .line path'); // after the chunk of charts
    assert.match(await on.text(page, '.charts .caption'), /8 points, 2 lines, one per way/);
    assert.deepEqual(await dashed(), [false, true]);
    await on.run(page, 'for N = 1, 8 do end\n');
    await on.finished(page);
    assert.deepEqual(await dashed(), [false, false]);
  }));

test('Chart, ManyPointsDoNotHideTheirLine', async () => {
  const downloads = mkdtempSync(join(tmpdir(), 'asperity-page-'));
  const blue = [11, 95, 165];
  let file;
  try {
    await visit({ downloads }, async (page) => {
      await on.openTab(page, 'chart');
      for (const rows of [20, 60, 300, 5000]) {
        await on.run(page, `-- mock.rows ${rows}\n`);
        await on.until(
          page,
          (n) => document.querySelector('.charts .caption').textContent.includes(`${n} points`),
          'the rows should be drawn',
          rows,
        );
        await on.finished(page);
        const share = await on.inked(page, '.chart svg', blue);
        assert.ok(share > 0.65, `the curve of ${rows} rows is seen over ${share} of the width`);
      }
      assert.match(await on.text(page, '.charts .caption'), /: 5000 points, too close together to be marked/);
      assert.equal((await page.$$('.chart svg circle')).length, 0);
      file = await on.save(page, downloads);
    });
    const saved = await on.openPage(browser, `file://${file}`);
    assert.ok((await on.inked(saved, 'figure svg', blue)) > 0.65, 'and in the saved run');
    const picture = await on.placeOf(saved, 'figure img');
    assert.ok(picture.width > 500, `the script's chart in the saved run is ${picture.width} px wide`);
    await saved.done();
  } finally {
    rmSync(downloads, { recursive: true });
  }
});

test('Picture, DrawnTurnedExaggeratedAndHonest', () =>
  visit({}, async (page) => {
    await on.run(page, 'for N = 1, 8 do end\n');
    await on.finished(page);
    await on.openTab(page, 'picture');
    await on.until(
      page,
      () => document.querySelector('.picture .caption, .pictures .caption').textContent,
      'the picture should come',
    );
    assert.equal(
      await on.text(page, '.pictures .caption'),
      '1 × 1 mm · gap, drawn downwards, × 50 · shown: 128 × 128 means of 8 × 8 nodes of 1024 × 1024',
    );
    assert.equal(
      await on.text(page, '.pictures .left-out'),
      '7 more were made and not drawn, so as not to hold up the run.',
    );
    await page.focus('.relief');
    await page.keyboard.press('Home');
    const first = await on.pixels(page);
    assert.ok(first.colours > 100 && first.drawn > 0.15, `blank: ${first.colours} colours, ${first.drawn}`);
    for (let k = 0; k < 3; ++k) await page.keyboard.press('ArrowLeft');
    const turned = await on.pixels(page);
    assert.ok(on.differing(first, turned) > 0.02, 'arrow keys should turn it');
    await page.keyboard.press('Home');
    assert.ok(on.differing(first, await on.pixels(page)) < 0.002, 'Home should put it back');
    const box = await on.placeOf(page, '.stage');
    await page.mouse.move(box.x + 100, box.y + 100);
    await page.mouse.down();
    await page.mouse.move(box.x + 220, box.y + 140, { steps: 4 });
    await page.mouse.up();
    assert.ok(on.differing(first, await on.pixels(page)) > 0.02, 'the mouse should turn it');
    await page.click('.pictures summary');
    await page.focus('.choices input[type=range]');
    await page.keyboard.press('ArrowRight');
    await on.until(
      page,
      () => /× 100 ·/.test(document.querySelector('.pictures .caption').textContent),
      'the heights should be taken larger',
    );
    const [, colour] = await page.$$('.pictures select');
    await colour.select('contact');
    await on.until(
      page,
      () => /contactshare/.test(document.querySelector('.key').textContent),
      'the contact should be shown',
    );
    const [which] = await page.$$('.pictures select');
    await which.select('surface-1');
    await on.until(
      page,
      () => /heights × 50/.test(document.querySelector('.pictures .caption').textContent),
      'the surface should come',
    );
    assert.match(await on.text(page, '.key'), /height\[µm\]/);
  }));

test('Picture, OfAnotherScriptHasAFactorOfItsOwn', () =>
  visit({}, async (page) => {
    const factor = async (script, expected) => {
      await on.run(page, script);
      await on.finished(page);
      await on.openTab(page, 'picture');
      await on.until(
        page,
        () => {
          const { id } = JSON.parse(sessionStorage.getItem('asperity.run'));
          return performance.getEntriesByType('resource').some((e) => e.name.includes(`/api/runs/${id}/views/`));
        },
        'the picture should come',
      );
      await on.until(
        page,
        (f) => document.querySelector('.pictures .caption').textContent.includes(`× ${f} ·`),
        `the factor should be ${expected}`,
        expected,
      );
      await on.painted(page);
      assert.ok((await on.text(page, '.pictures .caption')).includes(`× ${expected} ·`), `it should stay ${expected}`);
    };
    await factor('-- a face\n', '50');
    await factor('-- mock.deep\n', '2');
    await page.click('.pictures summary');
    await page.focus('.choices input[type=range]');
    await page.keyboard.press('ArrowRight');
    await on.until(
      page,
      () => !/× 2 ·/.test(document.querySelector('.pictures .caption').textContent),
      'the factor should follow the slider',
    );
    const byHand = /× (\d+) ·/.exec(await on.text(page, '.pictures .caption'))[1];
    await factor('-- mock.deep\n', byHand);
  }));

test('Picture, OfARunOneAfterTheOtherByKeysAlone', () =>
  visit({}, async (page) => {
    await on.run(page, '-- mock.views 5\n');
    await on.finished(page);
    await on.openTab(page, 'picture');
    const place = (text) =>
      on.until(page, (t) => document.querySelector('.scrubber output').textContent === t, `it should be ${text}`, text);
    const selected = () => page.$eval('.pictures select', (e) => e.selectedOptions[0].textContent);
    await place('7 of 7');
    await page.focus('.scrub');
    await page.keyboard.press('Home');
    await place('1 of 7');
    await on.until(page, () => /^1 × 1 mm · heights/.test(document.querySelector('.pictures .caption').textContent), 'the surface should come');
    assert.match(await selected(), /^Surface 1/);
    for (let k = 0; k < 2; ++k) await page.keyboard.press('ArrowRight');
    await place('3 of 7');
    await on.until(page, () => /gap, drawn/.test(document.querySelector('.pictures .caption').textContent), 'the press should come');
    const shown = () => document.querySelector('.pictures select').selectedOptions[0].textContent === 'contact:press at 2 MPa';
    await on.until(page, shown, 'the press at 2 MPa should be selected');
    assert.equal(await page.$eval('.scrub', (e) => e.getAttribute('aria-valuetext')), '3 of 7: contact:press at 2 MPa');
    const third = await on.pixels(page);
    await on.hold(page);
    await page.keyboard.down('Shift');
    await page.keyboard.press('Tab');
    await page.keyboard.up('Shift');
    assert.equal(await on.focused(page), 'Play');
    await page.keyboard.press('Space');
    assert.equal(await on.focused(page), 'Pause');
    await place('4 of 7');
    await on.tick(page);
    await place('5 of 7');
    await on.until(page, () => window.held.size > 0, 'it should be shown');
    await page.keyboard.press('Space');
    assert.equal(await page.evaluate(() => window.held.size), 0, 'a pause should hold');
    assert.ok(on.differing(third, await on.pixels(page)) > 0.01, 'another picture should be seen');
    await page.keyboard.press('Space');
    await place('6 of 7');
    await on.release(page);
    await place('7 of 7');
    await on.until(page, () => document.querySelector('.scrubber button').textContent === 'Play', 'it should end');
    await on.hold(page);
    await page.keyboard.press('Space');
    await place('1 of 7');
    const [which] = await page.$$('.pictures select');
    await which.select('state-4');
    await place('5 of 7');
    await on.release(page);
    await on.assertAccessible(page, 'with pictures to go through');
    await on.assertFits(page, 'with pictures to go through');
  }));

test('Picture, AloneHasNothingToGoThrough', () =>
  visit({}, async (page) => {
    await on.run(page, 'error "early"\n');
    await on.finished(page, 'Failed');
    await on.openTab(page, 'picture');
    await on.until(page, () => document.querySelector('.pictures .caption').textContent, 'the picture should come');
    assert.equal(await page.$eval('.scrubber', (e) => e.hidden), true);
  }));

const printed = (page, text) =>
  on.until(page, (t) => document.querySelector('#output').textContent.includes(t), `it should print ${text}`, text);

test('Knob, MovedByKeysRunsTheScriptAgain', () =>
  visit({}, async (page) => {
    const runs = () => mock.runs.size;
    await on.openTab(page, 'output');
    await on.run(page, '-- mock.knob pressure 1e6 1e8 1e7 Pa 5e7\n-- mock.knob cells 1 5 3 one\n');
    await printed(page, 'pressure is 10000000');
    await on.knobSays(page, '10 MPa');
    await page.focus('.knobs input');
    const before = runs();
    await on.hold(page);
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowRight');
    await on.knobSays(page, '50 MPa');
    await on.release(page);
    await printed(page, 'pressure is 50000000');
    await printed(page, 'cells is 3');
    assert.equal(runs(), before + 1, 'two presses of a key are one move');
    assert.equal(await on.focused(page), 'pressure', 'the slider keeps the focus');
    // An error at one value only.
    await page.keyboard.press('End');
    await on.knobSays(page, '100 MPa');
    await printed(page, 'pressure is too much');
    await on.assertAccessible(page, 'with knobs');
    await on.assertFits(page, 'with knobs');
    await page.focus('.knobs input');
    await page.keyboard.press('Home');
    await on.knobSays(page, '1 MPa');
    await printed(page, 'pressure is 1000000');
    await on.finished(page);
    // Run uses the script's own values.
    await page.click('#run');
    await printed(page, 'pressure is 10000000');
    await on.knobSays(page, '10 MPa');
    await on.run(page, 'print "plain"\n');
    await printed(page, 'plain');
    await on.until(page, () => document.querySelector('.knobs').hidden, 'no knob should be left');
  }));

test('Knob, MovedWhileARunGoesOnStopsThatRun', () =>
  visit({}, async (page) => {
    await on.openTab(page, 'output');
    await on.run(page, '-- mock.knob p 0 4 1 one\n-- mock.waits 1\n');
    await printed(page, 'p is 1');
    await on.knobSays(page, '1 one');
    await on.finished(page);
    const before = mock.runs.size;
    mock.full = true;
    await page.focus('.knobs input');
    await page.keyboard.press('End');
    await on.until(page, () => document.querySelector('#status').textContent.startsWith('Waiting'), 'it should run again');
    await on.hold(page);
    await page.keyboard.press('Home');
    await page.keyboard.press('ArrowRight');
    await on.release(page);
    await on.comesTrue(() => mock.runs.size === before + 2, 'a run of the new value should begin');
    mock.full = false;
    await printed(page, 'p is 0.2');
    await on.finished(page);
    assert.equal(mock.runs.size, before + 2);
    const states = [...mock.runs.values()].slice(-2).map((r) => r.events.at(-1).status);
    assert.deepEqual(states, ['stopped', 'done']);
    assert.equal(await on.knobText(page), '0.2 one');
  }));

test('Knob, StepsAreRoundAndReachBothBounds', () =>
  visit({}, async (page) => {
    const values = async (key) => {
      const found = [];
      await page.focus('.knobs input');
      for (let last; last !== (await on.knobText(page)); await page.keyboard.press(key)) {
        last = await on.knobText(page);
        found.push(last);
      }
      return found.join();
    };
    await on.run(page, '-- mock.knob p 1e6 3e8 1.55e7 Pa\n');
    await on.knobSays(page, '15.5 MPa');
    await on.hold(page);
    assert.equal(await values('ArrowLeft'), '15.5 MPa,10 MPa,5 MPa,2 MPa,1 MPa');
    assert.equal(await values('ArrowRight'), '1 MPa,2 MPa,5 MPa,10 MPa,20 MPa,50 MPa,100 MPa,200 MPa,300 MPa');
    await page.keyboard.press('Home');
    // A pointer reaches the values between.
    const drawn = await page.$eval('.knobs input', (e) =>
      [...Array(24).keys()].map((place) => {
        e.value = place;
        e.dispatchEvent(new Event('input'));
        return parseFloat(e.getAttribute('aria-valuetext'));
      }),
    );
    assert.equal(
      drawn.join(' '),
      '1 1.1 1.2 1.3 1.4 1.5 1.6 1.7 1.8 1.9 2 2.2 2.4 2.6 2.8 3 3.2 3.4 3.6 3.8 4 4.2 4.4 4.6',
    );
    await on.release(page);
    await on.run(page, '-- mock.knob a -0.03 0.25 0.03 rad\n');
    await on.knobSays(page, '0.03 rad');
    await on.hold(page);
    assert.equal(await values('ArrowDown'), '0.03 rad,0.02 rad,0 rad,−0.02 rad,−0.03 rad');
    await page.keyboard.press('End');
    assert.equal(await on.knobText(page), '0.25 rad');
    await on.release(page);
  }));

test('Knob, TakesANumberWithItsUnit', () =>
  visit({}, async (page) => {
    await on.openTab(page, 'output');
    await on.run(page, '-- mock.knob pressure 1e6 3e8 2e7 Pa\n');
    await on.knobSays(page, '20 MPa');
    await on.finished(page);
    await page.focus('.knobs input');
    await page.keyboard.press('Tab');
    assert.equal(await on.focused(page), 'pressure, as a number');
    for (const [given, shown] of [
      ['50', '50 MPa'],
      ['7,5 MPa', '7.5 MPa'],
      ['0.1GPa', '100 MPa'],
      ['155 bar', '15.5 MPa'],
      ['2e3 kN/m²', '2 MPa'],
      ['3 N/mm^2', '3 MPa'],
    ]) {
      await on.typeKnob(page, given);
      await on.knobSays(page, shown);
      assert.equal(await page.$eval('.knobs input[type=range]', (e) => e.getAttribute('aria-valuetext')), shown);
      assert.equal(await page.$eval('.problem', (e) => e.hidden), true, given);
    }
    await printed(page, 'pressure is 3000000\n');
    const before = mock.runs.size;
    for (const [given, words] of [
      ['fast', '“fast” is no number. Give Pa, for example 1.5 MPa.'],
      ['5 Mpa', '“Mpa” is no unit of this. Give Pa, for example 1.5 MPa.'],
      ['5 mm', '“mm” is no unit of this. Give Pa, for example 1.5 MPa.'],
      ['5 GPa', '5 GPa is out of bounds. Give pressure from 1 MPa to 300 MPa.'],
    ]) {
      await on.typeKnob(page, given);
      assert.equal(await on.text(page, '.problem'), words);
      assert.equal(await on.knobText(page), given, 'it can be mended');
    }
    await on.assertAccessible(page, 'a number that is refused');
    await on.assertFits(page, 'a number that is refused');
    await page.keyboard.press('Escape');
    assert.equal(await on.knobText(page), '3 MPa');
    assert.equal(await page.$eval('.problem', (e) => e.hidden), true);
    assert.equal(mock.runs.size, before, 'no run was made of them');
  }));

test('Knob, ValuesTriedLeaveATrailInTheChart', () =>
  visit({}, async (page) => {
    const curves = () => page.$$eval('.chart .line path', (all) => all.map((e) => e.textContent));
    const tried = (values) =>
      on.until(page, (n) => document.querySelectorAll('.chart .line path').length === n, `${values} should be drawn`, values);
    const script = 'local book = lab.notebook "big" -- mock.rows 9\nbook:chart{ x="i", y="v" }\n-- mock.knob p 1 9 3 one\n';
    await on.run(page, script);
    await on.finished(page);
    await tried(1);
    for (const [value, n] of [
      ['5', 2],
      ['7', 3],
      ['5', 3],
    ]) {
      await on.typeKnob(page, value);
      await on.finished(page);
      await tried(n);
    }
    assert.deepEqual(await curves(), ['p 3 one', 'p 7 one', '']);
    assert.match(await on.text(page, '.charts .caption'), /: 9 points\. Faint: 2 values tried before, the last p 7 one\.$/);
    await on.assertAccessible(page, 'a chart with a trail');
    await on.assertFits(page, 'a chart with a trail');
    await page.focus('.charts .below button');
    await page.keyboard.press('Enter');
    await tried(1);
    assert.equal(await page.$eval('.charts .below button', (e) => e.hidden), true);
    await on.typeKnob(page, '8');
    await on.finished(page);
    await tried(2);
    // Another script has its own.
    await on.run(page, `${script}-- other\n`);
    await on.finished(page);
    await tried(1);
  }));

test('Keyboard, Alone', () =>
  visit({}, async (page) => {
    const seen = [];
    for (let k = 0; k < 7; ++k) {
      await page.keyboard.press('Tab');
      seen.push(await on.focused(page));
    }
    assert.deepEqual(seen.slice(0, 3), ['lessons-button', 'script-button', 'run']);
    assert.ok(
      await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle !== 'none'),
      'the focus should be seen',
    );
    await page.focus('#keys-button');
    for (let k = 0; k < 20 && !(await on.focused(page)).includes('What roughness'); ++k)
      await page.keyboard.press('Tab');
    await page.keyboard.press('Enter');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    await page.keyboard.press('F6');
    assert.match(await on.focused(page), /Script in Lua/);
    await page.keyboard.press('Tab');
    assert.match(await on.editorText(page), /^ {2}/, 'Tab indents');
    await page.keyboard.press('Escape');
    await page.keyboard.press('Tab');
    assert.doesNotMatch(await on.focused(page), /Script in Lua/, 'Escape, then Tab, leaves');
    await on.chord(page, 'Control', 'Enter');
    assert.match(await on.focused(page), /Predict first/);
    await page.keyboard.press('Tab');
    await page.keyboard.press('Enter');
    await on.finished(page);
    await page.keyboard.press('F6');
    if (!(await on.focused(page)).startsWith('tab-')) await page.keyboard.press('F6');
    assert.equal(await on.focused(page), 'tab-output');
    for (const name of ['table', 'chart', 'picture', 'files']) {
      await page.keyboard.press('ArrowRight');
      assert.equal(await on.focused(page), `tab-${name}`);
      assert.equal(await page.$eval(`#${name}`, (e) => e.hidden), false);
    }
    await page.waitForSelector('.previews img');
    await page.keyboard.press('Tab');
    assert.match(await on.focused(page), /Save tips\.csv|Enlarge chart\.svg/);
    await on.chord(page, 'Shift', 'F6');
    assert.match(await on.focused(page), /Script in Lua/);
    await page.focus('#results-divider');
    const width = () => page.$eval('#results', (e) => e.clientWidth);
    const before = await width();
    await page.keyboard.press('ArrowLeft');
    assert.ok((await width()) > before);
    await page.focus('#keys-button');
    await page.keyboard.press('Enter');
    assert.equal(await page.$eval('#keys', (e) => e.open), true);
    await page.keyboard.press('Escape');
    assert.equal(await page.$eval('#keys', (e) => e.open), false);
    assert.equal(await on.focused(page), 'keys-button');
  }));

for (const scheme of ['light', 'dark']) {
  test(`Projector, Everything fits and is legible in ${scheme}`, () =>
    visit({ scheme }, async (page) => {
      await on.assertFits(page, 'at the start');
      await on.assertAccessible(page, 'at the start');
      await page.click('.lessons button');
      await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
      await on.run(page, 'print "x"\nlab.surface.sine{ amplitud=1 }\nfor N = 1, 8 do end\n');
      await on.finished(page);
      for (const name of ['output', 'table', 'chart', 'picture', 'files']) {
        await on.openTab(page, name);
        if (name === 'picture')
          await on.until(page, () => document.querySelector('.pictures .caption').textContent, 'the picture should come');
        if (name === 'files') await on.until(page, () => document.querySelector('.previews img')?.complete, 'the chart should come');
        await on.painted(page);
        await on.assertFits(page, name);
        await on.assertAccessible(page, name);
      }
      await on.run(page, 'error "it must be legible too"\n');
      await on.finished(page, 'Failed');
      await on.assertFits(page, 'an error');
      await on.assertAccessible(page, 'an error');
      await page.click('#keys-button');
      await on.assertAccessible(page, 'the keys');
    }));
}

for (const [width, height] of [
  [1280, 577],
  [1024, 600],
  [800, 600],
])
  test(`Picture, CaptionAndColoursStandApartAt${width}x${height}`, async () => {
    const page = await on.openPage(browser, mock.url, { width, height });
    try {
      await on.ready(page);
      await on.run(page, 'for N = 1, 8 do end\n');
      await on.finished(page);
      await on.openTab(page, 'picture');
      await on.until(page, () => document.querySelector('.key svg'), 'the colours should be shown');
      await on.painted(page);
      for (const field of ['pressure', 'contact', 'gap']) {
        await page.evaluate((name) => {
          const choice = [...document.querySelectorAll('#picture select')].find((s) =>
            [...s.options].some((o) => o.value === name),
          );
          if (!choice) return;
          choice.value = name;
          choice.dispatchEvent(new Event('change', { bubbles: true }));
        }, field);
        await on.painted(page);
        const { key, caption } = await page.evaluate(() => {
          const box = (e) => {
            const { left, top, right, bottom } = e.getBoundingClientRect();
            return { left, top, right, bottom };
          };
          return {
            key: box(document.querySelector('.key svg')),
            caption: box(document.querySelector('#picture-caption')),
          };
        });
        assert.ok(key.right - key.left >= 240, `the colours have ${key.right - key.left} px`);
        assert.ok(
          key.bottom <= caption.top || key.top >= caption.bottom || key.right <= caption.left || key.left >= caption.right,
          `${field}: ${JSON.stringify({ key, caption })}`,
        );
      }
      await on.assertQuiet(page);
    } finally {
      await page.done();
    }
  });

test('Script, OfTwoTabsBothAreKept', () =>
  visit({}, async (page) => {
    await on.write(page, 'print "one"\n');
    const other = await page.browserContext().newPage();
    other.setDefaultTimeout(0);
    await other.goto(mock.url);
    await on.ready(other);
    assert.equal((await on.editorText(other)).trim(), 'print "one"');
    await on.write(other, 'print "two"\n');
    await on.until(
      page,
      () => /another tab/.test(document.querySelector('#banner').textContent),
      'the first tab should be warned',
    );
    await page.reload();
    await on.ready(page);
    assert.equal((await on.editorText(page)).trim(), 'print "one"');
    await other.reload();
    await on.ready(other);
    assert.equal((await on.editorText(other)).trim(), 'print "two"');
    await other.close();
  }));

test('Run, AskedForWhileAnotherGoesOnSaysSo', () =>
  visit({}, async (page) => {
    await on.run(page, 'while true do end\n');
    await on.until(page, () => /Running/.test(document.querySelector('#status').textContent), 'it should run');
    assert.equal(await page.$eval('#banner', (e) => e.hidden), true);
    await on.chord(page, 'Control', 'Enter');
    await on.until(
      page,
      () =>
        !document.querySelector('#banner').hidden &&
        /still running/.test(document.querySelector('#banner').textContent),
      'the page should say that a script is running',
    );
    await page.click('#stop');
    await on.finished(page, 'Stopped');
    assert.equal(await page.$eval('#banner', (e) => e.hidden), true);
  }));

test('Run, SaysHowManyAreBeforeIt', () =>
  visit({}, async (page) => {
    mock.full = true;
    await on.run(page, '-- mock.waits 3\nfor N = 1, 8 do end\n');
    await on.until(
      page,
      () => /Waiting for its turn, 3 before you/.test(document.querySelector('#status').textContent),
      'it should say how many are before it',
    );
    mock.full = false;
    await on.finished(page);
  }));

test('Save, OneFileThatOpensAnywhere', async () => {
  const downloads = mkdtempSync(join(tmpdir(), 'asperity-page-'));
  let file;
  try {
    await visit({ downloads }, async (page) => {
      await page.click('.lessons button');
      await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
      await page.type('.prediction textarea', 'it <i>halves</i>');
      await on.run(
        page,
        '-- </script><script>window.injected=1</script> & "quoted"\n-- mock.knob pressure 1e6 1e8 1e7 Pa\nprint "</pre><b>bold</b>"\nfor N = 1, 8 do end\n',
      );
      await on.finished(page);
      await on.knobSays(page, '10 MPa');
      file = await on.save(page, downloads);
    });
    assert.equal(basename(file), 'what-roughness-is-and-what-a-stylus-misses.html');
    const html = readFileSync(file, 'utf8');
    assert.doesNotMatch(html, /\bsrc="(?!data:)|href="(?!data:)|url\((?!#)/i);
    // The policy permits only the file's single script.
    const scripts = [...html.matchAll(/<script>([^]*?)<\/script>/g)].map((m) => m[1]);
    assert.equal(html.match(/<script/g).length, 1);
    const digest = createHash('sha256').update(scripts[0], 'utf8').digest('base64');
    assert.ok(html.includes(`default-src 'none'; script-src 'sha256-${digest}'; style-src 'unsafe-inline'; img-src data:`));

    const saved = await on.openPage(browser);
    const asked = [];
    saved.on('request', (r) => asked.push(r.url()));
    await saved.goto(`file://${file}`);
    const shown = await saved.evaluate(() => document.body.innerText);
    assert.match(shown, /<\/script><script>window\.injected=1<\/script> & "quoted"/);
    assert.match(shown, /<\/pre><b>bold<\/b>/);
    assert.match(shown, /it <i>halves<\/i>/);
    assert.match(shown, /Ra \[µm\]/);
    assert.match(shown, /pressure: 10 MPa \(1 MPa to 100 MPa\)/);
    assert.match(shown, /held: Ra falls with N/);
    assert.match(shown, /128 × 128 means of 8 × 8 nodes of 1024 × 1024/);
    assert.equal(await saved.evaluate(() => window.injected), undefined);
    const counts = await saved.evaluate(async () => {
      const images = [...document.querySelectorAll('img')];
      await Promise.all(images.map((i) => i.decode()));
      return {
        rows: document.querySelectorAll('tbody tr').length,
        points: document.querySelectorAll('svg circle').length,
        images: images.length,
        reliefs: document.querySelectorAll('figure > svg > image').length,
      };
    });
    assert.deepEqual(counts, { rows: 16, points: 9, images: 1, reliefs: 2 });
    assert.deepEqual(
      asked.filter((a) => !a.startsWith('data:') && !a.startsWith('file:')),
      [],
    );
    await on.assertQuiet(saved);
    await saved.done();
  } finally {
    rmSync(downloads, { recursive: true });
  }
});

test('Messages, NoTokenAndAWrongOne', async () => {
  const none = await on.openPage(browser, `${mock.address}/`);
  await none.waitForSelector('#banner:not([hidden])');
  assert.match(await on.text(none, '#banner'), /opened without its token.*Open the whole address/);
  assert.equal(await none.$eval('#run', (e) => e.disabled), true);
  await none.done();
  const wrong = await on.openPage(browser, `${mock.address}/#other`);
  await wrong.waitForSelector('#banner:not([hidden])');
  assert.match(await on.text(wrong, '#banner'), /does not know this page’s token/);
  await wrong.done();
});

for (const key of ['%', 'testtok%4'])
  test(`Messages, ADamagedAddressSaysSo ${key}`, async () => {
    const page = await on.openPage(browser, `${mock.address}/#${key}`);
    await page.waitForSelector('#banner:not([hidden])');
    assert.match(await on.text(page, '#banner'), /address of this page is damaged.*Open the whole address/);
    assert.equal(page.url(), `${mock.address}/`);
    // The whole address in the same tab opens the page.
    await page.goto(mock.url);
    await on.ready(page);
    assert.equal(await page.$eval('#banner', (e) => e.hidden), true);
    await on.assertQuiet(page);
    await page.done();
  });

test('Messages, RunsAtTheirLimitAndARunThatReachedOne', () =>
  visit({}, async (page) => {
    const others = [];
    for (let k = 0; k < 2; ++k) {
      others.push(
        await page.evaluate(
          async () =>
            (
              await (
                await fetch('/api/runs', {
                  method: 'POST',
                  headers: { Authorization: 'Bearer testtoken' },
                  body: JSON.stringify({ script: 'while true' }),
                })
              ).json()
            ).id,
        ),
      );
    }
    await on.run(page, 'print "one more"\n');
    await page.waitForSelector('#banner:not([hidden])');
    assert.match(
      await on.text(page, '#banner'),
      /2 runs are going, as many as this server allows\. Wait until one has ended, or stop one/,
    );
    for (const id of others)
      await page.evaluate(
        (i) => fetch(`/api/runs/${i}`, { method: 'DELETE', headers: { Authorization: 'Bearer testtoken' } }),
        id,
      );
    await on.comesTrue(mock.quiet, 'the others should end');
    await on.run(page, '-- mock.limit\n');
    await on.finished(page, 'Ended at a limit');
    assert.equal(await page.$eval('#banner', (e) => e.hidden), true);
    assert.match(await on.text(page, '.end'), /the run took longer than 30 s/);
  }));

test('Messages, OfANewServerTheOldRunIsNotAsked', async () => {
  const old = await startMock(on.pageFolder, { token: 'before' });
  const page = await on.openPage(browser, old.url);
  await on.ready(page);
  await on.run(page, 'print "old"\n');
  await on.finished(page);
  await old.close();
  const renewed = await startMock(on.pageFolder, { token: 'after', port: Number(new URL(old.address).port) });
  await page.goto(renewed.url);
  await on.until(page, () => document.querySelector('#results-of').textContent === 'No run yet', 'the old run should go');
  await on.ready(page);
  assert.equal(await page.$eval('#banner', (e) => e.hidden), true);
  assert.equal((await on.editorText(page)).trim(), 'print "old"');
  await page.done();
  await renewed.close();
});

test('Messages, TheServerIsGoneAndComesBack', async () => {
  const other = await startMock(on.pageFolder);
  const port = Number(new URL(other.address).port);
  const page = await on.openPage(browser, other.url);
  await on.ready(page);
  await other.close();
  await on.write(page, 'print "kept"\n');
  await page.waitForSelector('#banner:not([hidden])');
  assert.match(await on.text(page, '#banner'), /The server does not answer.*What you wrote is kept/);
  const again = await startMock(on.pageFolder, { port });
  await on.until(page, () => document.querySelector('#banner').hidden, 'the message should go when the server is back');
  await page.done();
  await again.close();
});
