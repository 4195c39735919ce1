// The session of a page without a server: the engine runs in a worker of the page (engine_worker.js). What a document's page asks
// is answered here as engine/app/page/session.js does; results of runs come as news.
import { engine } from "./engine.js";
import { useSession } from "./session.js";
import { keepNote, notesOf } from "./work_store.js";

const kFolder = "/work";
/// `work()` returns {name, text, language, files: [{name, text | base64}]}: the current script and its folder.
/// `news(what)`: called with news of runs and checks.
export function workerSession({ key, work, news }) {
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
