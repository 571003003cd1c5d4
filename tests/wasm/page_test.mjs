// SPDX-License-Identifier: GPL-3.0-or-later
// The page without a server, in Chromium: static files from a folder. ASPERITY_ALONE is the folder,
// ASPERITY_PROGRAM the native program, ASPERITY_PAGE_BUILD the build folder with the test packages.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { after, before, test } from 'node:test';
import * as on from '../page/browser.mjs';

const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml' };
const folder = mkdtempSync(join(tmpdir(), 'asperity-'));
let browser, server, url;

const serve = () =>
  new Promise((ready) => {
    server = createServer((request, answer) => {
      const path = new URL(request.url, 'http://here').pathname;
      const file = join(process.env.ASPERITY_ALONE, path === '/' ? 'index.html' : path);
      try {
        const bytes = readFileSync(file);
        answer.writeHead(200, { 'Content-Type': types[extname(file)] ?? 'application/octet-stream' }).end(bytes);
      } catch {
        answer.writeHead(404).end();
      }
    });
    server.listen(url ? Number(new URL(url).port) : 0, '127.0.0.1', ready);
  });

before(async () => {
  browser = await on.openBrowser();
  await serve();
  url = `http://127.0.0.1:${server.address().port}/`;
});
after(async () => {
  await browser?.close();
  server?.close();
  rmSync(folder, { recursive: true });
});

const visit = (options, act) => on.visit(browser, url, options, act);
const native = (...words) => execFileSync(process.env.ASPERITY_PROGRAM, words, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });

/** Drops files or folders of this machine on the page. */
async function drop(page, ...files) {
  const session = await page.createCDPSession();
  const data = { items: [], files, dragOperationsMask: 1 };
  for (const type of ['dragEnter', 'dragOver', 'drop'])
    await session.send('Input.dispatchDragEvent', { type, x: 700, y: 300, data });
  await session.detach();
}

const press = (cells) => `local lab = require "asperity"
local plate = lab.surface.self_affine{ cells=${cells}, size="1 mm", hurst=0.8, rms_slope=0.1, short_wave="64 um",
                                       material=lab.material "steel" }
local pressure = lab.knob{ name="pressure", from="10 MPa", to="400 MPa", value="100 MPa" }
local c = lab.contact{ lower=plate, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local st = c:press{ pressure=pressure }
print(("%.17g"):format(st.area_fraction))
`;

// Times are printed only: they depend on the machine. The page clicks by itself, because a driver of a browser waits
// for frames before each click.
test('Start, ShowsTheChartOfTheFirstScript', async () => {
  const page = await on.openPage(browser);
  await page.evaluateOnNewDocument(() => {
    const find = (selector) => document.querySelector(selector);
    window.firstChart = new Promise((shown) => {
      const steps = [
        [() => find('#run:enabled'), () => find('#run').click()],
        [() => find('#status').textContent.startsWith('Done'), () => find('#tab-chart').click()],
        [() => find('.chart svg circle'), () => requestAnimationFrame(() => setTimeout(() => shown(performance.now())))],
      ];
      new MutationObserver(() => {
        while (steps.length > 0 && steps[0][0]()) steps.shift()[1]();
      }).observe(document, { subtree: true, childList: true, attributes: true, characterData: true });
    });
  });
  await page.goto(url);
  const whole = await page.evaluate(() => window.firstChart);
  const loaded = await page.evaluate(() => performance.getEntriesByType('navigation')[0].loadEventEnd);
  console.log(`# first chart ${Math.round(whole)} ms after the navigation, ${Math.round(whole - loaded)} ms after loading`);
  await page.done();
});

test('Presses, TellTheirTimes', () =>
  visit({}, async (page) => {
    for (const cells of [256, 512]) {
      const [made, pressed] = press(cells).split('local st = ');
      await on.run(page, `${made}for k = 1, 5 do\n  local t = os.clock()\n  local st = ${pressed.split('\n')[0].replace('=pressure', '=(100 + k) .. " MPa"')}
  print(("%.0f ms"):format(1000 * (os.clock() - t)))\nend\n`);
      await on.finished(page);
      const times = (await on.text(page, '.output')).match(/\d+ ms/g);
      assert.equal(times.length, 5);
      console.log(`# presses of ${cells} x ${cells} cells: ${times.join(', ')}`);
    }
  }));

