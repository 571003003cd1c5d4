// SPDX-License-Identifier: GPL-3.0-or-later
// A browser, pages that record complaints of the console and the content policy, input and waits.

import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

export const build = process.env.ASPERITY_PAGE_BUILD;
export const pageFolder = join(build, 'page');
const require = createRequire(join(build, 'page-build', 'package.json'));
const puppeteer = require('puppeteer-core');
const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');

/** Time limit of a wait, ms; a quiet machine needs less than a twentieth. */
const patience = 600_000;

/** The page's delays for input at rest and for playing pictures, ms. */
const sources = ['knobs.ts', 'scrub.ts', 'main.ts'].map((name) =>
  readFileSync(new URL(`../../bindings/web/page/src/${name}`, import.meta.url), 'utf8'),
);
const delays = ['rest', 'restAlive', 'playedFor', 'toldAfter'].map((name) =>
  Number(new RegExp(`const ${name} = (\\d+)`).exec(sources.join(''))[1]),
);

export async function openBrowser(more = []) {
  return (puppeteer.default ?? puppeteer).launch({
    executablePath: process.env.CHROMIUM,
    headless: 'shell',
    timeout: patience,
    protocolTimeout: patience,
    args: [
      '--no-sandbox',
      '--disable-dev-shm-usage',
      '--disable-gpu-compositing',
      '--use-gl=angle',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--hide-scrollbars=false',
      ...more,
    ],
  });
}

/** 1280 x 720 in its own browser context; `complaints` collects console messages. */
export async function openPage(browser, url, { scheme = 'light', width = 1280, height = 720, downloads } = {}) {
  const context = await browser.createBrowserContext(
    downloads ? { downloadBehavior: { policy: 'allow', downloadPath: downloads } } : {},
  );
  const page = await context.newPage();
  page.setDefaultTimeout(patience);
  await page.setViewport({ width, height });
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
  const complaints = [];
  page.on(
    'console',
    (m) =>
      ['error', 'warn'].includes(m.type()) &&
      !/Failed to load resource|GPU stall|WebGL/.test(m.text()) &&
      complaints.push(m.text()),
  );
  page.on('pageerror', (e) => complaints.push(e.message));
  await page.evaluateOnNewDocument(() => {
    window.violations = [];
    document.addEventListener('securitypolicyviolation', (e) =>
      window.violations.push(`${e.violatedDirective}: ${e.blockedURI} ${e.sample}`),
    );
  });
  if (url) await page.goto(url);
  // One call, because the page may redraw in between and a removed element has no size.
  const atOnce = (found, act, args) => page.evaluate(`(${act})(${found}, ...${JSON.stringify(args)})`);
  const inShadows = page.$$eval.bind(page);
  return Object.assign(page, {
    complaints,
    done: () => context.close(),
    $eval: (selector, act, ...args) => atOnce(`document.querySelector(${JSON.stringify(selector)})`, act, args),
    $$eval: (selector, act, ...args) =>
      selector.startsWith('>>>')
        ? inShadows(selector, act, ...args)
        : atOnce(`[...document.querySelectorAll(${JSON.stringify(selector)})]`, act, args),
  });
}

export async function assertQuiet(page) {
  assert.deepEqual(await page.evaluate(() => window.violations), []);
  assert.deepEqual(page.complaints, []);
}

export const ready = (page) =>
  until(page, () => document.querySelector('.lessons button, .lesson'), 'the lessons should be listed');

/** Opens the page, calls `act`, and asserts that console and content policy reported nothing. */
export async function visit(browser, url, options, act) {
  const page = await openPage(browser, url, options);
  try {
    await ready(page);
    await act(page);
    await assertQuiet(page);
  } finally {
    await page.done();
  }
}

export const pause = (ms) => new Promise((r) => setTimeout(r, ms));

/** Waits until all is drawn; a frame may request another. */
export const painted = (page) =>
  page.evaluate(async () => {
    for (let frame = 0; frame < 3; ++frame) await new Promise(requestAnimationFrame);
  });

