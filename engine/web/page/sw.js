// The service worker of a site: after the first visit every page works without a connection. files.json lists what the site consists of,
// with a version of the whole; a file whose hash is the same as before is not fetched again.
"use strict";

const kName = "dynlab ", kList = "files.json";
const scope = self.registration.scope;
const cacheName = (version) => `${kName}${scope} ${version}`;
const isOurs = (name) => name.startsWith(`${kName}${scope} `);
const address = (path) => new URL(path, scope).href;
const kAtOnce = 6;

async function listed() {
  const reply = await fetch(address(kList), { cache: "no-store" });
  if (!reply.ok) throw new Error(kList);
  return reply;
}

/// The site's files according to the newest list, in a separate cache; unchanged files come from the previous cache.
async function fill() {
  const reply = await listed(), text = await reply.clone().text(), { version, files } = JSON.parse(text);
  const name = cacheName(version);
  if (await caches.has(name) && await (await caches.open(name)).match(address(kList))) return name;
  const cache = await caches.open(name), before = new Map();
  for (const other of (await caches.keys()).filter((one) => isOurs(one) && one !== name)) {
    const old = await caches.open(other), list = await old.match(address(kList));
    for (const { path, sha256 } of list ? (await list.json()).files : []) before.set(`${path} ${sha256}`, old);
  }
  const waiting = [...files];
  const work = async () => {
    for (let file = waiting.shift(); file; file = waiting.shift()) {
      const where = address(file.path), known = await before.get(`${file.path} ${file.sha256}`)?.match(where);
      if (await cache.match(where)) continue;
      const got = known ?? await fetch(where, { cache: "no-cache", priority: "low" });
      if (!got.ok) throw new Error(file.path);
      await cache.put(where, got);
    }
  };
  await Promise.all(Array.from({ length: kAtOnce }, work));
  await cache.put(address(kList), reply);  // last: a cache with its list is whole
  return name;
}

/// The newest cache that is whole: the one of this worker's life, so that a page does not get files of two versions.
let serving = null;
const current = () => { serving ??= newest(); return serving; };
async function newest() {
  for (const name of (await caches.keys()).filter(isOurs).reverse()) {
    const cache = await caches.open(name);
    if (await cache.match(address(kList))) return { name, cache };
  }
  serving = null;
  return null;
}

async function dropOthers(name) {
  const served = (await current())?.name;
  await Promise.all((await caches.keys()).filter((one) => isOurs(one) && one !== name && one !== served).map((one) => caches.delete(one)));
}

let renewed = null;
/// Looks for a newer site once in the life of this worker; pages get it when they are opened later.
const renew = () => { renewed ??= fill().then(dropOthers).catch(() => {}); return renewed; };

async function answer(request) {
  const page = new URL(request.url);
  page.hash = page.search = "";
  if (page.pathname.endsWith("/")) page.pathname += "index.html";
  return await (await current())?.cache.match(page.href) ?? fetch(request);
}

const kLater = 4000;  // ms: the page that brought this worker loads first
self.addEventListener("install", (event) => {
  event.waitUntil(new Promise((yes) => { setTimeout(yes, kLater); }).then(fill).then(() => self.skipWaiting()));
});
self.addEventListener("activate", (event) => { event.waitUntil(self.clients.claim()); });
self.addEventListener("fetch", (event) => {
  if (event.request.method !== "GET" || !event.request.url.startsWith(scope)) return;
  event.respondWith(answer(event.request));
  if (event.request.mode === "navigate") event.waitUntil(renew());
});
