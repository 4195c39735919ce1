// The engine in a worker of its own: a page never waits for it, and stops a run by ending the worker. Orders are
// {id, call, arguments}; answers {id, value} or {id, error}; what a run gives comes as {news}.
"use strict";
const folder = self.location.href.replace(/[^/]*$/, "");
importScripts(folder + "dynlab.js");

/// Data sets of the course are fetched when a script loads them: {name: [file, ...]}.
function placeDataSets(FS, sets) {
  FS.mkdirTree("/dynlab/data");
  for (const [name, files] of Object.entries(sets)) {
    FS.mkdirTree("/dynlab/data/" + name);
    for (const file of files) FS.createLazyFile("/dynlab/data/" + name, file, `${folder}../data/${name}/${file}`, true, false);
  }
}

const engine = (async () => {
  const sets = await (await fetch(folder + "../data/index.json")).json();
  const module = await dynlab_engine({
    news: (json) => postMessage({ news: JSON.parse(json) }),
    locateFile: (name) => folder + name,
    preRun: [(module) => { module.ENV.DYNLAB_HOME = "/dynlab"; module.ENV.DYNLAB_NO_CACHE = "1"; }],
  });
  placeDataSets(module.FS, sets);
  module.FS.mkdirTree("/work");
  return module;
})();

const calls = {
  ready: () => true,
  run: (module, order) => module.ccall("dynlab_run", null, ["string"], [JSON.stringify(order)]),
  complete: (module, text) => JSON.parse(module.ccall("dynlab_complete", "string", ["string"], [text])),
  inspect: (module, text, cursor) => module.ccall("dynlab_inspect", "string", ["string", "number"], [text, cursor]),
  lint: (module, source, file, language) =>
    JSON.parse(module.ccall("dynlab_lint", "string", ["string", "string", "string"], [source, file, language])),
  /// A file of the reader's own, beside the script.
  put: (module, name, bytes) => module.FS.writeFile("/work/" + name, new Uint8Array(bytes)),
};

onmessage = async ({ data: { id, call, given } }) => {
  try {
    postMessage({ id, value: calls[call](await engine, ...(given ?? [])) });
  } catch (error) {
    postMessage({ id, error: String(error.message ?? error) });
  }
};