/** Waits until `look` is constant over some frames. */
export async function settled(page, look) {
  for (let now = await look(), before; now !== before; now = await look()) {
    before = now;
    await painted(page);
  }
}

/** Waits until `test` is true of processes, files or the page. */
export async function comesTrue(test, what) {
  for (const end = Date.now() + patience; !(await test()); await pause(20)) assert.ok(Date.now() < end, what);
}

export async function until(page, test, what, ...args) {
  try {
    await page.waitForFunction(test, { polling: 50 }, ...args);
  } catch {
    const said = await page.evaluate(() => JSON.stringify(window.said ?? []));
    const seen = await page.evaluate(() => document.body.innerText.slice(0, 1500));
    assert.fail(`${what}; it said ${said}; the page shows:\n${seen}`);
  }
}

/** Opens a tab of the results; a frame later the tab shows the run. */
export async function openTab(page, name) {
  await page.click(`#tab-${name}`);
  await painted(page);
}

/** Holds the page's timers: `tick` fires them once, `release` restores the clock. */
export const hold = (page) =>
  page.evaluate((held) => {
    window.release?.();
    window.held = new Map();
    const [wait, forget] = [window.setTimeout, window.clearTimeout];
    let last = 0;
    window.setTimeout = (act, ms, ...args) => {
      if (!held.includes(ms)) return wait(act, ms, ...args);
      window.held.set(--last, act);
      return last;
    };
    window.clearTimeout = (timer) => window.held.delete(timer) || forget(timer);
    window.tick = () => {
      const due = [...window.held.values()];
      window.held.clear();
      due.forEach((act) => act());
    };
    window.release = () => {
      [window.setTimeout, window.clearTimeout, window.release] = [wait, forget, undefined];
      window.tick();
    };
  }, delays);

export const release = (page) => page.evaluate(() => window.release?.());

/** Waits for a held timer, then fires all. */
export async function tick(page) {
  await until(page, () => window.held.size > 0, 'the page should wait for time to pass');
  await page.evaluate(() => window.tick());
}

/** Holds timers and notes the status with the picture's title; values are recorded only after `finished`.
    */
export async function listen(page) {
  await hold(page);
  await page.evaluate(() => {
    window.said = [];
    const [status, relief] = ['#status', '.relief'].map((s) => document.querySelector(s));
    const note = () => window.said.push({ status: status.textContent, picture: relief.getAttribute('aria-label') ?? '' });
    const observer = new MutationObserver(note);
    observer.observe(status, { childList: true, characterData: true, subtree: true });
    observer.observe(relief, { attributes: true, attributeFilter: ['aria-label'] });
  });
}

/** Waits until, since `listen`, status and beginning of the title match. */
export const untilSaid = (page, status, picture = '') =>
  until(
    page,
    (s, p) => window.said.some((e) => new RegExp(s).test(e.status) && e.picture.startsWith(p)),
    `the status should have said ${status} ${picture && `of ${picture}`}`,
    status.source,
    picture,
  );

export const inEditor = (page, selector) =>
  until(
    page,
    (s) => document.querySelector('#editor').shadowRoot.querySelector(s),
    `the editor should have ${selector}`,
    selector,
  );

/** Accepts a candidate by Enter once it has been selected for longer than the editor's delay of 75 ms. */
export async function accept(page, wanted) {
  let since;
  await comesTrue(async () => {
    const [selected] = await page.$$eval('>>> .cm-tooltip-autocomplete li[aria-selected] .cm-completionLabel', (all) =>
      all.map((e) => e.textContent),
    );
    since = selected === wanted ? (since ?? Date.now()) : undefined;
    return since !== undefined && Date.now() - since > 300;
  }, `the editor should offer ${wanted}`);
  await page.keyboard.press('Enter');
}

export const text = (page, selector) => page.$eval(selector, (e) => e.textContent);

/** The number field of the first knob. */
export const knobText = (page) => page.$eval('.knobs input[type=text]', (e) => e.value);

