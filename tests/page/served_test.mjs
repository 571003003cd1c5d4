// SPDX-License-Identifier: GPL-3.0-or-later
// The page served by the program, in Chromium.

import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test as register } from 'node:test';
import * as on from './browser.mjs';

const program = process.env.ASPERITY_PROGRAM;
const serves = spawnSync(program, ['serve', '--help']).status === 0;
const test = (name, act) => register(name, { skip: serves ? false : 'this program has no `asperity serve`' }, act);

let browser, server, url, folder;
before(async () => {
  if (!serves) return;
  folder = mkdtempSync(join(tmpdir(), 'asperity-served-'));
  server = spawn(program, ['serve', '--out', join(folder, 'runs'), '--limit-time', '1h']);
  url = await new Promise((resolve, reject) => {
    let said = '';
    const hear = (data) => {
      said += data;
      const found = /http:\/\/\S+#\S+/.exec(said);
      if (found) resolve(found[0]);
    };
    server.stdout.on('data', hear);
    server.stderr.on('data', hear);
    server.on('exit', (code) => reject(new Error(`asperity serve ended with ${code}: ${said}`)));
  });
  browser = await on.openBrowser();
});
after(async () => {
  await browser?.close();
  if (server) {
    const ended = new Promise((r) => server.on('exit', r));
    server.kill('SIGINT');
    await ended;
  }
  if (folder) rmSync(folder, { recursive: true });
});

const visit = (options, act) => on.visit(browser, url, options, act);

// Printed only: the time depends on the machine.
test('Served, StartsWithFewRequestsAndBytes', () =>
  visit({}, async (page) => {
    const { requests, bytes, ms } = await on.start(page);
    console.log(`interactive after ${requests} requests, ${bytes} bytes, ${Math.round(ms)} ms`);
    assert.ok(requests >= 2 && requests <= 6, `${requests} requests`);
    assert.ok(bytes > 100_000 && bytes < 650_000, `${bytes} bytes`);
  }));

// The notebook's order, then unordered columns by name, then later ones.
for (const [name, columns, rows] of [
  ['order', 'z,m,a,also,extra', '{ columns={ "z", "m", "a" } })\nbook:write{ a=1, extra=1, m=2, also=3, z=4 }'],
  ['lacking', 'z,m,a,late', '{ columns={ "z", "m", "a" } })\nbook:write{ a=1 } book:write{ a=2, late=1, z=3 }'],
  ['plain', 'b,m,z,a', '{})\nbook:write{ z=1, b=2, m=3 } book:write{ z=1, a=2 }'],
])
  test(`Table, ColumnsStandAsInTheCsv, ${name}`, () =>
    visit({}, async (page) => {
      await on.run(page, `local lab = require "asperity"\nlocal book = lab.notebook("${name}", ${rows}\n`);
      await on.finished(page);
      await on.openTab(page, 'table');
      await on.until(page, () => document.querySelector('table thead th'), 'the table should be there');
      const runs = join(folder, 'runs');
      const [file] = readdirSync(runs, { recursive: true }).filter((f) => f.endsWith(`${name}.csv`));
      assert.equal(readFileSync(join(runs, file), 'utf8').split('\n')[0], columns);
      assert.equal(
        await page.$$eval('table thead th', (heads) => heads.map((th) => th.textContent).join()),
        `#,${columns}`,
      );
    }));

const pressed = `local lab = require "asperity"
local p = lab.knob{ name="pressure", from="1 MPa", to="200 MPa", value="20 MPa", log=true }
local s = lab.surface.self_affine{ cells=256, size="1 mm", hurst=0.8, rms_height="1 um", short_wave="20 um",
  material=lab.material "Al-2011" }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
if p > 1.5e8 then error "more than the press can do" end
print("area", c:press{ pressure=p }.area_fraction)
`;

const titled = (page, text) =>
  on.until(
    page,
    (t) => document.querySelector('.relief').getAttribute('aria-label')?.startsWith(t),
    `the picture should be ${text}`,
    text,
  );

