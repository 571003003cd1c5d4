// SPDX-License-Identifier: GPL-3.0-or-later
// Teaching with the page in Chromium, against the stand-in server.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import * as on from './browser.mjs';
import { visit } from './mock_page.mjs';
import { startMock } from './mock_server.mjs';

const root = new URL('../../', import.meta.url);

const book = (rows, chart) => `local book = lab.notebook "big" -- mock.rows ${rows}\nbook:chart{ ${chart} }\n`;

/** Shows a script's first chart, whose caption must state the number of points. */
async function charted(page, script, points) {
  await on.run(page, script);
  await on.finished(page, 'Done|Failed');
  await on.openTab(page, 'chart');
  await on.until(
    page,
    (n) => document.querySelector('.charts .caption').textContent.includes(`: ${n} points`),
    'all should be drawn',
    points,
  );
}

const ticks = (page, axis) =>
  page.$$eval(`.chart .${axis}-axis-tick-label text`, (texts) =>
    texts.map((t) => {
      const { left, right, top, bottom } = t.getBoundingClientRect();
      return { text: t.textContent, left, right, top, bottom };
    }),
  );

test('Chart, EachColumnThatTheScriptChartsIsALine', () =>
  visit({}, async (page) => {
    await charted(page, book(9, 'x="v", y={ "level", "i" }'), 18);
    assert.equal((await page.$$('.chart .line path')).length, 2);
    assert.deepEqual(await page.$$eval('.chart .text text', (t) => t.map((e) => e.textContent).slice(-2)), ['level', 'i']);
    const places = await page.$$eval('.chart .dot circle', (all) => all.map((c) => Number(c.getAttribute('cy'))));
    assert.ok(
      places.every((y) => y > 0 && y < 1000),
      'the axis reaches both',
    );
    await charted(page, book(9, 'x="v", y="i"'), 9);
    await page.click('.charts summary');
    const [, , more] = (await page.$$('.charts select')).slice(-4);
    assert.deepEqual(await more.$$eval('option', (o) => o.map((e) => e.value)), ['', 'level']);
    await more.select('level');
    assert.equal((await page.$$('.chart .line path')).length, 2);
    await on.assertAccessible(page, 'a chart with its axes');
  }));

test('Chart, AxesHaveTheScriptsWordsAndNoneIsCut', () =>
  visit({ width: 1280, height: 577 }, async (page) => {
    const words = 'how much of it there is, and of all that is around it, and so on and on and on';
    await charted(page, book(9, `x="i", y={ "v" }, x_label="place along the way", y_label="${words}"`), 9);
    const labels = () =>
      page.evaluate(() => {
        const around = document.querySelector('.chart svg').getBoundingClientRect();
        return [...document.querySelectorAll('.chart .text text')].map((e) => {
          const { left, right, top, bottom } = e.getBoundingClientRect();
          return {
            text: e.textContent,
            outside: [around.left - left, right - around.right, around.top - top, bottom - around.bottom].filter((by) => by > 1),
          };
        });
      });
    const [x, y] = await labels();
    assert.deepEqual(x, { text: 'place along the way', outside: [] });
    assert.match(y.text, /^how much of it.*… \[µm\]$/, 'the unit is not cut');
    assert.deepEqual(y.outside, []);
    // An axis chosen by hand has its column's label.
    await page.click('.charts summary');
    const [along] = (await page.$$('.charts .choices select')).slice(0, 1);
    await along.select('level');
    const [other, same] = await labels();
    assert.equal(other.text, 'level');
    assert.match(same.text, /^how much of it/);
    // Long names are shortened, but not the unit.
    const many = Array.from({ length: 9 }, (_, k) => `"column ${k}"`).join(', ');
    await charted(page, `-- mock.wide 9\nlocal book = lab.notebook "wide"\nbook:chart{ x="i", y={ ${many} } }\n`, 81);
    assert.ok((await labels()).slice(0, 2).every((l) => l.outside.length === 0), JSON.stringify(await labels()));
  }));

test('Chart, OfAStudyIsErrorAgainstSeconds', () =>
  visit({}, async (page) => {
    await charted(page, 'local study = lab.work_precision{ try={} }\nstudy:chart "cost.svg"\n', 3);
    assert.equal(
      await on.text(page, '.charts .caption'),
      'error against seconds [ms]: 3 points, 2 lines, one per way. 1 row is left out: no number, or none above zero for a logarithmic axis.',
    );
    assert.deepEqual(await page.$$eval('.charts input[type=checkbox]', (boxes) => boxes.map((b) => b.checked)), [true, true]);
  }));

test('Chart, EachOfTheScriptCanBeChosen', () =>
  visit({}, async (page) => {
    const script =
      'local book = lab.notebook "big" -- mock.rows 9\nbook:chart{ x="i", y="v", title="First" }\n' +
      'book:chart{ x="i", y="level", where={ i={ 2, 3 } }, title="Second" }\n';
    await charted(page, script, 9);
    const [which] = await page.$$('.charts select');
    assert.deepEqual(await which.$$eval('option', (o) => o.map((e) => e.text)), ['First', 'Second']);
    assert.equal(await on.text(page, '#tab-chart .count'), '2');
    await which.select('big: Second');
    assert.match(await on.text(page, '.charts .caption'), /^level against i: 2 points/);
  }));

