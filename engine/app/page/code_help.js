// The editor's assistance while the user writes code: possible names at the cursor, the call around it, help, and
// mistakes. The session answers, from the functions and the state of the script.
import { session } from "./session.js";
import { cellAt } from "./script_mode.js";

const $ = (id) => document.getElementById(id);
const make = (name, kind = "", text = "") => Object.assign(document.createElement(name), { className: kind, textContent: text });
const kHover = 350, kLint = 250;  // ms
const kName = /[\w.:]/;

const isLua = (cm) => cm.getMode().name === "dynlab";
/// The code of the cell before the cursor; null in text, and in a comment.
function codeBefore(cm, cursor) {
  if (!isLua(cm)) return null;
  const cell = cellAt(cm, cursor.line), first = cell ? cell.first : 0;
  if (cell?.text || cursor.line < first || /\bcomment\b/.test(cm.getTokenTypeAt(cursor))) return null;
  return cm.getRange({ line: first, ch: 0 }, cursor);
}

// One question at a time and place: the list of names and the call want the same answer.
let asked = { text: null, answer: null };
function answerFor(text) {
  if (asked.text !== text) asked = { text, answer: session.complete(text).catch(() => null) };
  return asked.answer;
}
/// The script has another state: answers may be others.
export const forgetAnswers = () => { asked = { text: null, answer: null }; };

// ----- names
function drawn(node, { text }, { note }) {
  node.append(make("b", "", text), make("span", "note", note));
}
let chosen = false;  // an arrow went to a name of the list
async function names(cm) {
  const cursor = cm.getCursor(), text = codeBefore(cm, cursor);
  const answer = text === null ? null : await answerFor(text);
  const candidates = answer?.candidates ?? [];
  if (candidates.length === 0 || candidates.some((one) => one.text === answer.typed) && !names.wanted) return null;
  const from = { line: cursor.line, ch: cursor.ch - answer.typed.length };
  const list = candidates.map(({ text: name, note }) => ({ text: name, note, render: (node, data, cur) => drawn(node, cur, cur) }));
  return { list, from, to: cursor };
}
export function showNames(cm, wanted = false) {
  names.wanted = wanted;
  chosen = false;
  const move = (by) => (_, list) => { chosen = true; list.moveFocus(by); };
  cm.showHint({
    hint: names, completeSingle: wanted, closeCharacters: /[\s()[\]{};,=+\-*/]/,
    customKeys: {
      Up: move(-1), Down: move(1), PageUp: move(-8), PageDown: move(8), Esc: (_, list) => list.close(), Tab: (_, list) => list.pick(),
      // A line that is complete ends with Enter, whatever the list offers.
      Enter: (_, list) => { if (chosen || wanted) return list.pick(); list.close(); cm.execCommand("newlineAndIndent"); },
    },
  });
}