export const knobSays = (page, words) =>
  until(
    page,
    (w) => document.querySelector('.knobs input[type=text]')?.value === w,
    `the first knob should say ${words}`,
    words,
  );

/** By keys: replaces the number of the first knob. */
export async function typeKnob(page, words) {
  await page.focus('.knobs input[type=text]');
  await chord(page, 'Control', 'a');
  await page.keyboard.type(words);
  await page.keyboard.press('Enter');
}

export async function chord(page, ...keys) {
  for (const key of keys.slice(0, -1)) await page.keyboard.down(key);
  await page.keyboard.press(keys.at(-1));
  for (const key of keys.slice(0, -1).reverse()) await page.keyboard.up(key);
}

export const editorText = (page) =>
  page.evaluate(() =>
    [...document.querySelector('#editor').shadowRoot.querySelectorAll('.cm-line')].map((l) => l.textContent).join('\n'),
  );

/** Inserts a script like a paste, without automatic brackets. */
export async function write(page, script) {
  await (await page.$('>>> .cm-content')).focus();
  await chord(page, 'Control', 'a'); // an empty script would be checked and shown too
  if (!script) return page.keyboard.press('Backspace');
  await page.evaluate((t) => {
    const data = new DataTransfer();
    data.setData('text/plain', t);
    document
      .querySelector('#editor')
      .shadowRoot.querySelector('.cm-content')
      .dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, bubbles: true, cancelable: true }));
  }, script);
}

const runOf = (page) => page.evaluate(() => sessionStorage.getItem('asperity.run'));

export async function run(page, script) {
  await write(page, script);
  page.before = await runOf(page);
  await chord(page, 'Control', 'Enter');
}

/** Waits until a run, by `run` or a resting knob, has ended and is drawn. */
export async function finished(page, status = 'Done') {
  await release(page);
  await comesTrue(async () => (await runOf(page)) !== (page.before ?? null), 'a run should begin');
  await painted(page);
  await until(
    page,
    (s) => new RegExp(`^(${s})`).test(document.querySelector('#status').textContent),
    `the run should end with ${status}`,
    status,
  );
  await painted(page);
  page.before = await runOf(page);
}

/** Saves to an empty folder; returns the file's path. */
export async function save(page, downloads) {
  await page.click('#save');
  await until(page, () => document.querySelector('#live').textContent.startsWith('Saved'), 'the run should be saved');
  assert.equal(await text(page, '#live'), 'Saved.');
  const files = () => readdirSync(downloads).filter((f) => f.endsWith('.html'));
  await comesTrue(() => files().length > 0, 'the file should be there');
  return join(downloads, files()[0]);
}

/** Place of an element in the window. A chart that is drawn again is another element, so this takes one step. */
export const placeOf = (page, selector) =>
  page.$eval(selector, (element) => {
    const { x, y, width, height } = element.getBoundingClientRect();
    return { x, y, width, height };
  });

/** Draws an element to `window.shot`. */
async function shoot(page, selector) {
  await painted(page);
  // `clip` is a place on the page, wherever the window stands.
  const clip = await page.$eval(selector, (element) => {
    element.scrollIntoView({ block: 'nearest', behavior: 'instant' });
    const { x, y, width, height } = element.getBoundingClientRect();
    return { x: x + scrollX, y: y + scrollY, width, height };
  });
  const shot = await page.screenshot({ encoding: 'base64', clip });
  await page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    window.shot = context.getImageData(0, 0, canvas.width, canvas.height);
  }, shot);
}

/** Number of colours, drawn share and sampled bytes of the relief, once two shots are equal. */
export async function pixels(page) {
  for (let now = await shotOfStage(page), before; ; now = await shotOfStage(page)) {
    if (before && differing(before, now) === 0) return now;
    before = now;
    await painted(page);
  }
}

