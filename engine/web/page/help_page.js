// Examples of a help page: each can be changed and run. The engine is loaded when the user runs the first one.
import { cellEditor } from "./cell_editor.js";
import { showResults, takeFigures } from "./cell_results.js";
import { loadCodeMirror } from "./code_mirror.js";
import { canRun } from "./engine.js";
import { cellIds } from "./lesson_script.js";
import "./page_words.js";
import { defineScriptMode } from "./script_mode.js";
import { useSession } from "./session.js";
import { say } from "./site_words.js";
import { openSession } from "./worker_session.js";

const kName = "example.lua";
const make = (name, kind = "", text = "") => Object.assign(document.createElement(name), { className: kind, textContent: text });
const root = new URL(document.documentElement.dataset.root ?? "../", location.href);
let session = null, current = null, running = false;

class Example {
  constructor(node) {
    this.text = node.textContent.replace(/\n$/, "");
    this.box = make("section", "cell example-cell");
    this.results = make("div", "results");
    this.state = make("span", "faint");
    this.state.setAttribute("role", "status");
    this.runButton = Object.assign(make("button", "run-example", say("runExample")), { type: "button", onclick: () => this.run() });
    this.stopButton = Object.assign(make("button", "stop-example", say("stopRun")), { type: "button", hidden: true, onclick: () => session.stop() });
    const bar = make("div", "cell-bar"), holder = make("div", "cell-code");
    bar.append(this.runButton, this.stopButton, this.state);
    this.box.append(bar, holder, this.results);
    node.replaceWith(this.box);
    this.editor = cellEditor(holder, this.text, {
      label: say("codeOf", kName), change: (text) => { this.text = text; this.results.classList.add("stale"); }, run: () => this.run(),
      where: () => ({ name: kName }), enter: () => this.box.append(mistake),
    });
  }
  async run() {
    if (running) return;
    running = true;
    current = this;
    this.editor.setFailure(null);
    this.stopButton.hidden = false;
    this.state.textContent = say(session.begun ? "runningCell" : "engineLoads", kName);
    try {
      await session.runAll();
      session.begun = true;
      this.state.textContent = "";
    } catch (error) {
      this.state.textContent = error.message === "stopped" ? say("runStopped") : say("engineLost");
    }
    this.stopButton.hidden = true;
    running = false;
  }
  hear({ kind, results, figures, error }) {
    if (kind === "failed") return showResults(this.results, [], null, error.text);
    if (kind !== "done") return;
    takeFigures(figures);
    const code = cellIds(`-- %%\n${this.text}`);
    showResults(this.results, Object.keys(results.outputs).length ? Object.keys(results.outputs) : code, results, error?.text);
    // Figures of a report have no text here that shows them.
    for (const name of Object.keys(results.figures)) {
      if (this.results.querySelector(`figure[data-figure="${CSS.escape(name)}"]`)) continue;
      const box = make("div");
      this.results.append(box);
      showResults(box, ["_"], { outputs: { _: [{ figure: name }] } });
    }
    if (error) this.editor.setFailure({ file: kName, line: error.line, text: error.text });
  }
}
const mistake = Object.assign(make("p"), { id: "mistake" });

const nodes = [...document.querySelectorAll("pre.example[data-run]")];
if (nodes.length > 0 && canRun()) {
  session = openSession({ key: `${root.pathname} help`, news: (news) => current?.hear(news),
    work: () => ({ name: kName, text: current?.text ?? "", language: document.documentElement.lang, files: [] }) });
  for (const id of ["signature", "help"]) document.body.append(Object.assign(make("div"), { id, hidden: true }));
  document.body.append(mistake);
  // An editor asks for help only once the engine is there.
  const { complete, help, lint } = session, once = (ask, none) => (...given) => (session.begun ? ask(...given) : Promise.resolve(none));
  useSession({ complete: once(complete, null), help: once(help, null), lint: once(lint, []) });
  if (await loadCodeMirror()) defineScriptMode();
  nodes.forEach((node) => new Example(node));
}