test('Run, PrintsTheDigitsOfTheNativeProgram', () =>
  visit({}, async (page) => {
    await on.run(page, press(256));
    await on.finished(page);
    writeFileSync(join(folder, 'press.lua'), press(256));
    const expected = native('run', 'press.lua', '--threads', '1').trim();
    await on.openTab(page, 'output');
    assert.ok((await on.text(page, '.output')).startsWith(expected), 'the native program prints the same digits');
  }));

test('Prompt, ShowsValuesAndErrorsAndAnswersQuestions', () =>
  visit({}, async (page) => {
    await page.click('#prompt-button');
    const enter = async (line, shown) => {
      await page.type('.prompt input', `${line}\n`);
      const told = (text) => document.querySelector('.prompt .output').textContent.split('\n> ').at(-1).includes(text);
      await on.until(page, told, `${line} should show ${shown}`, shown);
      await on.until(page, () => document.querySelector('.prompt button').disabled, `${line} should end`);
    };
    await enter('s = lab.surface.sine{ cells=64, size="1 mm", amplitude="2 um", wavelength="0.5 mm" }', 's = lab');
    await enter('s:roughness().Ra', '1.269 um (1.2691463e-06 m)');
    const tab = async (line, completed) => {
      await page.type('.prompt input', line);
      await page.keyboard.press('Tab');
      await on.until(page, (text) => document.querySelector('.prompt input').value === text, `Tab should give ${completed}`, completed);
      await page.$eval('.prompt input', (input) => (input.value = ''));
    };
    await tab('lab.surface.self_a', 'lab.surface.self_affine');
    await tab('s:rough', 's:roughness');
    await enter('lab.notebook "kept":write{ Ra = s:roughness().Ra }', 'kept');
    await on.until(page, () => document.querySelector('.prompt [aria-label="Save kept.csv"]'), 'its file should be offered');
    await enter('lab.notebook "kept":chart{ x="Ra", y="Ra", file="c.svg" }', 'charts are drawn for scripts');
    await on.assertAccessible(page, 'the prompt');
    await on.assertFits(page, 'the prompt');
    await enter('for k = 1, 2 do', 'for');
    await enter('print(k * 7) end', '14');
    await enter('lab.surfce', 'did you mean `surface`?');
    await enter('help "how do I turn"', 'contact:rotate');
    await enter('who', 's  surface 64 x 64 cells');
    await enter('exit', 'the session has ended');
    assert.ok(await page.$('.prompt [aria-label="Save kept.csv"]'), 'files stay until another session begins');
    await enter('s', 'was never set');
    await page.type('.prompt input', 'while true do end\n');
    await on.until(page, () => !document.querySelector('.prompt button').disabled, 'the loop should run');
    await page.click('.prompt button');
    await enter('1 + 1', '2');
  }));

test('Requests, AllGoToThePagesHost', async () => {
  const page = await on.openPage(browser, null);
  const asked = [];
  page.on('request', (request) => asked.push(request.url()));
  await page.goto(url);
  await on.ready(page);
  await on.run(page, press(64));
  await on.finished(page);
  assert.ok(asked.length > 5);
  for (const address of asked) assert.ok(address.startsWith(url) || /^(blob|data):/.test(address), address);
  await page.done();
});

test('Knob, MovesThePicture', () =>
  visit({}, async (page) => {
    await on.run(page, press(128));
    await on.finished(page);
    await on.openTab(page, 'picture');
    await page.waitForSelector('.relief');
    await on.typeKnob(page, '200 MPa');
    await on.until(page, () => document.querySelector('#status').textContent.startsWith('Live in'), 'it should follow live');
    await on.until(
      page,
      () => document.querySelector('.relief').getAttribute('aria-label')?.includes('200 MPa'),
      'the picture should follow the knob',
    );
  }));

test('Stop, EndsAnEndlessScriptAndTheNextOneRuns', () =>
  visit({}, async (page) => {
    await on.run(page, 'print "begun"\nwhile true do end\n');
    await on.until(page, () => document.querySelector('.output').textContent.includes('begun'), 'it should print');
    await page.click('#stop');
    await on.finished(page, 'Stopped');
    await on.run(page, 'print(6 * 7)\n');
    await on.finished(page);
    assert.match(await on.text(page, '.output'), /^42/);
  }));

