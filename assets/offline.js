// The service worker: the whole site offline. The list of files and the name of the edition are put in when the site is built
// (tools/release.mjs); each edition has a store of its own, and an old one goes when the new one is in charge.
const EDITION = 'quadtank-@EDITION@';
const FILES = ['@FILES@'];

self.addEventListener('install', (event) => event.waitUntil(caches.open(EDITION).then((store) => store.addAll(FILES))));

self.addEventListener('activate', (event) =>
  event.waitUntil(
    (async () => {
      const names = await caches.keys();
      await Promise.all(names.filter((name) => name.startsWith('quadtank-') && name !== EDITION).map((name) => caches.delete(name)));
      await self.clients.claim();
    })(),
  ),
);

// The page waits for the next start of all tabs, so that no tab mixes two editions; it can ask to begin at once.
self.addEventListener('message', (event) => {
  if (event.data === 'begin') self.skipWaiting();
});

self.addEventListener('fetch', (event) => {
  const address = new URL(event.request.url);
  if (event.request.method !== 'GET' || address.origin !== self.location.origin) return;
  event.respondWith(
    (async () => {
      const store = await caches.open(EDITION);
      // The query says what to show, not what to load.
      const kept = await store.match(event.request, { ignoreSearch: true });
      return kept ?? fetch(event.request);
    })(),
  );
});
