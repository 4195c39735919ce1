// Runs a script in the engine as the worker of a page does, under Node: for tests.
// node tests/web/run_in_node.mjs ENGINE.js HOME SCRIPT [LESSON CHECKS.lua | TIMES]
// prints JSON: {results, checked, errors, ready, run: [ms], memory}; with TIMES the script runs so often.
import { createRequire } from "node:module";
import fs from "node:fs";
import path from "node:path";
delete globalThis.fetch;  // which Emscripten 3.1.6 takes for a browser's
const [engine, home, script, third, checks] = process.argv.slice(2);
const times = checks === undefined ? Number(third ?? 1) : 1;
const create = createRequire(import.meta.url)(path.resolve(engine));
const news = [];
const start = performance.now();
const module = await create({
  news: (json) => news.push(JSON.parse(json)), print: () => {}, printErr: () => {},
  preRun: [(m) => { m.ENV.DYNLAB_HOME = "/dynlab"; m.ENV.DYNLAB_NO_CACHE = "1"; }],
});
const { FS } = module;
FS.mkdirTree("/script");
for (const set of fs.readdirSync(path.join(home, "data"))) {
  const folder = path.join(home, "data", set);
  if (!fs.statSync(folder).isDirectory()) continue;
  FS.mkdirTree("/dynlab/data/" + set);
  for (const file of fs.readdirSync(folder)) FS.writeFile(`/dynlab/data/${set}/${file}`, fs.readFileSync(path.join(folder, file)));
}
const ready = performance.now() - start;
const source = fs.readFileSync(script, "utf8"), file = "/script/" + path.basename(script), run = [];
for (let i = 0; i < times; ++i) {
  news.length = 0;
  const before = performance.now();
  const order = JSON.stringify({ source, file, seed: null, slider_values: {}, again: "", until: "", fresh: true });
  if (module.ccall("dynlab_begin_run", "number", ["string", "boolean"], [order, false])) while (module.ccall("dynlab_run_part", "number", [], [])) ;
  run.push(performance.now() - before);
}
if (checks !== undefined) {
  const text = fs.readFileSync(checks, "utf8");
  module.ccall("dynlab_check", null, ["string"], [JSON.stringify({ source, file, lesson: third, checks: text, authors: "" })]);
}
console.log(JSON.stringify({ results: news.filter((one) => one.results).pop()?.results ?? null, checked: news.find(({ kind }) => kind === "checked") ?? null,
                             errors: news.map(({ error }) => error).filter(Boolean), ready, run, memory: module.HEAPU8.length }));
