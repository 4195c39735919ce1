// The editor of one code cell of a page: CodeMirror, with the help for code of the live page; a plain field where it is missing.
import { helpWithCode } from "./code_help.js";

const kPlain = "cell-field";

function field(holder, text, { change, run, label }) {
  const node = Object.assign(document.createElement("textarea"), { className: kPlain, value: text, spellcheck: false, rows: text.split("\n").length });
  node.setAttribute("aria-label", label);
  node.oninput = () => { node.rows = node.value.split("\n").length; change(node.value); };
  node.onkeydown = (event) => {
    if (event.key !== "Enter" || !(event.shiftKey || event.ctrlKey)) return;
    event.preventDefault();
    run(event.shiftKey);
  };
  holder.replaceChildren(node);
  return { get text() { return node.value; }, set text(now) { node.value = now; }, focus: () => node.focus(), refresh() {}, setFailure() {},
           set readOnly(on) { node.readOnly = on; } };
}

/// `how`: change(text), run(move to the next cell), label, and where() that gives {name, text, before} as code_help.js asks it.
export function cellEditor(holder, text, how) {
  const { CodeMirror } = window;
  if (!CodeMirror) return field(holder, text, how);
  holder.replaceChildren();
  let helped = {};
  const ask = (key) => () => helped[key]?.();
  const keys = { "Ctrl-Space": ask("Ctrl-Space"), F1: ask("F1"), "Shift-Enter": () => { how.run(true); }, "Ctrl-Enter": () => { how.run(false); },
                 "Cmd-Enter": () => { how.run(false); }, "Ctrl-/": "toggleComment", "Cmd-/": "toggleComment", Esc: (cm) => cm.getInputField().blur() };
  const typing = { ...keys, Tab: (cm) => cm.execCommand(cm.somethingSelected() ? "indentMore" : "insertSoftTab"), "Shift-Tab": "indentLess" };
  const passing = { ...keys, Tab: false, "Shift-Tab": false };  // who comes by the keyboard goes on by it
  const cm = CodeMirror(holder, { value: text, mode: "dynlab", lineWrapping: true, indentUnit: 2, tabSize: 2, extraKeys: passing, matchBrackets: true,
    continueComments: { key: "Enter", continueLineComment: true }, gutters: ["mistakes"], viewportMargin: Infinity });
  cm.getInputField().setAttribute("aria-label", how.label);
  const code = helpWithCode(cm, () => ({ lineNow: (line) => line, ...how.where() }));
  helped = code.keys;
  let quiet = false;
  cm.on("changes", () => {
    if (quiet) return;
    cm.setOption("extraKeys", typing);
    how.change(cm.getValue());
  });
  cm.on("mousedown", () => cm.setOption("extraKeys", typing));
  cm.on("blur", () => cm.setOption("extraKeys", passing));
  cm.on("focus", () => how.enter?.());
  return {
    get text() { return cm.getValue(); },
    set text(now) {
      if (now === cm.getValue()) return;
      quiet = true;
      cm.setValue(now);
      quiet = false;
    },
    focus() { cm.focus(); },
    refresh() { cm.refresh(); },
    setFailure(error) { code.setFailure(error); },
    set readOnly(on) { cm.setOption("readOnly", on); },
  };
}
