// The engine of a page: a worker that runs the compiled engine, one order after the other, and passes its news on. The page
// compiles the engine once and hands it to each worker, so that Stop can end one and begin the next.
//
// It gets {act: "begin", script, compiled, data, home, catalogs}, then {act: "files", folder, files}, "run", "check", "pack", "ask" and
// "lint", or for the workbench "openBench", "askBench" and "workForBench"; it answers {id, answer} or {id, refusal} and sends {news} as engine/web/page_world.h describes them.
"use strict";

let engine = null;
const kHome = "/dynlab";

/// The bytes of a file of the site; a script that loads it waits for them.
function fetched(address) {
  const request = new XMLHttpRequest();
  request.open("GET", address, false);
  request.responseType = "arraybuffer";
  request.send();
  if (request.status !== 200) throw new Error(`${address}: ${request.status}`);
  return new Uint8Array(request.response);
}

/// A file of the site that is fetched when it is first read.
function putLazily(path, address, bytes) {
  const { FS } = engine;
  FS.writeFile(path, new Uint8Array(0));
  const { node } = FS.lookupPath(path), whole = node.stream_ops;
  node.usedBytes = bytes;
  const load = () => {
    if (node.stream_ops === whole) return;
    try {
      node.contents = fetched(address);
    } catch {
      throw new FS.ErrnoError(29);  // EIO
    }
    node.usedBytes = node.contents.length;
    node.stream_ops = whole;
  };
  const later = (name) => (...given) => { load(); return whole[name](...given); };
  node.stream_ops = { ...whole, read: later("read"), mmap: later("mmap"), llseek: later("llseek") };
}

/// `index`: by the names of data sets, [{file, bytes}] in folders at `address`.
function putDataSets(index, address) {
  for (const [name, files] of Object.entries(index)) {
    engine.FS.mkdirTree(`${kHome}/data/${name}`);
    for (const { file, bytes } of files) putLazily(`${kHome}/data/${name}/${file}`, `${address}${name}/${file}`, bytes);
  }
}

const languageOf = (source) => /^--\s*language:\s*(\w+)/m.exec(source)?.[1];
let folder = "";
const spoken = new Set(["en"]);
/// The engine's messages in a language, if the site has them.
function speak(language) {
  if (!language || spoken.has(language)) return;
  spoken.add(language);
  memories.length = 0;
  try {
    engine.ccall("dynlab_add_language", null, ["string", "string"], [language, new TextDecoder().decode(fetched(`${folder}${language}.po`))]);
  } catch { /* it has not: they are in English */ }
}

// The engine's memory between two parts of a run, so that a later run of the script, edited further on, begins there:
// {parts, pages}, the shortest run first. Equal pages are one array.
const kPage = 1 << 16, kMostPages = 2048, kMostRepeated = 50;  // bytes; 128 MB; ms of running between two memories
const memories = [];
let repeated = 0;  // ms of running that the last memory lacks

function keepMemory(parts) {
  const now = engine.HEAPU8, words = engine.HEAP32, before = memories.at(-1)?.pages ?? [];
  const same = (page, start) => {
    const old = new Int32Array(page.buffer);
    for (let i = 0, k = start >> 2; i < old.length; ++i, ++k) if (old[i] !== words[k]) return false;
    return true;
  };
  const pages = Array.from({ length: now.length / kPage }, (_, k) =>
    before[k] && same(before[k], k * kPage) ? before[k] : now.slice(k * kPage, (k + 1) * kPage));
  memories.push({ parts, pages });
  repeated = 0;
  while (new Set(memories.flatMap((one) => one.pages)).size > kMostPages) memories.shift();
}
/// The longest run of at most `parts` parts is the last one again. False where there is none.
function putBackMemory(parts) {
  while (memories.length > 0 && memories.at(-1).parts > parts) memories.pop();
  repeated = 0;
  if (memories.length === 0) return false;
  const { pages } = memories.at(-1), now = engine.HEAPU8;
  pages.forEach((page, k) => now.set(page, k * kPage));
  now.fill(0, pages.length * kPage);
  return true;
}

function bytesOf({ text, base64 }) {
  return base64 === undefined ? new TextEncoder().encode(text) : Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}