/** Confined processes are children of the server's threads. */
function processes() {
  const found = [];
  for (const task of readdirSync(`/proc/${server.pid}/task`)) {
    try {
      found.push(...readFileSync(`/proc/${server.pid}/task/${task}/children`, 'utf8').trim().split(' '));
    } catch {
      // The thread has ended.
    }
  }
  return found.filter(Boolean).sort();
}

test('Knob, ScriptFollowsItInAProcessThatStaysAlive', () =>
  visit({}, async (page) => {
    await on.write(page, pressed);
    await on.knobSays(page, '20 MPa'); // before the first run
    await on.openTab(page, 'picture');
    const begun = [];
    page.on('request', (r) => r.method() === 'POST' && begun.push(new URL(r.url()).pathname));
    const before = processes();
    await on.listen(page);
    const whole = async (counts) => {
      const pressure = await on.knobText(page);
      await on.untilSaid(page, new RegExp(`^Live in .*${counts}`), `contact:press at ${pressure}:`);
    };
    // The first move computes the surface.
    await on.typeKnob(page, '21 MPa');
    await whole('2 computed, 0 from memory');
    const alive = processes().filter((p) => !before.includes(p))[0];
    assert.ok(alive);
    for (const value of ['22 MPa', '23 MPa', '24 MPa']) {
      await on.typeKnob(page, value);
      await whole('1 computed, 1 from memory');
    }
    assert.ok(processes().includes(alive), 'its process should be the one it was');
    assert.equal(begun.filter((path) => path === '/api/live').length, 1, 'no other was begun');
    // At rest, the values are run and recorded.
    await on.finished(page);
    assert.match(await on.text(page, '#results-of'), /run \d+/);
    assert.equal(await page.$eval('#save', (e) => e.disabled), false);
    await on.assertAccessible(page, 'after a knob was moved');
  }));

test('Knob, OfATextThatIsNoMoreHasNoSlider', () =>
  visit({}, async (page) => {
    await on.write(page, 'local lab = require "asperity"\nprint(lab.knob{ name="n", from=1, to=2, value=1 })\n');
    await on.knobSays(page, '1');
    await on.write(page, 'local lab = require "asperity"\nprint(lab.knob{ name="n", from=1, to=2 })\n');
    await on.until(page, () => document.querySelector('#problems li.error'), 'the check should find it');
    assert.ok(await page.$('.knobs input'), 'a mistake takes no slider');
    await on.write(page, 'print "plain"\n');
    await on.until(page, () => document.querySelector('.knobs').hidden, 'the slider should go');
  }));

test('Knob, OfAScriptWithoutPicturesShowsNoneOfAnother', () =>
  visit({}, async (page) => {
    await on.run(page, 'local lab = require "asperity"\nlab.surface.sine{ cells=16, size="1 mm", amplitude="1 um" }\n');
    await on.finished(page);
    await on.openTab(page, 'picture');
    await on.until(page, () => document.querySelector('.pictures .caption').textContent, 'the picture should come');
    await on.write(page, 'local lab = require "asperity"\nprint(lab.knob{ name="n", from=1, to=2, value=1 })\n');
    await on.knobSays(page, '1');
    await on.listen(page);
    await page.focus('.knobs input');
    await page.keyboard.press('ArrowRight');
    await on.untilSaid(page, /^Live in/);
    const seen = () => page.$$eval('.pictures, #picture .empty', (all) => all.map((e) => [e.className, e.hidden]));
    assert.deepEqual(await seen(), [
      ['empty', false],
      ['pictures', true],
    ]);
    await on.finished(page);
    assert.equal((await seen())[1][1], true);
  }));

