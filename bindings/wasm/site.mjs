// SPDX-License-Identifier: GPL-3.0-or-later
// Puts documents and examples beside the page of static files: node site.mjs PAGE DOCUMENTS EXAMPLES PACKAGES.
// Under each complete script, example and lesson of the documents stands a link that opens it in the page.

import { cpSync, existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';

const [page, documents, examples, packages] = process.argv.slice(2);

const plain = (html) =>
  html
    .replace(/<[^>]*>/g, '')
    .replace(/&quot;/g, '"')
    .replace(/&#39;/g, "'")
    .replace(/&lt;/g, '<')
    .replace(/&gt;/g, '>')
    .replace(/&amp;/g, '&');

/** The part of the page's address after #; undefined for code that does not run by itself. */
function target(code) {
  const lesson = /^asperity lesson (\w+)(?: --run)?$/.exec(code);
  if (lesson) return `lesson=${lesson[1]}`;
  const example = /^asperity run examples\/([\w/]+\.lua)$/.exec(code);
  if (example) return existsSync(join(examples, example[1])) ? `example=${example[1]}` : undefined;
  return code.includes('require "asperity"') ? `script=${encodeURIComponent(code)}` : undefined;
}

let links = 0;
function linked(html, up) {
  const after = (whole, code) => {
    const to = target(plain(code).trimEnd());
    if (!to) return whole;
    ++links;
    const link = `<a href="${up}index.html#${to.replace(/'/g, '%27')}" target="_blank" rel="noopener">Run it here</a>`;
    return whole.startsWith('<pre') ? `${whole}<p>${link}</p>` : `${whole} ${link}`;
  };
  return html
    .replace(/<pre><code class="language-lua">([^]*?)<\/code><\/pre>/g, after)
    .replace(/<code>(asperity (?:run|lesson) [^<]*)<\/code>/g, after);
}

cpSync(documents, join(page, 'docs'), { recursive: true });
function linkAll(folder) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) linkAll(path);
    else if (path.endsWith('.html')) writeFileSync(path, linked(readFileSync(path, 'utf8'), `${relative(folder, page)}/`));
  }
}
linkAll(join(page, 'docs'));
cpSync(examples, join(page, 'examples'), {
  recursive: true,
  filter: (file) => !/\/(library|cluster|accuracy)(\/|$)/.test(file),
});
const licences = readdirSync(packages)
  .filter((name) => existsSync(join(packages, name, 'debian/copyright')))
  .map((name) => `${name}, as Debian patches it\n\n${readFileSync(join(packages, name, 'debian/copyright'), 'utf8').trim()}\n`);
writeFileSync(
  join(page, 'THIRD_PARTY_MODULE.txt'),
  `The module of Asperity holds code of these packages, under their licences.\n\n${licences.join(`\n${'-'.repeat(80)}\n\n`)}`,
);
console.log(`${links} links from the documents into the page`);
