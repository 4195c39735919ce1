// Runs a script in the engine as the worker does, under Node, and prints what the run gives as JSON: for tests.
// node tests/web/run_in_node.mjs ENGINE.js HOME SCRIPT
import { createRequire } from "node:module";
import fs from "node:fs";
import path from "node:path";
delete globalThis.fetch;  // which Emscripten 3.1.6 takes for a browser's
const [engine, home, script] = process.argv.slice(2);
const create = createRequire(import.meta.url)(path.resolve(engine));
const news = [];
const start = performance.now();
const module = await create({
  news: (json) => news.push([performance.now(), JSON.parse(json)]),
  preRun: [(m) => { m.ENV.DYNLAB_HOME = "/dynlab"; m.ENV.DYNLAB_NO_CACHE = "1"; }],
});
module.FS.mkdirTree("/script");
for (const set of fs.readdirSync(path.join(home, "data"))) {
  const folder = path.join(home, "data", set);
  if (!fs.statSync(folder).isDirectory()) continue;
  module.FS.mkdirTree("/dynlab/data/" + set);
  for (const file of fs.readdirSync(folder))
    if (file.endsWith(".csv") || file === "SOURCE.md") module.FS.writeFile(`/dynlab/data/${set}/${file}`, fs.readFileSync(path.join(folder, file)));
}
const ready = performance.now();
const source = fs.readFileSync(script, "utf8");
module.ccall("dynlab_run", null, ["string"], [JSON.stringify({ source, file: "/script/" + path.basename(script), seed: null, slider_values: {}, from: 0 })]);
const end = performance.now();
const last = news.map(([, one]) => one).filter((one) => one.results).pop();
const failed = news.map(([, one]) => one.error).filter(Boolean);
console.error(`ready ${(ready - start).toFixed(0)} ms, run ${(end - ready).toFixed(0)} ms`, failed);
console.log(JSON.stringify(last?.results ?? null));