test('Knob, CoarseAnswerFirstWhereTheWholeTakesLonger', () =>
  visit({}, async (page) => {
    await on.write(page, pressed.replace('cells=256', 'cells=1024').replace('20 um', '80 um').replace('print("area",', 'print("at " .. p / 1e6 .. " MPa\\n",'));
    await on.knobSays(page, '20 MPa');
    await on.listen(page);
    await page.focus('.knobs input');
    // The first move computes the surface, the second measures the full time. The full answer may hide the
    // coarse one.
    let coarse;
    let pressure = 20;
    await on.comesTrue(async () => {
      await on.typeKnob(page, `${++pressure}.5 MPa`);
      await on.until(
        page,
        (p) =>
          document.querySelector('.output').textContent.includes(`at ${p}\n`) &&
          document.querySelector('#status').textContent.startsWith('Live in'),
        'the whole should be answered',
        await on.knobText(page),
      );
      coarse = await page.evaluate(() => window.said.find((e) => e.status.startsWith('Live, coarse')));
      return coarse;
    }, 'a coarse answer should come first');
    assert.match(coarse.status, /^Live, coarse: 1\/\d+ of the cells a side; the whole follows/);
  }));

test('Knob, ItsProcessGoesWithTheTab', async () => {
  const before = processes();
  await visit({}, async (page) => {
    await on.write(page, 'local lab = require "asperity"\nprint(lab.knob{ name="n", from=1, to=2, value=1 })\n');
    await on.knobSays(page, '1');
    await on.listen(page);
    await page.focus('.knobs input');
    await page.keyboard.press('ArrowRight');
    await on.untilSaid(page, /^Live in/);
    const alive = processes().filter((p) => !before.includes(p));
    assert.equal(alive.length, 1);
    await on.finished(page);
    await page.goto('about:blank');
    await on.comesTrue(() => !processes().includes(alive[0]), 'its process should end');
    await page.goBack();
    await on.until(page, () => document.querySelector('.lessons button'), 'the lessons should be listed');
  });
});

test('Knob, AProcessThatHasEndedIsBegunAgain', () =>
  visit({}, async (page) => {
    await on.write(page, pressed.replace('cells=256', 'cells=64').replace('20 um', '80 um'));
    await on.knobSays(page, '20 MPa');
    const before = processes();
    const answered = () => on.untilSaid(page, /^Live in .*2 computed, 0 from memory/); // an empty memory
    await on.listen(page);
    await page.focus('.knobs input');
    await page.keyboard.press('ArrowRight');
    await answered();
    const [alive] = processes().filter((p) => !before.includes(p));
    await on.finished(page);
    process.kill(Number(alive), 'SIGKILL');
    await on.comesTrue(() => !processes().includes(alive), 'its process should end');
    await on.listen(page);
    await page.keyboard.press('ArrowRight');
    await answered();
    assert.equal(await page.$eval('#banner', (e) => e.hidden), true);
  }));

test('Knob, MovesThePictureAndEndsInAnErrorAtOneValue', () =>
  visit({}, async (page) => {
    await on.run(page, pressed);
    await on.finished(page);
    await on.knobSays(page, '20 MPa');
    await on.openTab(page, 'picture');
    await titled(page, 'contact:press at 20 MPa');
    await page.focus('.knobs input');
    await on.listen(page);
    await page.keyboard.press('End');
    await on.untilSaid(page, /^Live: line 6: more than/);
    await on.finished(page, 'Failed');
    await page.focus('.knobs input');
    await page.keyboard.press('Home');
    await on.finished(page);
    await on.openTab(page, 'picture');
    await titled(page, 'contact:press at 1 MPa');
  }));

