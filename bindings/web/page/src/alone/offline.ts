// SPDX-License-Identifier: GPL-3.0-or-later
// The service worker: stores all files of the page and each opened document, so that the page opens without a
// network. FILES and VERSION come from build.mjs.

declare const FILES: string[];
declare const VERSION: string;
interface Lasting extends Event {
  waitUntil(done: Promise<unknown>): void;
}
interface Asked extends Event {
  request: Request;
  respondWith(answer: Promise<Response>): void;
}
const cached = `asperity ${VERSION}`;

self.addEventListener('install', (event) => {
  (event as Lasting).waitUntil(caches.open(cached).then((cache) => cache.addAll(FILES)));
});
self.addEventListener('activate', (event) => {
  const old = caches.keys().then((names) => names.filter((n) => n.startsWith('asperity ') && n !== cached));
  (event as Lasting).waitUntil(old.then((names) => Promise.all(names.map((n) => caches.delete(n)))));
});
self.addEventListener('fetch', (event) => {
  const { request } = event as Asked;
  const answer = async (): Promise<Response> => {
    const cache = await caches.open(cached);
    const stored = await cache.match(request, { ignoreSearch: true });
    if (stored) return stored;
    const fresh = await fetch(request);
    if (request.method === 'GET' && fresh.ok) await cache.put(request, fresh.clone());
    return fresh;
  };
  (event as Asked).respondWith(answer());
});