async function shotOfStage(page) {
  await shoot(page, '.stage');
  return page.evaluate(() => {
    const bytes = window.shot.data;
    const colours = new Map();
    for (let k = 0; k < bytes.length; k += 4) {
      const key = (bytes[k] << 16) | (bytes[k + 1] << 8) | bytes[k + 2];
      colours.set(key, (colours.get(key) ?? 0) + 1);
    }
    const most = Math.max(...colours.values());
    return {
      colours: colours.size,
      drawn: 1 - most / (bytes.length / 4),
      bytes: [...bytes.filter((_, k) => k % 16 === 1)],
    };
  });
}

/** Share of columns with the colour [red, green, blue]. */
export async function inked(page, selector, colour) {
  await shoot(page, selector);
  return page.evaluate((wanted) => {
    const { width, height, data } = window.shot;
    const has = (x) => {
      for (let y = 0; y < height; ++y)
        if (wanted.every((c, k) => Math.abs(c - data[4 * (y * width + x) + k]) < 12)) return true;
      return false;
    };
    return [...Array(width).keys()].filter(has).length / width;
  }, colour);
}

export const differing = (a, b) => a.bytes.filter((v, k) => Math.abs(v - b.bytes[k]) > 12).length / a.bytes.length;

/** Nothing is wider than the window, no visible text smaller than 13 px. */
export async function assertFits(page, what) {
  const found = await page.evaluate(() => {
    const wide = [];
    const root = document.scrollingElement;
    if (root.scrollWidth > innerWidth || root.scrollHeight > innerHeight)
      wide.push(`the page: ${root.scrollWidth} x ${root.scrollHeight}`);
    for (const e of document.querySelectorAll(
      '.bar > *, .pane > *, .panel > *, .toolbar > *, .choices > *, .tabs > *, .below > *, .knobs > *',
    )) {
      const box = e.getBoundingClientRect();
      if (box.width === 0 || !e.checkVisibility() || e.closest('[hidden], .unseen')) continue; // also folded
      const pane = (e.closest('.pane') ?? document.body).getBoundingClientRect();
      if (box.right > pane.right + 1 || box.left < pane.left - 1)
        wide.push(`${e.tagName}.${e.className}#${e.id} ${Math.round(box.left)} to ${Math.round(box.right)}`);
    }
    const small = [];
    for (const e of document.querySelectorAll('body *')) {
      if (!e.checkVisibility?.() || ![...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim())) continue;
      const size = parseFloat(getComputedStyle(e).fontSize);
      if (size < (e.tagName === 'KBD' ? 13 : e.classList.contains('count') || e.closest('svg') ? 14 : 15))
        small.push(`${e.tagName} ${size}px: ${e.textContent.slice(0, 30)}`);
    }
    return { wide, small };
  });
  assert.deepEqual(found, { wide: [], small: [] }, what);
}

export async function assertAccessible(page, what) {
  await page.evaluate(axe);
  const found = await page.evaluate(async () => {
    const result = await window.axe.run(document, {
      runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'best-practice'],
    });
    return result.violations.flatMap((v) =>
      v.nodes.map((n) => `${v.id}: ${n.target.join(' ')} – ${n.failureSummary.split('\n')[1]?.trim()}`),
    );
  });
  assert.deepEqual(found, [], what);
}

export const focused = (page) =>
  page.evaluate(() => {
    let e = document.activeElement;
    while (e?.shadowRoot?.activeElement) e = e.shadowRoot.activeElement;
    return e?.id || e?.getAttribute('aria-label') || e?.textContent.trim().slice(0, 60) || e?.className || e?.tagName;
  });

/** The page's own files fetched before it became interactive: { requests, bytes (unpacked), ms }.
    Requests to the server are excluded, because their answers by then depend on the machine. */
export function start(page) {
  return page.evaluate(() => {
    const ms = performance.getEntriesByName('asperity-ready')[0].startTime;
    const fetched = [...performance.getEntriesByType('navigation'), ...performance.getEntriesByType('resource')]
      .filter((entry) => entry.initiatorType !== 'fetch' && entry.responseStart > 0 && entry.responseStart <= ms);
    return { requests: fetched.length, bytes: fetched.reduce((sum, entry) => sum + entry.decodedBodySize, 0), ms };
  });
}