test('Chart, OfNamesAlongXWritesThemApart', () =>
  visit({}, async (page) => {
    const script = (n) => `local book = lab.notebook "shares" -- mock.names ${n}\nbook:chart{ x="part", y="share", one_line_per="rule" }\n`;
    for (const [width, height] of [
      [1920, 1080],
      [1280, 720],
      [960, 540],
    ]) {
      await page.setViewport({ width, height });
      for (const n of [2, 5, 60]) {
        await charted(page, script(n), 2 * n);
        await on.settled(page, () => page.$eval('.chart svg', (e) => e.outerHTML)); // redrawn for the new size
        const labels = await ticks(page, 'x');
        assert.ok(labels.length >= 2 && labels.length <= n, `${width}: ${labels.length} of ${n} names`);
        if (n <= 5) assert.equal(labels.length, n, `${width}: every one of ${n} names`);
        assert.match(labels[0].text, /^part 1/);
        labels.forEach((a, k) =>
          labels.slice(k + 1).forEach((b) =>
            assert.ok(a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top, `${width}: ${a.text} and ${b.text}`),
          ),
        );
        const chart = await on.placeOf(page, '.chart svg');
        const titled = await page.$$eval('.chart .text text', (all) =>
          all.map((e) => ({ text: e.textContent, top: e.getBoundingClientRect().top })).find((e) => e.text === 'part'),
        );
        labels.forEach((l) => assert.ok(l.left >= chart.x && l.bottom <= titled.top + 1, `${width}: ${JSON.stringify([l, titled, chart])}`));
        // Two dots per name, at one position.
        const across = await page.$$eval('.chart .dot circle, .chart .dot path', (all) => all.filter((c) => c.querySelector('title')).map((c) => c.getBoundingClientRect()).map((b) => b.left + b.width / 2));
        const places = across.sort((a, b) => a - b).filter((x, k) => k === 0 || x - across[k - 1] > 1);
        assert.equal(places.length, n);
        assert.equal((await page.$$('.chart .line path')).length, 0, 'no line goes from name to name');
      }
    }
    assert.match(await on.text(page, '.charts .caption'), /^share against part: 120 points, 2 lines, one per rule/);
    await page.click('.charts summary');
    const [logX] = await page.$$eval('.charts input[type=checkbox]', (boxes) => boxes.map((b) => b.disabled));
    assert.equal(logX, true, 'names have no logarithm');
    await on.assertAccessible(page, 'a chart of names');
  }));

test('Chart, IsTheScriptsOwnBeforeTheScriptWritesIt', () =>
  visit({}, async (page) => {
    await on.run(page, 'local book = lab.notebook "big" -- mock.rows 9\nwhile true do end\nbook:chart{ x="level", y="v" }\n');
    await on.openTab(page, 'chart');
    await on.until(
      page,
      () => document.querySelector('.charts .caption').textContent === 'v [µm] against level: 9 points.',
      'the check should foretell it',
    );
    await page.keyboard.press('Escape');
    await on.finished(page, 'Stopped');
  }));

for (const [width, height] of [
  [1280, 720],
  [960, 540],
])
  test(`Files, DrawingsAreAsLargeAsTheirLettersNeedAt${width}x${height}`, () =>
    visit({ width, height }, async (page) => {
      await on.run(page, '-- mock.file big-v-i.svg\n');
      await on.finished(page);
      await on.openTab(page, 'files');
      await on.until(page, () => [...document.querySelectorAll('.previews img.drawn')].some((i) => i.complete), 'it should come');
      const seen = await page.evaluate(() => ({
        letters: (16 / 960) * document.querySelector('.previews img.drawn').clientWidth, // gnuplot's
        pane: document.querySelector('#files').scrollWidth <= document.querySelector('#files').clientWidth,
        scrolls: getComputedStyle(document.querySelector('.previews figure')).overflowX,
      }));
      assert.ok(seen.letters >= 13, `letters of ${seen.letters} px`);
      assert.deepEqual([seen.pane, seen.scrolls], [true, 'auto'], 'the drawing scrolls, not the pane');
      await page.focus('.previews button');
      await page.keyboard.press('Enter');
      const whole = await on.placeOf(page, '.enlarged img');
      assert.ok(whole.x >= 0 && whole.x + whole.width <= width && whole.y + whole.height <= height);
      await page.keyboard.press('Escape');
      await on.until(page, () => !document.querySelector('.enlarged'), 'it should close');
      await on.assertAccessible(page, 'drawings among the files');
    }));

test('Table, OfARunThatIsOverBeginsWithItsFirstRow', () =>
  visit({}, async (page) => {
    const rows = async (script) => {
      await on.run(page, script);
      await on.finished(page);
    };
    const place = () => page.$eval('.scroll.table', (e) => [e.scrollTop, e.scrollHeight - e.clientHeight - e.scrollTop < 2]);
    const script = '-- mock.rows 90\n';
    for (const other of [script, `${script}-- another\n`]) {
      await on.openTab(page, 'output');
      await rows(other);
      await on.openTab(page, 'table');
      await page.waitForSelector('#table tbody tr');
      assert.deepEqual(await place(), [0, false], other);
      await page.$eval('.scroll.table', (e) => (e.scrollTop = 200));
      await on.openTab(page, 'output');
      await rows(other);
      await on.openTab(page, 'table');
      assert.deepEqual(await place(), [200, false], 'the same script again is looked at where it was');
    }
  }));

test('Table, LongNamesOfColumnsTakeLines', () =>
  visit({}, async (page) => {
    await on.run(page, '-- mock.wide 3 mock.columns name_of_a_column_that_somebody_made_of_a_whole_sentence_\n');
    await on.finished(page);
    await on.openTab(page, 'table');
    await page.waitForSelector('#table tbody tr');
    const widths = await page.$$eval('#table thead th', (all) => all.map((th) => th.getBoundingClientRect().width));
    assert.equal(widths.length, 5);
    assert.ok(widths.every((w) => w < 300), widths.join());
  }));