test('Failures, NameLineAndCause', () =>
  visit({}, async (page) => {
    await on.run(page, 'local lab = require "asperity"\nlab.surface.flat{ cells=-1 }\n');
    await on.finished(page, 'Failed');
    assert.match(await on.text(page, '#output'), /line 2/i);
    await on.run(page, 'os.exit(3)\n');
    await on.finished(page, 'Failed');
  }));

test('Lesson, ShowsItsChart', () =>
  visit({}, async (page) => {
    await page.evaluate(() => [...document.querySelectorAll('.lessons button')].find((b) => /Tilt it/.test(b.textContent)).click());
    await on.until(page, () => document.querySelector('#script-title').textContent !== 'Your own script', 'the lesson should open');
    await page.click('#run');
    await page.waitForSelector('#banner:not([hidden]) button, #stop:not([disabled])');
    await page.evaluate(() => [...document.querySelectorAll('#banner button')].find((b) => b.textContent === 'Run anyway')?.click());
    await on.finished(page);
    await on.openTab(page, 'chart');
    await page.waitForSelector('.chart svg circle, .chart svg path');
    await on.assertAccessible(page, 'a lesson with its chart');
  }));

test('Drop, OfAFileLetsScriptsReadIt', () =>
  visit({}, async (page) => {
    writeFileSync(join(folder, 'heights.csv'), '0,1,2\n3,4,5\n6,7,8\n');
    await drop(page, join(folder, 'heights.csv'));
    await on.until(page, () => /heights\.csv/.test(document.querySelector('#banner').textContent), 'the page should say so');
    await on.run(page, 'for line in io.lines "heights.csv" do print(line) end\n');
    await on.finished(page, 'Done|Failed');
    assert.match(await on.text(page, '.output'), /0,1,2/);
  }));

for (const lesson of (process.env.ASPERITY_LESSONS ?? '6').split(' '))
  test(`Drop, OfARunReplaysIt, Lesson${lesson}`, () =>
    visit({}, async (page) => {
      const name = `lesson-${lesson}`;
      native('lesson', lesson, '--run', '--threads', '1', '--out', name);
      await drop(page, join(folder, name));
      await on.finished(page, 'Done|Failed');
      const said = await on.text(page, '#output');
      assert.match(said, /the same again/, said);
    }));

test('Documents, LinkToTheirScriptsExamplesAndLessons', async () => {
  const page = await on.openPage(browser, `${url}docs/gallery.html`);
  const links = await page.$$eval('a', (all) => all.filter((a) => a.textContent === 'Run it here').map((a) => a.href));
  assert.ok(links.length >= 20, `${links.length} links`);
  await page.goto(`${url}docs/tour.html`);
  links.push(...(await page.$$eval('a', (all) => all.filter((a) => a.textContent === 'Run it here').map((a) => a.href))));
  await page.done();
  const opened = async (link, title, text) => {
    const to = await on.openPage(browser, link);
    await on.ready(to);
    await on.until(to, (t) => document.querySelector('#script-title').textContent === t, `${link} should open ${title}`, title);
    assert.match(await on.editorText(to), text);
    await on.assertQuiet(to);
    await to.done();
  };
  const one = (begin) => links.find((link) => link.startsWith(`${url}index.html#${begin}`));
  await opened(one('example=paper/'), 'paper/fig1_grain.lua', /Fig\. 1/);
  await opened(`${url}index.html#example=replay_press_log.lua`, 'replay_press_log.lua', /press_recording/);
  await opened(one('lesson=roughness'), 'What roughness is, and what a stylus misses', /require "asperity"/);
  await opened(one('script='), 'From the documents', /require "asperity"/);
});

test('Offline, ThePageOpensAndRuns', async () => {
  const page = await on.openPage(browser, url);
  await on.ready(page);
  await page.evaluate(async () => {
    await navigator.serviceWorker.ready;
  });
  server.closeAllConnections();
  await new Promise((closed) => server.close(closed));
  await page.reload();
  await on.ready(page);
  await on.run(page, 'print "offline"\n');
  await on.finished(page);
  assert.match(await on.text(page, '.output'), /offline/);
  await page.done();
  await serve();
});

test('Window, Of390PixelsIsUsable', () =>
  visit({ width: 390, height: 844 }, async (page) => {
    await on.run(page, press(64));
    await on.finished(page);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= 390, `${wide} px`);
    await on.assertAccessible(page, 'at 390 px');
  }));
