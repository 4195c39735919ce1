// The session of a page without a server: the engine runs in a worker of the page (engine_worker.js). What a document's page asks
// is answered here as engine/app/page/session.js does; results of runs come as news.
import { Lost, useSession } from "./session.js";
import { keepNote, notesOf } from "./work_store.js";

const kFolder = "/work";
const here = new URL(".", import.meta.url);

/// Throws Error with one sentence's key ("noEngine") where this browser cannot run it.
export class Engine {
  constructor(root) {
    Object.assign(this, { root, worker: null, compiled: null, waiting: new Map(), next: 0, heard: () => {} });
  }
  /// Fetched and compiled once, however many workers run it.
  async compile() {
    const address = new URL("engine/dynlab.wasm", this.root);
    this.data ??= fetch(new URL("data/index.json", this.root)).then((reply) => (reply.ok ? reply.json() : {})).catch(() => ({}));
    this.compiled ??= (async () => {
      const reply = await fetch(address);
      if (!reply.ok) throw new Lost("no engine");
      const typed = reply.headers.get("Content-Type") === "application/wasm";
      return typed ? WebAssembly.compileStreaming(reply) : WebAssembly.compile(await reply.arrayBuffer());
    })();
    this.compiled.catch(() => { this.compiled = null; });
    return Promise.all([this.compiled, this.data]);
  }
  begin() {
    this.begun ??= this.start();
    this.begun.catch(() => { this.begun = null; });
    return this.begun;
  }
  async start() {
    const [compiled, index] = await this.compile();
    this.worker = new Worker(new URL("engine_worker.js", here));
    this.worker.onmessage = ({ data }) => this.hear(data);
    const home = new URL("engine/", this.root).href, address = new URL("data/", this.root).href;
    await this.send("begin", { script: home + "dynlab.js", compiled, home, data: { index, address } });
    this.sent = null;
  }
  send(act, what) {
    const id = ++this.next;
    this.worker.postMessage({ id, act, ...what });
    return new Promise((answer, refuse) => { this.waiting.set(id, { answer, refuse }); });
  }
  hear({ id, answer, refusal, news }) {
    if (news !== undefined) return this.heard(JSON.parse(news));
    const { answer: give, refuse } = this.waiting.get(id) ?? {};
    this.waiting.delete(id);
    return refusal === undefined ? give?.(answer) : refuse?.(new Error(refusal));
  }
  async ask(act, what) {
    await this.begin();
    return this.send(act, what);
  }
  /// Nothing of it goes on. The next worker is there at once.
  end() {
    this.worker?.terminate();
    for (const { refuse } of this.waiting.values()) refuse(new Error("stopped"));
    this.waiting.clear();
    this.begun = null;
    return this.begin();
  }
}

/// Whether the browser has what the engine needs: WebAssembly with exceptions and vectors. The bytes are a module that throws
/// and one that adds two vectors.
export function canRun() {
  try {
    const throws = [0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11];
    const vectors = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];
    return [throws, vectors].every((bytes) => WebAssembly.validate(new Uint8Array(bytes)));
  } catch {
    return false;
  }
}

/// `work()` returns {name, text, language, files: [{name, text | base64}]}: the current script and its folder.
/// `news(what)`: called with news of runs and checks.
export function workerSession({ root, key, work, news }) {
  const engine = new Engine(root);
  let running = false, sliders = {}, reach = "";  // the last cell that was to run; empty: all
  engine.heard = (what) => news(what);

  async function order(act, more) {
    const { name, text, files } = work(), stamp = JSON.stringify(files);
    running = true;
    try {
      await engine.begin();
      if (engine.sent !== stamp) await engine.send("files", { folder: kFolder, files });
      engine.sent = stamp;
      await engine.send(act, { order: { source: text, file: `${kFolder}/${name}`, ...more } });
    } finally {
      running = false;
    }
  }
  const run = (more) => order("run", { seed: null, slider_values: sliders, again: "", until: "", fresh: false, ...more });
  const whenIdle = (act, what) => (running ? Promise.resolve(null) : engine.ask(act, what));

  return {
    /// Prepares the engine before the user needs it.
    prepare: () => engine.begin(),
    get running() { return running; },

    /// The cell runs, and those before it that have changed since they ran; `until`: and those behind it to this one.
    runCell(cell, until = cell) {
      reach = until;
      return run({ again: cell, until });
    },
    runAll() {
      reach = "";
      return run({ fresh: true });
    },
    /// Updates the executed part of the script for other values of its sliders.
    moveSliders(values) {
      sliders = { ...sliders, ...values };
      return run({ until: reach });
    },
    stop() {
      running = false;
      return engine.end();
    },
    /// Points of the lesson's visible checks, as news.
    check: (checks) => order("check", checks),

    complete: (text) => whenIdle("ask", { question: { question: "complete", text, cursor: 0 } }),
    help: (line, place) => whenIdle("ask", { question: { question: "help", text: line, cursor: new TextEncoder().encode(line.slice(0, place)).length } }),
    variables: () => whenIdle("ask", { question: { question: "variables", text: "", cursor: 0 } }),
    lint: async (name, text) => (await whenIdle("lint", { name, text, language: work().language })) ?? [],

    /// The bytes of the zip that is submitted.
    makePack: (files) => engine.ask("pack", { files }),
    memory: () => engine.ask("memory", {}),

    notes: () => notesOf(key),
    keepNote: (name, text) => keepNote(key, name, text),
  };
}

/// The page's session from now on.
export function openSession(how) {
  const one = workerSession(how);
  useSession(one);
  return one;
}
