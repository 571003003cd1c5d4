// SPDX-License-Identifier: GPL-3.0-or-later
// The service worker: the page and each opened document also open without a network. Files of the page come
// from the store, documents from the host as long as it answers. FILES and VERSION come from build.mjs.

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
const ofPage = new Set(FILES.map((file) => new URL(file, location.href).href));

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
    if (stored && ofPage.has(request.url.replace(/[?#].*/, ''))) return stored;
    try {
      const fresh = await fetch(request);
      if (request.method === 'GET' && fresh.ok) await cache.put(request, fresh.clone());
      return fresh;
    } catch (error) {
      if (stored) return stored;
      throw error;
    }
  };
  (event as Asked).respondWith(answer());
});