/// What lies in a folder: these files and no others.
function putFiles(folder, files) {
  const { FS } = engine;
  const clear = (path) => {
    for (const name of FS.readdir(path)) {
      if (name === "." || name === "..") continue;
      const inside = `${path}/${name}`;
      if (FS.isDir(FS.lstat(inside).mode)) { clear(inside); FS.rmdir(inside); } else FS.unlink(inside);
    }
  };
  FS.mkdirTree(folder);
  clear(folder);
  for (const file of files) {
    const path = `${folder}/${file.name}`;
    FS.mkdirTree(path.slice(0, path.lastIndexOf("/")));
    FS.writeFile(path, bytesOf(file));
  }
}

const kMoment = 30;  // ms
const acts = {
  async begin({ script, compiled, data, home }) {
    const news = (json) => self.postMessage({ news: json });
    importScripts(script);
    engine = await self.dynlab_engine({
      news, print: () => {}, printErr: () => {},
      locateFile: (name) => home + name,
      instantiateWasm: (imports, done) => {
        WebAssembly.instantiate(compiled, imports).then((instance) => done(instance, compiled));
        return {};
      },
      preRun: [(module) => Object.assign(module.ENV, { DYNLAB_HOME: kHome, DYNLAB_NO_CACHE: "1" })],
    });
    engine.FS.mkdirTree(`${kHome}/data`);
    putDataSets(data.index, data.address);
    putLazily(`${kHome}/help.txt`, `${home}help.txt`, 1);
    folder = home;
  },
  files: ({ folder, files }) => putFiles(folder, files),
  putFile({ path, bytes }) {
    engine.FS.mkdirTree(path.slice(0, path.lastIndexOf("/")) || "/");
    engine.FS.writeFile(path, bytes);
  },
  file: ({ path }) => engine.FS.readFile(path),
  openBench({ opening }) {
    speak(languageOf(opening.source));
    engine.ccall("dynlab_open_bench", null, ["string"], [JSON.stringify(opening)]);
  },
  askBench({ order, language }) {
    speak(language);
    if (order.path === "script") speak(languageOf(JSON.parse(order.body).text ?? ""));
    return JSON.parse(engine.ccall("dynlab_ask_bench", "string", ["string"], [JSON.stringify(order)]));
  },
  /// Runs parts of the script for kMoment; orders that arrive meanwhile wait. Returns whether parts remain.
  workForBench() {
    const until = performance.now() + kMoment;
    let more = true;
    while (more && performance.now() < until) more = engine.ccall("dynlab_work_for_bench", "number", [], []) !== 0;
    return more;
  },
  run({ order }) {
    speak(languageOf(order.source));
    const json = JSON.stringify(order), lasting = engine.ccall("dynlab_lasting_parts", "number", ["string"], [json]);
    const putBack = lasting >= 0 && putBackMemory(lasting);
    if (!engine.ccall("dynlab_begin_run", "number", ["string", "boolean"], [json, putBack])) return;
    for (;;) {
      const start = performance.now(), parts = engine.ccall("dynlab_run_part", "number", [], []);
      if (parts === 0) return;
      repeated += performance.now() - start;
      if (repeated > kMostRepeated) keepMemory(parts);
    }
  },
  check({ order }) {
    speak(languageOf(order.source));
    engine.ccall("dynlab_check", null, ["string"], [JSON.stringify(order)]);
  },
  ask: ({ question }) => JSON.parse(engine.ccall("dynlab_ask", "string", ["string"], [JSON.stringify(question)])),
  lint({ name, text, language }) {
    speak(language);
    return JSON.parse(engine.ccall("dynlab_lint", "string", ["string", "string", "string"], [text, name, language]));
  },
  pack({ files }) {
    putFiles("/pack", files);
    engine.ccall("dynlab_pack", null, ["string", "string"], ["/pack", "/pack.zip"]);
    return engine.FS.readFile("/pack.zip");
  },
  memory: () => engine.HEAPU8.length,
};

let last = Promise.resolve();
self.onmessage = ({ data: { id, act, ...what } }) => {
  last = last.then(async () => {
    try {
      self.postMessage({ id, answer: await acts[act](what) });
    } catch (error) {
      self.postMessage({ id, refusal: String(error?.message ?? error) });
    }
  });
};