// ----- the call around the cursor
/// The signature with the argument that is being written in bold.
function signatureNode({ signature, summary, argument }) {
  const node = make("div"), open = signature.indexOf("("), pieces = [];
  let depth = 0, begin = open + 1, close = signature.length;
  for (let i = open; i < signature.length && open >= 0; ++i) {
    if ("({[".includes(signature[i])) ++depth;
    const ends = ")}]".includes(signature[i]) && --depth === 0;
    if (depth === 1 && signature[i] === "," || ends) {
      pieces.push(signature.slice(begin, i));
      begin = i + 1;
    }
    if (ends) { close = i; break; }
  }
  const current = Math.min(argument, pieces.length - 1), code = make("code");
  code.append(signature.slice(0, open + 1));
  pieces.forEach((piece, i) => code.append(i > 0 ? "," : "", i === current ? make("b", "", piece) : piece));
  code.append(signature.slice(close));
  node.append(code, make("p", "faint", summary));
  return node;
}
function placeBox(box, cm, at, above) {
  const { left, top, bottom } = cm.charCoords(at, "window");
  box.hidden = false;
  const height = box.offsetHeight, over = above ? top - height - 4 : bottom + 4;
  const shown = above && over < 40 ? bottom + 4 : !above && over + height > window.innerHeight ? Math.max(4, top - height - 4) : over;
  Object.assign(box.style, { left: `${Math.max(4, Math.min(left, window.innerWidth - box.offsetWidth - 8))}px`, top: `${shown}px` });
}
let turn = 0;
async function showCall(cm) {
  const mine = ++turn, cursor = cm.getCursor(), text = cm.hasFocus() ? codeBefore(cm, cursor) : null;
  const answer = text === null || !/[({]/.test(text) ? null : await answerFor(text);
  if (mine !== turn) return;
  $("signature").hidden = !answer?.signature;
  if (!answer?.signature) return;
  $("signature").replaceChildren(signatureNode(answer));
  placeBox($("signature"), cm, cursor, true);
}

// ----- help
let timer = 0;
const hideHelp = () => { clearTimeout(timer); $("help").hidden = true; };
async function showHelp(cm, at) {
  const line = cm.getLine(at.line), answer = await session.help(line, at.ch).catch(() => null);
  if (!answer?.text) return hideHelp();
  $("help").replaceChildren(make("pre", "", answer.text));
  $("help").scrollTop = 0;
  placeBox($("help"), cm, at, false);
}
function overName(cm, event) {
  const at = cm.coordsChar({ left: event.clientX, top: event.clientY }, "window"), line = cm.getLine(at.line) ?? "";
  const box = cm.charCoords(at, "window");
  const inside = event.clientY >= box.top && event.clientY <= box.bottom && Math.abs(event.clientX - box.left) < 20;
  const type = cm.getTokenTypeAt({ line: at.line, ch: at.ch + 1 }) ?? "";
  return inside && kName.test(line[at.ch] ?? "") && !/comment|string|number|keyword|cell|sign/.test(type) && codeBefore(cm, at) !== null ? at : null;
}

// ----- what is wrong
const kGutter = "mistakes";
function markMistake(cm, { line, column, kind, text }, marks) {
  if (line < 1 || line > cm.lineCount()) return;
  const content = cm.getLine(line - 1), begin = [...content].slice(0, column - 1).join("").length;
  const end = begin + Math.max(1, /^\w*/.exec(content.slice(begin))[0].length);
  const open = kind === "unused-answer" ? " open" : "";  // an answer that is not given yet is no mistake
  const dot = Object.assign(make("span", "mistake-dot" + open, "●"), { title: text });
  cm.setGutterMarker(line - 1, kGutter, dot);
  const range = end > content.length ? [Math.max(0, content.length - 1), content.length] : [begin, end];
  marks.push(cm.markText({ line: line - 1, ch: range[0] }, { line: line - 1, ch: range[1] }, { className: "mistake" + open, title: text }));
}

/// `open()` returns the name of the shown file, and a function that maps a line of the run's text to a line of the
/// current text. If an editor shows only a part of a file: the file's whole text, and the number of lines before the
/// part.
export function helpWithCode(cm, open) {
  let marks = [], mistakes = [], linting = 0, failure = null;  // failure: {file, line, text} of the last run
  /// Under the line at which the run stopped.
  function showFailure({ name, lineNow, before = 0 }) {
    if (failure.file !== name) return;
    const node = make("p", "failure", failure.text), line = lineNow(failure.line) - before - 1;
    if (line < 0 || line >= cm.lineCount()) return;
    const handle = cm.addLineClass(line, "wrap", "failed"), widget = cm.addLineWidget(line, node, { handleMouseEvents: true });
    marks.push({ clear() { cm.removeLineClass(handle, "wrap", "failed"); widget.clear(); } });
  }
  function tellMistake() {
    const found = mistakes.find(({ line }) => line === cm.getCursor().line + 1)?.text ?? "";
    const text = found === failure?.text ? "" : found;  // that is shown under its line
    if ($("mistake").textContent === text) return;
    $("mistake").textContent = text;
    if (cm.hasFocus()) cm.scrollIntoView(null, 24);  // the message takes a line of the editor
  }
  function clearMarks() {
    for (const mark of marks) mark.clear();
    marks = [];
    cm.clearGutter(kGutter);
  }
  function drawMarks(shown) {
    cm.operation(() => {
      clearMarks();
      for (const mistake of mistakes) markMistake(cm, mistake, marks);
      if (failure) showFailure(shown);
    });
    tellMistake();
  }
  const lint = async () => {
    const shown = open(), { name, text = cm.getValue(), before = 0 } = shown, own = cm.getValue();
    const found = name.endsWith(".lua") ? await session.lint(name, text).catch(() => []) : [];
    if (cm.getValue() !== own) return;
    mistakes = found.map((one) => ({ ...one, line: one.line - before }));
    drawMarks(shown);
  };
  const lintSoon = (delay = kLint) => { clearTimeout(linting); linting = setTimeout(lint, delay); };
  cm.on("changes", () => { hideHelp(); lintSoon(); });
  cm.on("swapDoc", () => lintSoon(0));
  cm.on("inputRead", (_, { text: [typed], origin }) => {
    if (origin === "+input" && /^[\w.:"'{]$/.test(typed)) showNames(cm);
  });
  cm.on("cursorActivity", () => { hideHelp(); showCall(cm); tellMistake(); });
  cm.on("blur", () => { ++turn; $("signature").hidden = true; });
  cm.on("scroll", () => { hideHelp(); $("signature").hidden = true; });
  const code = cm.getWrapperElement();
  code.addEventListener("mousemove", (event) => {
    clearTimeout(timer);
    if ($("help").matches(":hover")) return;
    const at = event.buttons === 0 && isLua(cm) ? overName(cm, event) : null;
    timer = setTimeout(() => (at ? showHelp(cm, at) : hideHelp()), kHover);
  });
  code.addEventListener("mouseleave", () => { clearTimeout(timer); timer = setTimeout(() => { if (!$("help").matches(":hover")) hideHelp(); }, kHover); });
  $("help").addEventListener("mouseleave", hideHelp);
  lintSoon(0);
  return {
    keys: { "Ctrl-Space": () => showNames(cm, true), F1: () => showHelp(cm, cm.getCursor()) },
    /// Before another file is shown.
    leave() {
      mistakes = [];
      clearMarks();
      hideHelp();
    },
    /// Of the last run; null where it went well.
    setFailure(error) {
      failure = error ?? null;
      drawMarks(open());
    },
  };
}