test('Lesson, OpenedEditedRunLookedAtAndSaved', async () => {
  const downloads = join(folder, 'saved');
  mkdirSync(downloads);
  let file;
  await visit({ downloads }, async (page) => {
    assert.ok((await page.$$('.lessons button')).length >= 8);
    await page.click('.lessons li:nth-child(4) button');
    await on.until(page, () => document.querySelector('.lesson'), 'the lesson should open');
    assert.match(await on.text(page, '#lessons'), /Question.*Predict/s);
    await on.until(page, () => !document.querySelector('#problems li.error'), 'the lesson should have no mistakes');
    await (await page.$('>>> .cm-content')).focus();
    await on.chord(page, 'Control', 'End');
    await page.keyboard.type('\nprint "edited by a reader"');
    await on.chord(page, 'Control', 'Enter');
    await page.click('#banner button:last-child'); // without a prediction
    await on.until(
      page,
      () => /^(Done|Failed|Ended)/.test(document.querySelector('#status').textContent),
      'the lesson should end',
    );
    assert.match(await on.text(page, '#status'), /^Done/);
    assert.match(await on.text(page, '.output'), /edited by a reader\n/);
    assert.ok(Number(await on.text(page, '#tab-table .count')) > 0);
    await on.openTab(page, 'chart');
    await page.waitForSelector('.chart svg path');
    await on.openTab(page, 'picture');
    await on.until(page, () => document.querySelector('.pictures .caption').textContent, 'the picture should come');
    assert.match(
      await on.text(page, '.pictures .caption'),
      /· (shown: \d+ × \d+ means of \d+ × \d+ nodes of \d+ × \d+|all \d+ × \d+ nodes shown)/,
    );
    await page.focus('.relief');
    await page.keyboard.press('Home');
    const first = await on.pixels(page);
    assert.ok(first.colours > 50 && first.drawn > 0.1, `blank: ${first.colours} colours, ${first.drawn}`);
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('ArrowLeft');
    assert.ok(on.differing(first, await on.pixels(page)) > 0.01, 'it should turn');
    await on.openTab(page, 'files');
    await page.waitForSelector('.files button');
    await on.until(
      page,
      () => [...document.querySelectorAll('.previews img.drawn')].some((i) => i.complete && i.clientWidth > 300),
      'the charts of the script should be seen',
    );
    await on.assertFits(page, 'the files');
    file = await on.save(page, downloads);
  });
  assert.match(readFileSync(file, 'utf8'), /edited by a reader/);
  const saved = await on.openPage(browser, `file://${file}`);
  assert.ok(
    await saved.evaluate(
      () => document.querySelectorAll('svg image').length > 0 && document.querySelectorAll('tbody tr').length > 0,
    ),
  );
  await on.assertQuiet(saved);
  await saved.done();
});

test('Run, StoppedKeepsItsRows', () =>
  visit({}, async (page) => {
    await on.run(
      page,
      'local lab = require "asperity"\nlocal book = lab.notebook "kept"\nbook:write{ ["a [m]"]=2e-6 }\nprint "on"\nwhile true do end\n',
    );
    await on.until(page, () => document.querySelector('.output')?.textContent.includes('on'), 'it should run');
    await page.keyboard.press('Escape');
    await on.finished(page, 'Stopped');
    await on.openTab(page, 'table');
    await page.waitForSelector('#table tbody tr');
    assert.deepEqual(await page.$$eval('#table th, #table td', (c) => c.map((e) => e.textContent)), [
      '#',
      'a [µm]',
      '1',
      '2',
    ]);
  }));

test('Mistakes, MarkedWhileTypingAndAfterARun', () =>
  visit({}, async (page) => {
    await on.write(page, 'local lab = require "asperity"\nlocal s = lab.surface.sine{ cells=8, size=1, amplitud=1 }\n');
    await on.until(page, () => document.querySelector('#problems li'), 'the check should find it');
    assert.match(await on.text(page, '#problems li'), /^Line 2.*amplitud/s);
    await on.run(page, 'local x = 1\n\nerror "this went wrong"\n');
    await on.finished(page, 'Failed');
    assert.match(await on.text(page, '#output .failure'), /^Line 3 ?this went wrong/);
  }));

test('Completion, OfTheLanguage', () =>
  visit({}, async (page) => {
    await on.write(page, 'local lab = require "asperity"\n');
    await page.keyboard.type('local s = lab.surface.fla');
    await on.accept(page, 'flat');
    assert.match(await on.editorText(page), /lab\.surface\.flat/);
  }));
