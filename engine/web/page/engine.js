// The engine of a page: compiled once, in a worker (engine_worker.js) that can be ended and begun again.
const here = new URL(".", import.meta.url), root = new URL("../", here);

class Engine {
  constructor() {
    Object.assign(this, { worker: null, compiled: null, waiting: new Map(), next: 0, heard: () => {} });
  }
  /// Fetched and compiled once, however many workers run it.
  async compile() {
    const address = new URL("engine/dynlab.wasm", root);
    this.data ??= fetch(new URL("data/index.json", root)).then((reply) => (reply.ok ? reply.json() : {})).catch(() => ({}));
    this.compiled ??= (async () => {
      const reply = await fetch(address);
      if (!reply.ok) throw new Error("no engine");
      const typed = reply.headers.get("Content-Type") === "application/wasm";
      return typed ? WebAssembly.compileStreaming(reply) : WebAssembly.compile(await reply.arrayBuffer());
    })();
    this.compiled.catch(() => { this.compiled = null; });
    return Promise.all([this.compiled, this.data]);
  }
  begin() {
    const begun = this.begun ??= this.start();
    begun.catch(() => { if (this.begun === begun) this.begun = null; });
    return begun;
  }
  async start() {
    const worker = this.worker ??= new Worker(new URL("engine_worker.js", here));  // it loads while the engine is compiled
    worker.onmessage = ({ data }) => this.hear(data);
    const [compiled, index] = await this.compile();
    if (this.worker !== worker) throw new Error("stopped");  // end() began another one meanwhile
    const home = new URL("engine/", root).href, address = new URL("data/", root).href;
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
    this.worker = null;
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

/// The page's one engine.
export const engine = new Engine();
