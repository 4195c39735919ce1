// The workbench of a site: its session is in the engine of the page (engine_worker.js). The script and the user's data files stay in the
// browser (work_store.js).
import { canRun, engine } from "./engine.js";
import { addWords, say, tr } from "./words.js";
import { kept, oneWriter, storedWork, storeWork } from "./work_store.js";

addWords({
  openElsewhere: tr("the workbench is open in another tab, which saves the session; changes in this tab are not saved"),
  keepsNothing: tr("this browser does not save the session; download the script before you close the page"),
  noEngine: tr("This browser cannot run the workbench, because it does not support WebAssembly exceptions. Update the browser, or install dynlab."),
  engineLost: tr("The engine could not be loaded: check the connection and load the page again."),
  sureOfNew: tr("The script, its history and your data files will be deleted from this browser. Continue?"),
});

export const hasPrograms = false;
const root = new URL("../", import.meta.url);
export const home = root.href;

const kFolder = "/bench", kFile = `${kFolder}/session.lua`, kDropped = "/dropped", kKey = "workbench";
const kPause = 300;  // ms of typing before the script is stored
const keyOfFile = (name) => `${kKey} ${name}`;
// past: scripts before this one, for undo; files: names of the user's data files; cell: the one that runs
let source = "", past = [], files = [], fresh = true, cell = "";
let prelude = null, writer = null, opened = null, timer = 0;
let heard = { page() {}, trouble() {} };

const languageOf = (text) => /^--\s*language:\s*(\w+)/m.exec(text)?.[1] ?? "";

async function begin() {
  if (!canRun()) throw new Error(say("noEngine"));
  writer = oneWriter(kKey, (writes) => { if (writes) store(); });
  const stored = await storedWork(kKey);
  source = stored?.source ?? "";
  past = stored?.past ?? [];
  files = (stored?.files ?? []).filter((name) => [source, ...past].some((script) => script.includes(name)));
  fresh = source === "";
  await Promise.all([start(""), writer.answered]);
}
async function start(stopped) {
  try {
    prelude ??= await (await fetch(new URL("views.lua", import.meta.url))).text();
    await engine.begin();
  } catch {
    throw new Error(say("engineLost"));
  }
  for (const name of files) {
    const bytes = await storedWork(keyOfFile(name));
    if (bytes) await engine.send("putFile", { path: `${kFolder}/${name}`, bytes });
  }
  await engine.send("openBench", { opening: { file: kFile, source, past, prelude, stopped } });
}
const open = () => {
  opened ??= begin();
  opened.catch(() => { opened = null; });
  return opened;
};

/// Runs the script, some parts with each request; orders that arrive meanwhile run between two requests.
let working = false;
async function work() {
  if (working) return;
  working = true;
  try {
    while (await engine.ask("workForBench", {}));
  } catch (error) {
    if (error.message !== "stopped") {
      heard.trouble(error.message);
      stop();
    }
  } finally {
    working = false;
  }
}
/// The worker ends and a new one opens the session again; the cells before the one that ran run again.
function stop() {
  engine.end().catch(() => {});
  opened = start(cell).then(async () => { await tellWhole(); work(); });
  opened.catch((error) => { opened = null; heard.trouble(error.message); });
  return opened;
}
async function tellWhole() {
  const { text } = await engine.send("askBench", { order: { path: "whole", name: "", body: "" }, language: languageOf(source) });
  take(JSON.parse(text));
}

async function store() {
  if (writer?.writes) await storeWork(kKey, { source, past, files });
}
function take(page) {
  if (page.source !== undefined && page.source !== source) {
    source = page.source;
    clearTimeout(timer);
    timer = setTimeout(store, kPause);
  }
  cell = Object.entries(page.states).find(([, { state }]) => state === "running")?.[0] ?? "";
  heard.page({ ...page, unsaved: writer?.writes === false ? say("openElsewhere") : kept() ? "" : say("keepsNothing") });
}
engine.heard = (news) => {
  if (news.kind === "page") {
    past = news.past ?? past;
    take(news.page);
  }
  else if (news.error) heard.trouble(news.error.text);
};
window.addEventListener("pagehide", () => { clearTimeout(timer); store(); });

async function toEngine(path, name, body) {
  await open();
  const { status, text } = await engine.send("askBench", { order: { path, name, body }, language: languageOf(source) });
  return new Response(status === 204 ? null : text, { status });
}
async function keepFile(file, bytes) {
  files = [...files.filter((name) => name !== file), file];
  if (writer.writes) await storeWork(keyOfFile(file), bytes);
  await store();
}
async function upload(name, file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  await open();
  await engine.send("putFile", { path: kDropped, bytes });
  const reply = await toEngine("upload", name, kDropped);
  if (reply.ok) await keepFile((await reply.clone().json()).data, bytes);
  return reply;
}
async function savedFile(name) {
  await open();
  try {
    return new Response(await engine.send("file", { path: `${kFolder}/out/${name}` }));
  } catch (error) {
    return new Response(error.message, { status: 404 });
  }
}

const partsOf = (path) => {
  const { pathname, searchParams } = new URL(path, "http://bench/");
  return { what: decodeURIComponent(pathname.slice(1)), name: searchParams.get("name") ?? searchParams.get("data") ?? "" };
};
export async function ask(path) {
  const { what, name } = partsOf(path);
  if (what === "opening") {
    await open();
    return new Response(JSON.stringify({ data: "", words: "", fresh }));
  }
  return what.startsWith("saved/") ? savedFile(what.slice("saved/".length)) : toEngine(what, name, "");
}
export async function send(path, body) {
  const { what, name } = partsOf(path);
  if (what === "stop") {
    await stop();
    return new Response(null, { status: 204 });
  }
  if (what === "upload") return upload(name, body);
  const reply = await toEngine(what, name, body ?? "");
  work();
  return reply;
}

export function listen({ page, trouble }) {
  heard = { page, trouble };
  open().then(tellWhole).then(work).catch((error) => trouble(error.message));
  return { close() { heard = { ...heard, page() {} }; } };
}

/// An empty session instead of this one.
export async function renew() {
  if (!confirm(say("sureOfNew"))) return;
  clearTimeout(timer);
  for (const name of files) await storeWork(keyOfFile(name), undefined);
  source = "";
  past = [];
  files = [];
  await store();
  location.reload();
}

if (location.protocol.startsWith("http")) navigator.serviceWorker?.register(new URL("sw.js", root)).catch(() => {});
