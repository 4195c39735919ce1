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
  try {
    engine.ccall("dynlab_add_language", null, ["string", "string"], [language, new TextDecoder().decode(fetched(`${folder}${language}.po`))]);
  } catch { /* it has not: they are in English */ }
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
  workForBench: () => engine.ccall("dynlab_work_for_bench", "number", [], []) !== 0,
  run({ order }) {
    speak(languageOf(order.source));
    engine.ccall("dynlab_run", null, ["string"], [JSON.stringify(order)]);
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
