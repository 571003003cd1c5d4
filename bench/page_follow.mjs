// SPDX-License-Identifier: GPL-3.0-or-later
// How soon does the page's picture follow a slider? From the slider's event to the painted picture, for a press
// on 256 x 256 nodes, in headless Chromium without a graphics card. Two paces: one move every 300 ms and every
// 700 ms. Every move has a new value, so that no press comes from memory.
//   sh tests/page/run.sh $PWD/bench/page_follow.mjs $PWD/build/release $PWD/build/release/asperity
// With ASPERITY_ALONE=build/wasm/site: the page of static files, for a press on 128 x 128 nodes.

import { spawn, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { availableParallelism, loadavg, tmpdir } from 'node:os';
import { join } from 'node:path';
import * as on from '../tests/page/browser.mjs';

const moves = 40; // at each pace
const alone = process.env.ASPERITY_ALONE;
const script = `local lab = require "asperity"
local p = lab.knob{ name="pressure", from="1 MPa", to="900 MPa", value="1 MPa", log=true }
local s = lab.surface.self_affine{ cells=${alone ? 128 : 256}, size="1 mm", hurst=0.8, rms_height="1 um", short_wave="20 um",
  material=lab.material "Al-2011" }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
print("area", c:press{ pressure=p }.area_fraction)
`;

function processor() {
  const facts = readFileSync('/proc/cpuinfo', 'utf8');
  const model = /model name\s*: (.*)/.exec(facts)?.[1] ?? 'unknown processor';
  const widths = ['avx512f', 'avx2'].filter((flag) => new RegExp(`\\b${flag}\\b`).test(facts));
  const [, vectors] = /(vectors? .*)/.exec(spawnSync(process.env.ASPERITY_PROGRAM, ['version']).stdout) ?? [];
  const load = loadavg()[0].toFixed(1);
  return `${model} (${widths.join(', ')}), ${availableParallelism()} cores, load ${load} before; program: ${vectors}`;
}

async function addressOf(server) {
  let said = '';
  for await (const data of server.stdout) {
    said += data;
    const found = (alone ? /http:\/\/\S+\// : /http:\/\/\S+#\S+/).exec(said);
    if (found) return found[0];
  }
  throw new Error(`the server ended: ${said}`);
}

const quantile = (sorted, share) => Math.round(sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))]);

/** Moves the slider by its pixels and waits `pace` ms from move to move. */
async function follow(page, from, pace) {
  await page.evaluate(() => (window.whole = []));
  const { x, y, width, height } = await on.placeOf(page, '.knobs input[type=range]');
  const move = (k) => page.mouse.move(x + 8 + ((width - 16) * k) / (2 * moves), y + height / 2);
  await move(from);
  await page.mouse.down();
  for (let k = from + 1; k <= from + moves; ++k) {
    await move(k);
    await on.pause(pace);
  }
  await page.mouse.up();
  await on.pause(1000);
  const times = await page.evaluate(() => window.whole);
  const sorted = times.sort((a, b) => a - b);
  console.log(
    `a move every ${pace} ms: median ${quantile(sorted, 0.5)} ms, 95 % ${quantile(sorted, 0.95)} ms, ` +
      `most ${quantile(sorted, 1)} ms; ${sorted.length} pictures of ${moves} moves`,
  );
}

console.log(processor());
const folder = mkdtempSync(join(tmpdir(), 'asperity-follow-'));
const server = alone
  ? spawn('python3', ['-u', '-m', 'http.server', '--bind', '127.0.0.1', '--directory', alone, '0'], { stdio: ['ignore', 'pipe', 'ignore'] })
  : spawn(process.env.ASPERITY_PROGRAM, ['serve', '--out', folder], { stdio: ['ignore', 'pipe', 'ignore'] });
// Frames by emulated OpenGL would take 31 ms each of one of the cores, which a graphics card does not.
const browser = await on.openBrowser(['--disable-gpu-compositing']);
try {
  const page = await on.openPage(browser, await addressOf(server));
  await on.ready(page);
  await on.run(page, script);
  await on.finished(page);
  await page.click('#tab-picture');
  await on.until(page, () => document.querySelector('.knobs input'), 'a slider should come');
  await on.typeKnob(page, '1.05 MPa'); // begins the process that follows
  await on.until(page, () => document.querySelector('#status').textContent.startsWith('Live in'), 'it should follow');
  await page.evaluate(() => {
    const take = (list) => {
      const whole = list.getEntries().filter((e) => e.name === 'asperity-live' && e.detail === 'whole');
      window.whole.push(...whole.map((e) => e.duration));
    };
    new PerformanceObserver(take).observe({ entryTypes: ['measure'] });
  });
  await follow(page, 0, 300);
  await follow(page, moves, 700);
} finally {
  await browser.close();
  server.kill('SIGINT');
  await new Promise((r) => server.on('exit', r));
  rmSync(folder, { recursive: true });
}