test('Results, WhatWasMadeIsShownUnlessATabWasChosen', () =>
  visit({}, async (page) => {
    const selected = () => page.$eval('#tabs [aria-selected=true]', (e) => e.id);
    const ran = async (script) => {
      await on.run(page, script);
      await on.finished(page, 'Done|Failed');
      return selected();
    };
    const made = book(9, 'x="v", y="i"');
    assert.equal(await ran('print "a"\n'), 'tab-output');
    assert.equal(await ran(`${made}print "beside a chart"\n`), 'tab-chart');
    assert.match(await on.focused(page), /^Script in Lua/, 'the focus stays where it was');
    assert.equal(await ran('-- mock.file map.png\n'), 'tab-files');
    assert.equal(await ran('-- mock.views 2\n'), 'tab-picture');
    assert.equal(await ran('-- mock.views 2\nprint "a"\n'), 'tab-output');
    await ran('-- mock.knob p 1 9 3 one\nprint "a"\n');
    await on.until(page, () => document.querySelector('#tab-picture').ariaSelected === 'true', 'a picture follows a slider');
    assert.equal(await ran(`${made}error "at the end"\n`), 'tab-output');
    assert.equal(await ran(made), 'tab-chart');
    assert.equal(await ran(`${made}os.exit(3)\n`), 'tab-output');
    assert.match(await on.text(page, '#output .end'), /^Failed after 100 ms: os\.exit\(3\)\.$/);
    await on.openTab(page, 'table');
    assert.equal(await ran(made), 'tab-table');
    await page.click('.lessons button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    assert.equal(await ran(made), 'tab-chart');
    await page.focus('#tab-chart');
    await page.keyboard.press('ArrowLeft');
    assert.equal(await ran(`${made}\n`), 'tab-table');
  }));

test('Axis, LabelsOfTicksStandApart', () =>
  visit({}, async (page) => {
    for (const [width, height] of [
      [1920, 1080],
      [1280, 577],
      [960, 540],
      [800, 600],
    ]) {
      await page.setViewport({ width, height });
      for (const [rows, logs] of [
        [3, 'log_x=true'],
        [9, ''],
        [300, 'log_x=true, log_y=true'],
        [5000, ''],
      ]) {
        await charted(page, book(rows, `x="i", y="v", ${logs}`), rows);
        for (const axis of ['x', 'y']) {
          const labels = await ticks(page, axis);
          assert.ok(labels.length >= 2, `${axis} of ${rows} rows: ${labels.map((l) => l.text)}`);
          assert.equal(new Set(labels.map((l) => l.text)).size, labels.length, 'each tick has its own label');
          labels.forEach((a, k) =>
            labels.slice(k + 1).forEach((b) =>
              assert.ok(
                a.right + 4 < b.left || b.right + 4 < a.left || a.bottom <= b.top || b.bottom <= a.top,
                `${width}: ${a.text} and ${b.text}`,
              ),
            ),
          );
        }
      }
    }
  }));

test('Axis, OfWholeNumbersHasWholeTicks', () =>
  visit({}, async (page) => {
    for (const rows of [2, 3, 5]) {
      await charted(page, book(rows, 'x="i", y="v"'), rows);
      const labels = (await ticks(page, 'x')).map((l) => l.text);
      assert.ok(labels.every((t) => /^\d+$/.test(t)), labels.join(' '));
    }
  }));

test('Axis, LogarithmicEndsWhereItsDataEndAndWritesAllTicksInOneWay', () =>
  visit({}, async (page) => {
    await charted(page, book(300, 'x="i", y="v", log_x=true'), 300);
    const labels = (await ticks(page, 'x')).map((l) => l.text);
    assert.ok(labels.includes('100') && !labels.includes('1000'), labels.join(' '));
    const { last, right } = await page.evaluate(() => ({
      last: Math.max(...[...document.querySelectorAll('.chart .line path, .chart .dot')].map((e) => e.getBoundingClientRect().right)),
      right: document.querySelector('.chart svg').getBoundingClientRect().right,
    }));
    assert.ok(right - last < 60, `the data end ${right - last} px before the chart does`);
    await charted(page, book(300, 'x="v", y="i", log_x=true, log_y=true'), 300);
    for (const axis of ['x', 'y']) {
      const powers = (await ticks(page, axis)).filter((l) => l.text.includes('10') && /[⁰¹²³⁴-⁹⁻]/.test(l.text)).length;
      assert.ok(powers === 0 || powers === (await ticks(page, axis)).length, 'powers of ten, or none');
    }
  }));

test('Results, OfAnotherScriptAreNamedAndGreyed', () =>
  visit({}, async (page) => {
    assert.equal(await on.text(page, '#results-of'), 'No run yet');
    await page.click('.lessons button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    await on.run(page, 'print "of the first"\n');
    await on.finished(page);
    const whose = () => on.text(page, '#results-of');
    assert.match(await whose(), /^What roughness is, and what a stylus misses · run \d+ · \d\d:\d\d$/);
    const grey = () => page.$eval('#output', (e) => getComputedStyle(e).filter);
    assert.equal(await grey(), 'none');
    await page.click('.back');
    await page.waitForSelector('.lessons li:nth-child(2) button');
    await page.click('.lessons li:nth-child(2) button');
    await on.until(page, () => /not of the open script/.test(document.querySelector('#results-of').textContent), 'it should say so');
    assert.match(await whose(), /^What roughness is.* · not of the open script$/);
    assert.equal(await grey(), 'grayscale(1)');
    await on.assertAccessible(page, 'results of another script');
    const before = await whose();
    await page.reload();
    await on.until(page, () => /run \d/.test(document.querySelector('#results-of').textContent), 'they should be back');
    await on.until(page, (b) => document.querySelector('#results-of').textContent === b, 'as before', before);
    await on.run(page, 'print "of the second"\n');
    await on.until(page, () => /^Fractal/.test(document.querySelector('#results-of').textContent), 'its own results');
    assert.equal(await grey(), 'none');
  }));

test('Window, ChartAndPictureFillMostOfTheirPaneAt1280x720', () =>
  visit({}, async (page) => {
    await on.run(page, book(9, 'x="v", y="i"') + '-- mock.knob pressure 1 9 3 one\n-- mock.views 3\n');
    await on.finished(page);
    const share = (selector) =>
      page.$eval(selector, (e) => {
        const { clientWidth: width, clientHeight: height } = document.querySelector('#results');
        return (e.clientWidth * e.clientHeight) / (width * height);
      });
    await page.waitForSelector('.chart svg');
    assert.equal(await page.$eval('.knobs', (e) => e.hidden), false);
    assert.ok((await share('.chart')) >= 0.6, `the chart fills ${await share('.chart')}`);
    await on.openTab(page, 'picture');
    await on.until(page, () => document.querySelector('.key svg'), 'the picture should come');
    await on.painted(page);
    assert.ok((await share('.stage')) >= 0.6, `the picture fills ${await share('.stage')}`);
    await on.assertAccessible(page, 'with its controls folded');
    await page.focus('.pictures summary');
    await page.keyboard.press('Enter');
    await on.painted(page);
    const outside = await page.$$eval('.pictures button, .pictures select', (all) =>
      all.filter((e) => e.getBoundingClientRect().bottom > innerHeight).map((e) => e.textContent),
    );
    assert.deepEqual(outside, []);
    await on.assertAccessible(page, 'with its controls unfolded');
  }));

for (const [width, height, columns] of [
  [1280, 720, 5],
  [1151, 700, 5],
  [1150, 700, 1],
  [960, 540, 1],
  [800, 600, 1],
])
  test(`Window, AChartIsLegibleAt${width}x${height}`, () =>
    visit({ width, height }, async (page) => {
      await charted(page, book(9, 'x="v", y={ "level", "i" }'), 18);
      const seen = await page.evaluate(() => ({
        columns: getComputedStyle(document.querySelector('.panes')).gridTemplateColumns.split(' ').length,
        high: document.querySelector('.chart svg').getBoundingClientRect().height,
        em: parseFloat(getComputedStyle(document.querySelector('.chart')).fontSize),
        tabs: new Set([...document.querySelectorAll('#tabs button')].map((t) => t.getBoundingClientRect().top)).size,
        wide: document.scrollingElement.scrollWidth > innerWidth,
        beside: document.querySelector('.chart svg').getBoundingClientRect().right <= innerWidth,
      }));
      assert.equal(seen.columns, columns);
      assert.ok(seen.high >= 16 * seen.em, `the chart is ${seen.high} px high`);
      assert.deepEqual([seen.tabs, seen.wide, seen.beside], [1, false, true]);
      await on.assertAccessible(page, `${width} x ${height}`);
    }));

// The end of a run and messages are visible at any scroll position.
for (const [width, height] of [
  [1280, 720],
  [960, 540],
  [390, 844],
])
  test(`Window, StatusAndBannerAreReadAt${width}x${height}`, () =>
    visit({ width, height }, async (page) => {
      await page.click('.lessons button');
      await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
      await charted(page, 'local book -- mock.rows 1200 mock.file ' + 'long_'.repeat(40) + '.svg\nfor N = 1, 8 do end\n', 1200);
      await on.openTab(page, 'files');
      await on.until(page, () => document.querySelector('.previews figcaption'), 'the drawing should come');
      const seen = await page.evaluate(() => {
        const inside = (e) => {
          const { left, right } = e.getBoundingClientRect();
          return left >= 0 && right <= innerWidth;
        };
        const status = document.querySelector('#status');
        return {
          status: status.scrollWidth <= status.clientWidth && inside(status),
          wide: document.scrollingElement.scrollWidth,
          tabs: [...document.querySelectorAll('#tabs button')].every(inside),
          names: [...document.querySelectorAll('.previews figcaption')].every(inside),
        };
      });
      assert.deepEqual(seen, { status: true, wide: width, tabs: true, names: true });
      await on.run(page, 'while true do end\n');
      await on.until(page, () => document.querySelector('#status').textContent.startsWith('Running'), 'it should run');
      for (const fill of [false, true]) {
        if (fill) await page.$eval('#fill', (e) => e.click());
        else await page.evaluate(() => scrollTo(0, document.scrollingElement.scrollHeight));
        await on.chord(page, 'Control', 'Enter');
        await on.until(page, () => !document.querySelector('#banner').hidden, 'it should say that a script runs');
        const found = await page.evaluate(() => {
          const { left, top, right, bottom } = document.querySelector('#banner').getBoundingClientRect();
          return document.elementFromPoint((left + right) / 2, (top + bottom) / 2)?.closest('#banner')?.id;
        });
        assert.equal(found, 'banner', fill ? 'over results that fill the window' : 'at the end of the page');
        await page.$eval('#banner button', (e) => e.click());
      }
      if (width === 390) {
        const { height: bar } = await on.placeOf(page, '.bar');
        assert.ok(bar < 150, `the bar takes ${bar} px`);
        assert.deepEqual(await page.$$eval('.bar kbd, .tip', (all) => all.filter((e) => e.checkVisibility()).length), 0);
      }
      if (width === 960) {
        const { top } = await page.$eval('#stop', (e) => e.getBoundingClientRect().toJSON());
        assert.ok(top >= 0 && top < 100, `Stop is at ${top} px`);
      }
      await page.keyboard.press('Escape');
      await page.keyboard.press('Escape');
      await on.finished(page, 'Stopped');
    }));

test('Results, FillTheWindowByKeysAndGoBack', () =>
  visit({ width: 960, height: 540 }, async (page) => {
    await charted(page, 'for N = 1, 8 do end\n', 16);
    await page.focus('#fill');
    await page.keyboard.press('Enter');
    const box = await on.placeOf(page, '#results');
    assert.deepEqual([box.x, box.y, box.width, box.height], [0, 0, 960, 540]);
    await on.painted(page);
    const chart = await on.placeOf(page, '.chart svg');
    assert.ok(chart.height > 320 && chart.width > 880, `${chart.width} x ${chart.height}`);
    assert.equal(await page.$eval('#fill', (e) => e.getAttribute('aria-pressed')), 'true');
    for (let k = 0; k < 12; ++k) {
      await page.keyboard.press('Tab');
      assert.ok(await page.evaluate(() => document.activeElement === document.body || document.activeElement.closest('#results')));
    }
    await on.assertAccessible(page, 'filling the window');
    await on.openTab(page, 'picture');
    await on.until(page, () => document.querySelector('.key svg'), 'the picture should come');
    await on.painted(page);
    assert.ok((await on.placeOf(page, '.stage')).height > 230);
    await page.keyboard.press('Escape');
    assert.equal(await page.$eval('#results', (e) => e.classList.contains('filling')), false);
    await page.focus('#run');
    assert.equal(await on.focused(page), 'run');
  }));

test('Colours, AreThoseOfPictures', () => {
  const page = readFileSync(new URL('bindings/web/page/src/colour.ts', root), 'utf8');
  const engine = readFileSync(new URL('engine/plot/palette.cpp', root), 'utf8');
  const hex = (text) => text.match(/0x[0-9a-f]{6}/g);
  for (const name of ['viridis', 'cividis', 'heat', 'contact']) {
    const [, mine] = new RegExp(`${name}: \\{\\s*colours: \\[([^\\]]*)\\]`).exec(page);
    const [, theirs] = new RegExp(`unsigned ${name}\\[\\] = \\{([^}]*)\\}`).exec(engine);
    assert.deepEqual(hex(mine), hex(theirs), name);
  }
  assert.equal(/none: (0x\w+)/.exec(page)[1], /unsigned nothing = (0x\w+)/.exec(engine)[1]);
  const [, fields] = /palette_of_field\(std::string_view field\) \{([^}]*)\}/.exec(engine);
  const of = Object.fromEntries(
    [...fields.matchAll(/((?:field == "\w+"(?: \|\| )?)+)\)? ?(?:\? |return )"(\w+)"/g)].flatMap(([, names, palette]) =>
      names.match(/"(\w+)"/g).map((n) => [n.slice(1, -1), palette]),
    ),
  );
  const [, given] = /ofField[^{]*= \{([^}]*)\}/.exec(page);
  assert.deepEqual(Object.fromEntries([...given.matchAll(/(\w+): '(\w+)'/g)].map(([, f, p]) => [f, p])), of);
});

