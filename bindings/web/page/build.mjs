// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the page: node build.mjs [OUTPUT [MODULE]]. MODULE: the folder of module.js and module.wasm; with it,
// the page needs no server and works offline. Writes index.html, page.js with the chunks it loads later,
// page.css, the icon and THIRD_PARTY.txt with the licence of every package in the bundle. A
// package without a licence text, or with a licence not known to be compatible with the GPL, stops the build.

import { build, transform } from 'esbuild';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { copyFileSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const output = resolve(process.argv[2] ?? join(here, 'dist'));
const module = process.argv[3];
const allowed = new Set(['MIT', 'ISC', 'BSD-2-Clause', 'BSD-3-Clause', '0BSD', 'Apache-2.0', 'CC0-1.0']);

rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });

// A saved run contains its style and script as text, and the script's digest in the content policy. The digest is
// computed here, because browsers offer no digests to a page over plain HTTP from another machine.
async function textOf(file, define = {}) {
  const made = await build({
    absWorkingDir: here,
    entryPoints: [file],
    bundle: true,
    format: 'iife',
    target: 'es2022',
    minify: true,
    legalComments: 'none',
    charset: 'utf8',
    define,
    write: false,
    logLevel: 'warning',
  });
  return made.outputFiles[0].text.trim();
}
const script = await textOf('src/saved/player.ts');
if (/<\/script|<!--/i.test(script)) throw new Error('the script of a saved run would end its own element');
const digest = `sha256-${createHash('sha256').update(script, 'utf8').digest('base64')}`;
const saved = { style: await textOf('src/saved/saved.css'), script, digest };

const result = await build({
  absWorkingDir: here,
  entryPoints: { page: 'src/main.ts' },
  outdir: output,
  bundle: true,
  splitting: true,
  format: 'esm',
  target: 'es2022',
  minify: true,
  legalComments: 'none',
  metafile: true,
  define: { SAVED: JSON.stringify(saved), ALONE: String(Boolean(module)) },
  external: module ? [] : ['xz-decompress'], // a server's page does not come to it
  charset: 'utf8',
  logLevel: 'warning',
});
await build({ absWorkingDir: here, entryPoints: ['src/page.css'], outdir: output, minify: true, logLevel: 'warning' });
for (const file of ['index.html', 'icon.svg']) copyFileSync(join(here, 'src', file), join(output, file));
if (module) await addModule();

// Without a server, the content policy stands in the page.
async function addModule() {
  const policy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' blob: data:; " +
    "connect-src 'self'; worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'";
  const page = join(output, 'index.html');
  // The module loads while the page's script loads.
  const head =
    `<meta charset="utf-8">\n<meta http-equiv="Content-Security-Policy" content="${policy}">\n` +
    '<link rel="preload" href="module.xz" as="fetch" crossorigin>';
  writeFileSync(page, readFileSync(page, 'utf8').replace('<meta charset="utf-8">', head));
  const glue = readFileSync(join(module, 'module.js'), 'utf8');
  writeFileSync(join(output, 'module.js'), (await transform(glue, { minify: true, charset: 'utf8' })).code);
  // A third smaller than gzip makes it, on every host.
  const xz = ['--check=crc32', '--lzma2=preset=9e,lc=4,pb=0', '--stdout', join(module, 'module.wasm')];
  writeFileSync(join(output, 'module.xz'), execFileSync('xz', xz, { maxBuffer: 1 << 26 }));
  writeFileSync(join(output, 'worker.js'), await textOf('src/alone/worker.ts'));
  const files = readdirSync(output).sort();
  const digest = createHash('sha256');
  for (const file of files) digest.update(readFileSync(join(output, file)));
  const define = { FILES: JSON.stringify(['./', ...files]), VERSION: JSON.stringify(digest.digest('hex').slice(0, 16)) };
  writeFileSync(join(output, 'offline.js'), await textOf('src/alone/offline.ts', define));
}

const packages = new Map();
for (const file of Object.keys(result.metafile.inputs)) {
  const found = /^(.*node_modules\/((?:@[^/]+\/)?[^/]+))\//.exec(file);
  if (found) packages.set(found[2], resolve(here, found[1]));
}
const notices = [...packages]
  .sort(([a], [b]) => (a < b ? -1 : 1))
  .map(([name, folder]) => {
    const { version, license, author, main } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
    if (!allowed.has(license))
      throw new Error(`${name} ${version} is under ${license}, which is not among ${[...allowed].join(', ')}`);
    const file = readdirSync(folder).find((f) => /^(licen[cs]e|copying)(\.\w+)?$/i.test(f));
    // Some packages open their code with it.
    const text = file
      ? readFileSync(join(folder, file), 'utf8').trim()
      : /^\/\*![^]*?\*\//.exec(readFileSync(join(folder, main), 'utf8'))?.[0];
    if (!text) throw new Error(`${name} ${version} brings no licence text`);
    const by = typeof author === 'string' ? author : author?.name;
    return `${name} ${version} (${license})${by ? `, ${by}` : ''}\n\n${text}\n`;
  });
writeFileSync(
  join(output, 'THIRD_PARTY.txt'),
  `The page of Asperity holds code of these packages, under their licences.\n\n${notices.join(`\n${'-'.repeat(80)}\n\n`)}`,
);

for (const file of readdirSync(output)
  .filter((f) => /\.(js|css|html|xz)$/.test(f))
  .sort()) {
  const text = readFileSync(join(output, file));
  console.log(
    `${file.padEnd(22)} ${(text.length / 1000).toFixed(1).padStart(7)} kB, ${(gzipSync(text).length / 1000).toFixed(1).padStart(6)} kB compressed`,
  );
}
console.log(`${packages.size} packages, see THIRD_PARTY.txt`);