test('Prediction, IsANumberOfTheScriptAndIsJudged', () =>
  visit({}, async (page) => {
    await page.click('.lessons button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    assert.deepEqual(await page.$$eval('.guesses label', (l) => l.map((e) => e.textContent)), ['Ra', 'slope']);
    assert.match(await on.text(page, '.prediction'), /shares between 0 and 1/);
    const [ra, slope] = await page.$$('.guesses input');
    await ra.type('0.5');
    assert.match(await on.editorText(page), /^local my_guess = \{ Ra=0\.5, slope=nil \} -- shares between 0 and 1$/m);
    await slope.type('-1e-2');
    assert.match(await on.editorText(page), /\{ Ra=0\.5, slope=-0\.01 \}/);
    for (let k = 0; k < 5; ++k) await page.keyboard.press('Backspace');
    assert.match(await on.editorText(page), /\{ Ra=0\.5, slope=nil \}/);
    // The prediction is the script's number, also after a reload.
    await page.reload();
    await on.until(page, () => document.querySelector('.guesses input')?.value === '0.5', 'the number should be kept');
    const verdict = 'You said 0.5 of the share of Ra: it is 0.96, 1.9 times too little.';
    const reason = 'Why: the ball follows the long waves.';
    await on.run(page, `local my_guess = { Ra=0.7, slope=nil }\nprint "before"\nprint "${verdict}"\nprint "${reason}"\n`);
    assert.equal(await page.$eval('.guesses input', (e) => e.value), '0.7');
    await on.finished(page);
    await on.until(page, () => !document.querySelector('.judged').hidden, 'it should be judged');
    assert.deepEqual(await page.$$eval('.judged p', (all) => all.map((p) => p.textContent)), [verdict, reason]);
    const { bar, grey } = await page.$eval('.judged', (e) => ({
      bar: getComputedStyle(e).borderLeftColor,
      grey: getComputedStyle(document.querySelector('.hint')).color,
    }));
    assert.equal(bar, grey, 'the verdict is neither good nor bad');
    const judged = await on.placeOf(page, '.judged');
    assert.ok(judged.y + judged.height < 720, 'it is seen without scrolling');
    await on.assertAccessible(page, 'a prediction that is judged');
    await on.write(page, 'print "no guess"\n');
    assert.equal(await page.$eval('.guesses input', (e) => e.disabled), true);
    assert.match(await on.text(page, '.prediction'), /has no my_guess any more/);
    await page.click('#reset');
    assert.deepEqual(await page.$$eval('.guesses input', (all) => all.map((e) => [e.value, e.disabled])), [
      ['', false],
      ['', false],
    ]);
  }));

test('Prediction, TakesCommaAndPointAndSaysWhatItUnderstood', () =>
  visit({}, async (page) => {
    await page.click('.lessons button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    await on.write(page, 'local my_guess = { Ra=nil, slope=nil }\n');
    const input = await page.$('.guesses input');
    for (const [typed, understood, script] of [
      ['0,25', 'understood: 0.25', '0.25'],
      ['0.25', 'understood: 0.25', '0.25'],
      ['−,5', 'understood: -0.5', '-0.5'],
      ['1.000,5', '“1.000,5” is not a number', 'nil'],
      ['half', '“half” is not a number', 'nil'],
      ['10 %', '“10 %” is not a number', 'nil'],
    ]) {
      await input.click({ count: 3 });
      await page.keyboard.press('Backspace');
      await page.keyboard.type(typed);
      assert.equal(await on.text(page, '.guesses output'), understood, typed);
      assert.match(await on.editorText(page), new RegExp(`\\{ Ra=${script}, slope=nil \\}`), typed);
    }
    await input.click({ count: 3 });
    await page.keyboard.type('0.5');
    await input.hover();
    await page.mouse.wheel({ deltaY: 100 });
    await on.painted(page);
    assert.match(await on.editorText(page), /Ra=0\.5,/, 'a wheel changes nothing');
    await page.keyboard.press('ArrowDown');
    assert.match(await on.editorText(page), /Ra=0\.5,/, 'nor does an arrow');
    await on.assertAccessible(page, 'a number that was understood');
  }));

test('Prediction, OfAChoiceIsChosenByKeys', () =>
  visit({}, async (page) => {
    await page.click('.lessons li:nth-child(3) button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    assert.deepEqual(await page.$$eval('.guesses legend', (all) => all.map((e) => e.textContent)), ['depth', 'spots']);
    assert.deepEqual(await page.$$eval('.guesses fieldset:first-child label', (l) => l.map((e) => e.textContent)), ['less', 'equal', 'more']);
    await page.focus('.guesses input');
    await page.keyboard.press('Space');
    assert.match(await on.editorText(page), /^local my_guess = \{ depth="less", spots=nil \} -- than 0\.2 um$/m);
    await page.keyboard.press('ArrowDown');
    assert.match(await on.editorText(page), /depth="equal", spots=nil/);
    await page.reload();
    const chosen = () => page.$$eval('.guesses input', (all) => all.flatMap((e) => (e.checked ? [`${e.name} ${e.value}`] : [])));
    await on.until(page, () => document.querySelector('.guesses input:checked'), 'the choice should be kept');
    assert.deepEqual(await chosen(), ['guess-depth equal']);
    await on.write(page, 'local my_guess = { depth=nil, spots="more" }\nguess.choices(my_guess, "less", "equal", "more")\n');
    assert.deepEqual(await chosen(), ['guess-spots more'], 'the script decides');
    await on.assertFits(page, 'choices');
    await on.assertAccessible(page, 'choices');
  }));

test('Prediction, IsAskedForOnceBeforeARunWithout', () =>
  visit({}, async (page) => {
    await page.click('.lessons button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    const asks = () => page.$eval('#banner', (e) => !e.hidden && e.textContent.startsWith('Run without a prediction?'));
    await (await page.$('>>> .cm-content')).focus();
    await on.chord(page, 'Control', 'Enter');
    assert.equal(await asks(), true);
    assert.equal(await on.text(page, '#results-of'), 'No run yet');
    await on.assertAccessible(page, 'the question');
    await page.keyboard.press('Enter'); // Predict first
    assert.equal(await asks(), false);
    assert.equal(await page.evaluate(() => document.activeElement === document.querySelector('.guesses input')), true);
    await on.chord(page, 'Control', 'Enter');
    assert.equal(await asks(), false, 'once');
    await on.finished(page);
    await page.reload();
    await on.until(page, () => document.querySelector('.guesses input'), 'the lesson should be open again');
    await (await page.$('>>> .cm-content')).focus();
    await on.chord(page, 'Control', 'Enter');
    assert.equal(await asks(), true);
    await page.keyboard.press('Tab');
    await page.keyboard.press('Enter'); // Run anyway
    await on.finished(page);
    assert.match(await on.focused(page), /^Script in Lua/, 'the focus goes back');
    // No question with a prediction, or where none is asked for.
    await page.reload();
    await on.until(page, () => document.querySelector('.guesses input'), 'the lesson should be open again');
    await page.type('.guesses input', '0,5');
    await page.click('#run');
    assert.equal(await asks(), false);
    await on.finished(page);
    await page.click('.back');
    await page.waitForSelector('.lessons li:nth-child(2) button');
    await page.click('.lessons li:nth-child(2) button');
    await on.until(page, () => /Fractal/.test(document.querySelector('#lessons h2').textContent), 'the second should open');
    await page.click('#run');
    assert.equal(await asks(), false);
    await on.finished(page);
  }));

test('Prediction, TypedBesideTheScriptLeavesItWhereItIs', () =>
  visit({}, async (page) => {
    await page.click('.lessons button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    const lines = (n) => '-- a line\n'.repeat(n);
    await on.write(page, `${lines(60)}local my_guess = { Ra=nil, slope=nil } -- shares\n${lines(60)}`);
    const scrolled = (to) =>
      page.evaluate((top) => {
        const e = document.querySelector('#editor').shadowRoot.querySelector('.cm-scroller');
        if (top !== null) e.scrollTop = top;
        return e.scrollTop;
      }, to);
    // The editor scrolls to the end first.
    await on.comesTrue(async () => (await scrolled(null)) >= 1300, 'the end should be shown');
    await on.settled(page, () => scrolled(null));
    await scrolled(1200);
    const seen = (words) =>
      on.until(
        page,
        (text) => {
          const root = document.querySelector('#editor').shadowRoot;
          const around = root.querySelector('.cm-scroller').getBoundingClientRect();
          const line = [...root.querySelectorAll('.cm-line')].find((l) => l.textContent.includes(text))?.getBoundingClientRect();
          return line && line.top >= around.top && line.bottom <= around.bottom;
        },
        `it should be in sight: ${words}`,
        words,
      );
    await seen('Ra=nil');
    await page.type('.guesses input', '0.25');
    await on.painted(page);
    await seen('Ra=0.25');
    const kept = await page.evaluate(() => localStorage.getItem('asperity.script.lesson.01_roughness'));
    assert.match(kept, /^local my_guess = \{ Ra=0\.25, slope=nil \} -- shares$/m);
  }));

test('Lesson, OfATeacherHidesItsCodeAndHasNotes', () =>
  visit({}, async (page) => {
    assert.deepEqual(await page.$$eval('.lessons .broken', (all) => all.map((e) => e.textContent)), [
      '02_broken.lua 02_broken.lua:7: end expected',
    ]);
    assert.equal(await page.$eval('.lessons li:nth-child(4) strong', (e) => getComputedStyle(e, '::before').content), '"1  "');
    const hidden = () => page.evaluate(() => ['#script', '#results-divider'].map((s) => document.querySelector(s).hidden));
    await page.click('.lessons li:nth-child(4) button');
    await on.until(page, () => document.querySelector('.notes'), 'the lesson should open');
    assert.deepEqual(await hidden(), [true, true]);
    assert.equal(await page.$eval('.notes', (e) => e.open), false, 'a class does not read the notes on the wall');
    assert.equal(await page.$eval('.notes em', (e) => e.textContent), 'why');
    const results = await on.placeOf(page, '#results');
    assert.ok(results.width > 900, `the results have ${results.width} px`);
    await page.click('#run');
    await on.finished(page);
    assert.equal(await on.text(page, '.output'), 'a spring\n');
    await on.assertAccessible(page, 'a lesson without its code');
    await on.assertFits(page, 'a lesson without its code');
    // The choice is stored by script.
    await page.click('#script-button');
    assert.deepEqual(await hidden(), [false, false]);
    assert.match(await on.editorText(page), /a spring/);
    await page.click('.back');
    await page.waitForSelector('.own');
    await page.click('.own');
    assert.deepEqual(await hidden(), [false, false]);
    await page.click('#script-button');
    assert.equal(await page.$eval('#script-button', (e) => e.getAttribute('aria-expanded')), 'false');
    await page.reload();
    await on.until(page, () => document.querySelector('.lessons li'), 'the list should be there');
    assert.deepEqual(await hidden(), [true, true]);
    await page.click('.lessons li:nth-child(4) button');
    await on.until(page, () => document.querySelector('.notes'), 'the lesson should open again');
    assert.deepEqual(await hidden(), [false, false]);
  }));

test('Language, IsChosenTextByText', () =>
  visit({}, async (page) => {
    const [choice] = await page.$$('#lessons .choice select');
    assert.deepEqual(await choice.$$eval('option', (all) => all.map((o) => o.text)), ['English', 'Deutsch']);
    await choice.select('de');
    await on.until(page, () => document.querySelector('.lessons strong')?.textContent === 'Was Rauheit ist', 'it should be German');
    assert.deepEqual(await page.$$eval('.lessons li:first-child [lang]', (all) => all.map((e) => e.lang)), ['de', 'en']);
    await page.click('.lessons button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    assert.deepEqual(await page.$$eval('.called', (all) => all.map((e) => [e.lang, e.firstChild.textContent])), [
      ['en', 'Question'],
      ['de', 'Vorhersage'],
    ]);
    assert.deepEqual(await page.$$eval('.guesses label', (l) => l.map((e) => e.textContent)), ['Ra', 'Steigung']);
    await on.assertAccessible(page, 'a lesson in German');
    const judgedAs = async (lines, german) => {
      await on.run(page, lines.map((line) => `print "${line}"\n`).join(''));
      await on.finished(page);
      await on.until(
        page,
        (texts) => JSON.stringify([...document.querySelectorAll('.judged p')].map((p) => p.textContent)) === texts,
        `it should be ${german}`,
        JSON.stringify(german),
      );
    };
    await judgedAs(
      ['You said 0.5 % of the share of Ra: it is 0.96 %, 1.9 times too little.', 'Why: the depth is 0.25, not 3 %.', '', 'Second.'],
      ['Anteil von Ra: Du sagtest 0,5 %, es ist 0,96 %, 1,9-mal zu wenig.', 'Warum: Die Tiefe ist 3 und nicht 0,25.', 'Zweiter Absatz.'],
    );
    // A changed reason is not translated.
    await judgedAs(
      ['You said 0.5 of Sq: it is 0.5, which is near.', "You said 'less' of the share of Ra: it is 'more'. It is not."].map((t) => t.replaceAll("'", '\"')),
      ['Sq: Du sagtest 0,5, es ist 0,5, nah daran.', 'Anteil von Ra: Du sagtest „less“, es ist „mehr“. Nein.'],
    );
    await page.reload();
    await on.until(page, () => document.querySelector('.called[lang=de]'), 'the choice should be kept');
    await (await page.$('#lessons .choice select')).select('en');
    await on.until(page, () => !document.querySelector('.called[lang=de]'), 'and changed');
    await page.click('.back');
    await page.waitForSelector('.lessons li:nth-child(2) button');
    await page.click('.lessons li:nth-child(2) button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson without German should open');
    assert.equal(await page.$eval('#lessons .choice', (e) => e.hidden), true);
  }));

test('Room, TheTeacherHandsOutAScriptAndReadsAStudents', async () => {
  const server = await startMock(on.pageFolder, { room: 'teacher' });
  try {
    await visit(
      {},
      async (page) => {
        await on.until(page, () => !document.querySelector('#hand').hidden, 'there is a room');
        await on.write(page, 'print "for all"\n');
        await page.click('#hand');
        await on.until(page, () => document.querySelector('#hand').textContent === 'Handed out', 'it should be handed out');
        await on.write(page, 'print "next"\n');
        assert.equal(await on.text(page, '#hand'), 'Hand out');
        const asked = await fetch(`${server.url.split('#')[0]}api/handed`, { headers: { Authorization: 'Bearer testtoken' } });
        assert.deepEqual(await asked.json(), { number: 1, name: 'Your own script', script: 'print "for all"\n' });
        await page.click('#room-button');
        await on.until(page, () => document.querySelector('#room-people button'), 'a script was sent');
        assert.equal(await on.text(page, '#room-handed'), 'Handed out: Your own scriptTake it back');
        await page.click('#room-people button');
        await on.until(page, () => document.querySelector('#room-script pre'), 'it should be shown');
        assert.equal(await on.text(page, '#room-script pre'), 'local mu = "mine"\n');
        await on.assertAccessible(page, 'the script of a student');
        await page.click('#room-handed button');
        await on.until(page, () => /No script/.test(document.querySelector('#room-handed').textContent), 'it is taken back');
        await page.click('#room-script button');
        assert.equal(await on.text(page, '#script-title'), 'Tilt it of Émilie');
        assert.equal(await on.editorText(page), 'local mu = "mine"\n');
      },
      server,
    );
  } finally {
    await server.close();
  }
});

test('Room, AStudentIsOfferedTheTeachersScript', async () => {
  const server = await startMock(on.pageFolder, { room: 'student' });
  const hand = (body) =>
    fetch(`${server.url.split('#')[0]}api/handed`, { method: 'POST', headers: { Authorization: 'Bearer testtoken' }, body: JSON.stringify(body) });
  try {
    await visit(
      {},
      async (page) => {
        await on.write(page, 'print "mine"\n');
        await hand({ name: 'Springs', script: 'print "for all"\n' });
        await on.until(page, () => !document.querySelector('#offer').hidden, 'it should be offered');
        assert.match(await on.text(page, '#offer'), /^Your teacher sent Springs\./);
        assert.equal(await on.editorText(page), 'print "mine"\n', 'the text stays');
        await on.assertAccessible(page, 'an offered script');
        await on.assertFits(page, 'an offered script');
        await page.click('#offer .primary');
        assert.equal(await on.editorText(page), 'print "for all"\n');
        assert.equal(await page.$eval('#offer', (e) => e.hidden), true);
        await on.write(page, 'print "changed"\n');
        await page.waitForSelector('.own');
        await page.click('.own');
        assert.equal(await on.editorText(page), 'print "mine"\n');
        await page.reload();
        await on.until(page, () => document.querySelectorAll('.own:not([hidden])').length === 2, 'it should be listed');
        assert.equal(await page.$eval('#offer', (e) => e.hidden), true, 'but not offered again');
        await page.click('.own + .own');
        assert.equal(await on.editorText(page), 'print "changed"\n');
        await hand({});
        await on.until(page, () => document.querySelectorAll('.own:not([hidden])').length === 1, 'it is taken back');
      },
      server,
    );
  } finally {
    await server.close();
  }
});

test('Room, TheTeacherSeesRunsAndWhoAsksForHelp', async () => {
  const server = await startMock(on.pageFolder, { room: 'teacher' });
  try {
    await visit(
      { width: 960, height: 540 },
      async (page) => {
        await on.until(page, () => !document.querySelector('#room-button').hidden, 'the room should be offered');
        assert.equal(await page.$eval('#help-button', (e) => e.hidden), true);
        await page.focus('#room-button');
        await page.keyboard.press('Enter');
        await on.until(page, () => document.querySelector('#room-people tbody tr'), 'the students should come');
        assert.deepEqual(await page.$$eval('#room-people tbody tr', (rows) => rows.map((r) => r.innerText.split('\t').map((t) => t.trim()))), [
          ['Émilie', '02_dimension, running', 'asks for help Show script'],
          ['Ada', '01_roughness, done', ''],
        ]);
        assert.match(await on.text(page, '#room-runs'), /^Émilie: 02_dimension, runningStop$/);
        await on.assertAccessible(page, 'the room');
        await page.keyboard.press('Escape');
        assert.equal(await page.$eval('#room', (e) => e.open), false);
      },
      server,
    );
  } finally {
    await server.close();
  }
});

test('Wall, ShowsPredictionsWithoutNamesAndTheAnswerAtLast', async () => {
  const server = await startMock(on.pageFolder, { room: 'teacher' });
  try {
    await visit(
      {},
      async (page) => {
        const caption = () => on.text(page, '#wall .caption');
        const captioned = (words) =>
          on.until(page, (w) => document.querySelector('#wall .caption').textContent.includes(w), `it should say ${words}`, words);
        const choose = async (question, words) => {
          await (await page.$('#wall select')).select(question);
          await captioned(words);
        };
        await on.until(page, () => !document.querySelector('#wall-button').hidden, 'it should be offered');
        await page.focus('#wall-button');
        await page.keyboard.press('Enter');
        await captioned('2 predictions');
        assert.equal(await caption(), '2 predictions from 0.5 to 0.9, half of them up to 0.5.');
        const box = await on.placeOf(page, '#wall');
        assert.deepEqual([box.width, box.height], [1280, 720]);
        assert.equal((await page.$$('#wall svg .rect rect')).length, 2);
        await choose('01_roughness: slope', '1 prediction from 0.1');
        await choose('03_boxes: depth', 'less 0, equal 2, more 0');
        const shown = await on.text(page, '#wall');
        assert.doesNotMatch(shown, /Ada|Émilie|answer:|✓/, 'no names, no answer');
        await page.click('#wall summary');
        assert.deepEqual(await page.$$eval('#wall li', (all) => all.map((e) => e.textContent)), ['springs <b>do not</b> know']);
        await on.assertAccessible(page, 'the wall');
        await page.click('#wall button[aria-pressed]');
        await captioned('the answer is more');
        assert.match(await on.text(page, '#wall svg'), /The answer: more/);
        await choose('01_roughness: Ra', '2 predictions from');
        assert.doesNotMatch(await caption(), /answer/, 'each question has its own answer');
        await page.keyboard.press('Escape');
        assert.equal(await page.$eval('#wall', (e) => e.open), false);
      },
      server,
    );
  } finally {
    await server.close();
  }
});

test('Wall, AnOutlierIsBeyondTheBins', async () => {
  const server = await startMock(on.pageFolder, { room: 'teacher', crowd: true });
  try {
    await visit(
      {},
      async (page) => {
        await on.until(page, () => !document.querySelector('#wall-button').hidden, 'it should be offered');
        await page.click('#wall-button');
        await on.until(page, () => document.querySelector('#wall svg'), 'the histogram should come');
        const caption = () => on.text(page, '#wall .caption');
        assert.equal(await caption(), '25 predictions from 20 to 44 and 1 beyond, half of them up to 33.');
        assert.ok((await page.$$('#wall svg .rect rect')).length > 4, 'the others are apart');
        await page.click('#wall button[aria-pressed]');
        await on.until(page, () => /answer/.test(document.querySelector('#wall .caption').textContent), 'the answer should come');
        assert.match(await caption(), /and 1 beyond.*; the answer is 47\.$/);
        await page.click('#wall button[aria-pressed]');
        await on.until(page, () => !/answer/.test(document.querySelector('#wall .caption').textContent), 'and go');
      },
      server,
    );
  } finally {
    await server.close();
  }
});

test('Room, AStudentPredictsAndAsksForHelp', async () => {
  const server = await startMock(on.pageFolder, { room: 'student' });
  try {
    await visit(
      {},
      async (page) => {
        await on.until(page, () => !document.querySelector('#help-button').hidden, 'there is somebody to ask');
        assert.equal(await page.$eval('#documents', (e) => e.hidden), false);
        const own = await on.editorText(page); // the lines in view
        await page.click('#help-button');
        await on.until(page, () => document.querySelector('#help-button').ariaPressed === 'true', 'it should be asked');
        await page.click('.lessons button');
        await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
        await on.hold(page);
        await page.type('.guesses input', '0,25');
        await page.type('.prediction textarea', 'it is a ball');
        await on.release(page);
        await on.comesTrue(() => server.told.length === 2, 'the prediction should be told');
        await page.click('#help-button');
        await on.until(page, () => document.querySelector('#help-button').ariaPressed === 'false', 'and taken back');
        const sent = server.told[0].script;
        assert.ok(own.length > 100 && sent.startsWith(own), sent);
        assert.deepEqual(server.told, [
          { what: 'help', wanted: true, name: 'Your own script', script: sent },
          { what: 'predictions', lesson: '01_roughness', guesses: { Ra: 0.25 }, why: 'it is a ball' },
          { what: 'help', wanted: false },
        ]);
        await on.assertFits(page, 'a student of a room');
        await on.assertAccessible(page, 'a student of a room');
      },
      server,
    );
  } finally {
    await server.close();
  }
});
