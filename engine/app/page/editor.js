// The document's files beside the page, where it may change them. What is saved says what it was made from: a file that
// was changed elsewhere meanwhile is not written over, both texts are shown.
import { forgetAnswers, helpWithCode } from "./code_help.js";
import { loadCodeMirror } from "./code_mirror.js";
import { draftsOf, forget, keepDraft, keepDraftSoon, setAside, wordsOf } from "./drafts.js";
import { noteOf, readNotes, setNote } from "./notes.js";
import { inEnglish, say } from "./page_words.js";
import { cellAt, cellsOf, defineScriptMode, newLine, outlineOf } from "./script_mode.js";
import { Lost, session } from "./session.js";
import { showTextCells } from "./text_cells.js";
import { beginVariables, followVariables } from "./variables.js";

const $ = (id) => document.getElementById(id);
const sources = new Map();  // number -> {number, name, place, digest, saved, doc, tab, theirs, drafts, key}
const kPhrases = ["search", "asPattern", "replace", "replaceAll", "replaceWith", "replaceBy", "replaceIt", "yes", "no", "all", "stop"];  // CodeMirror's
let open = null;            // the one that is shown
let mirror = null;          // CodeMirror, where it is installed
let code = null;            // its help (code_help.js)
let refreshCells = () => {};
let followCursor = () => {}, piecesOf = () => [];

/// A plain field of text with what is used of CodeMirror, for machines without it.
class PlainDoc {
  constructor(text) { this.text = text; this.line = 0; }
  getValue() { return this.text; }
  setValue(text) { this.text = text; if (open?.doc === this) $("field").value = text; }
  getCursor() { return { line: this.line }; }
  setCursor(line) {
    this.line = line;
    if (open?.doc !== this) return;
    const field = $("field"), lines = this.text.split("\n");
    const place = lines.slice(0, line).join("\n").length + (line > 0 ? 1 : 0);
    field.focus();
    field.setSelectionRange(place, place);
    field.scrollTop = (line / lines.length) * field.scrollHeight - field.clientHeight / 2;
  }
}

/// Where two texts differ: how many lines are the same at the beginning and at the end.
function commonLines(a, b) {
  let first = 0, last = 0;
  while (first < a.length && first < b.length && a[first] === b[first]) ++first;
  while (last < a.length - first && last < b.length - first && a[a.length - 1 - last] === b[b.length - 1 - last]) ++last;
  return { first, last };
}

/// The line of `to` that is line `line` of `from`, where lines were put in or taken out between.
function lineIn(to, from, line) {
  const a = from.split("\n"), b = to.split("\n"), { first } = commonLines(a, b);
  return line <= first ? line : Math.max(1, line + b.length - a.length);
}

/// The lines of `a` that are also in `b`, in the same order: a longest common subsequence, by dynamic programming. If
/// that would take too long, only the common lines at the beginning and the end.
function keptLines(a, b) {
  const { first, last } = commonLines(a, b), rows = a.length - first - last, columns = b.length - first - last;
  const kept = a.map((_, i) => i < first || i >= a.length - last);
  if (rows * columns > 4e6) return kept;
  const length = Array.from({ length: rows + 1 }, () => new Uint16Array(columns + 1));
  for (let i = rows - 1; i >= 0; --i)
    for (let j = columns - 1; j >= 0; --j)
      length[i][j] = a[first + i] === b[first + j] ? length[i + 1][j + 1] + 1 : Math.max(length[i + 1][j], length[i][j + 1]);
  for (let i = 0, j = 0; i < rows && j < columns;) {
    if (a[first + i] === b[first + j]) kept[first + i] = true, ++i, ++j;
    else if (length[i + 1][j] >= length[i][j + 1]) ++i;
    else ++j;
  }
  return kept;
}

/// The lines of a text that another has not, with their numbers and a line before and behind; where it only lacks lines, the
/// one before them.
function otherLines(text, own) {
  const theirs = text.split("\n"), mine = own.split("\n"), kept = keptLines(theirs, mine);
  const near = theirs.map((_, i) => !kept[i] || kept[i - 1] === false || kept[i + 1] === false);
  const lines = [], width = String(theirs.length).length;
  for (const [i, line] of theirs.entries()) {
    if (!near[i]) continue;
    if (lines.length > 0 && !near[i - 1]) lines.push("  …");
    lines.push(`${kept[i] ? " " : "›"} ${String(i + 1).padStart(width)}  ${line}`);
  }
  if (lines.length > 0) return lines.join("\n");
  const { first } = commonLines(theirs, mine);
  return `  ${first}  ${theirs[first - 1] ?? ""}\n› ${say("notInIt")}`;
}

/// CodeMirror knows one line end only; a file keeps its own.
const unix = (text) => text.replace(/\r\n?/g, "\n");
const isChanged = (source) => source.doc.getValue() !== source.saved;

function showMarks() {
  for (const source of sources.values()) {
    const dirty = isChanged(source), [draft] = source.drafts;
    source.tab.textContent = source.name + (dirty || draft ? " •" : "");
    source.tab.title = dirty ? say("notYet") : draft ? wordsOf(draft) : "";
    source.tab.setAttribute("aria-selected", String(source === open));
  }
  $("save").disabled = !open || !isChanged(open);
  const offered = open?.drafts[0];
  $("draft").hidden = !offered;
  if (offered) $("draft-text").textContent = wordsOf(offered);
  const theirs = open?.theirs;
  $("conflict").hidden = !theirs;
  if (theirs) {
    $("conflict-name").textContent = open.name;
    $("theirs").textContent = otherLines(theirs.text, open.doc.getValue());
  }
}

const phrases = () => Object.fromEntries(kPhrases.map((key) => [inEnglish(key), say(key)]));
/// The page's language is another now.
export function speak() {
  mirror?.setOption("phrases", phrases());
  showMarks();
}

function show(source) {
  open = source;
  code?.leave();
  if (mirror) mirror.swapDoc(source.doc);
  if (mirror && !source.seen && source.name.endsWith(".lua")) mirror.foldCode(0);
  source.seen = true;
  if (!mirror) $("field").value = source.doc.getValue();
  showMarks();
  showOutline();
}

/// Headings and questions of the script that is shown.
function showOutline() {
  const found = mirror && open?.name.endsWith(".lua") ? outlineOf(mirror) : [], list = $("outline");
  const text = JSON.stringify(found);
  list.hidden = found.length === 0;
  if (list.dataset.shown === text) return;
  list.dataset.shown = text;
  const option = ({ line, level, words }) => Object.assign(document.createElement("option"), {
    value: line, textContent: "\u2003".repeat(level === 7 ? 1 : level - 1) + words.replace(/[`*]|\\?\$/g, "") });
  list.replaceChildren(Object.assign(document.createElement("option"), { value: "", textContent: "☰" }), ...found.map(option));
}

const kHistory = 40_000;  // letters of what can be undone that are kept
const historyOf = (source) => `dynlab-undo ${source.place}`;
/// What was typed can be undone after the page was closed, while the file stays as it is.
function keepHistory(source) {
  if (!mirror || isChanged(source)) return;
  const history = source.doc.getHistory();
  const kept = () => JSON.stringify({ digest: source.digest, history });
  while (history.done.length > 0 && kept().length > kHistory) history.done.splice(0, Math.ceil(history.done.length / 4));
  if (history.done.length > 0) setNote(historyOf(source), kept());
}
function restoreHistory(source) {
  try {
    const { digest, history } = JSON.parse(noteOf(historyOf(source)));
    if (digest === source.digest) source.doc.setHistory(history);
  } catch { /* none is kept */ }
}

const pause = (ms) => new Promise((yes) => { setTimeout(yes, ms); });
/// The cell at a line runs, and what is behind it; with `only`, the cells up to it that have changed. The text is saved before.
async function runCell(line, only = false) {
  const source = open;
  while (source.saving) await pause(5);
  await save(source, { line, only });
}
function runHere(moveOn) {
  const cell = open.name.endsWith(".lua") && cellAt(mirror, mirror.getCursor().line);
  if (!cell) return save(open);
  const next = moveOn && cellsOf(mirror).find(({ marker }) => marker > cell.marker);
  if (next) mirror.setCursor(next.first, 0);
  if (next) mirror.scrollIntoView({ from: { line: next.marker, ch: 0 }, to: { line: next.last, ch: 0 } }, 40);
  return cell.text ? save(open) : runCell(cell.first);
}
function runAbove() {
  const above = open.name.endsWith(".lua") ? cellsOf(mirror).filter(({ marker, text }) => !text && marker < (cellAt(mirror, mirror.getCursor().line)?.marker ?? 0)) : [];
  if (above.length > 0) runCell(above[above.length - 1].first, true);
}

function add({ number, name, place, text, digest }) {
  const tab = document.createElement("button");
  tab.setAttribute("role", "tab");
  const mode = name.endsWith(".lua") ? "dynlab" : name.endsWith(".md") ? "markdown" : null;
  const plain = unix(text);
  const doc = mirror ? window.CodeMirror.Doc(plain, mode) : new PlainDoc(plain);
  const source = { number, name, place, digest, saved: plain, crlf: text.includes("\r\n"), doc, tab, theirs: null, saves: 0 };
  source.drafts = draftsOf(source);
  if (mirror) restoreHistory(source);
  tab.onclick = () => show(source);
  $("tabs").append(tab);
  sources.set(number, source);
}

/// The file is another now than the one that was read here.
function meet(source, theirs) {
  if (theirs.digest === source.digest) return;
  theirs = { ...theirs, text: unix(theirs.text) };
  if (theirs.text === source.doc.getValue() || !isChanged(source)) {
    const line = source.doc.getCursor().line;
    source.digest = theirs.digest;
    source.saved = theirs.text;
    source.theirs = null;
    if (theirs.text !== source.doc.getValue()) {
      source.doc.setValue(theirs.text);
      if (source === open && mirror) source.doc.setCursor(line);
    }
    keepDraft(source);
  } else {
    source.theirs = theirs;
  }
  showMarks();
}

/// The draft takes the text's place; what was typed there is offered in its turn. Where the draft was made from another text
/// than the file's, both are shown.
function takeDraft(source) {
  const draft = source.drafts.shift(), { text, digest } = draft, file = source.theirs ?? { digest: source.digest, text: source.saved };
  if (isChanged(source)) setAside(source);
  const clean = file.digest === digest || file.text === text;
  Object.assign(source, { digest: clean ? file.digest : digest, saved: file.text, theirs: clean ? null : file });
  source.doc.setValue(text);
  keepDraft(source).then((kept) => kept && forget(draft));
  showMarks();
}

function dropDraft(source) {
  forget(source.drafts.shift());
  showMarks();
}

/// One save of a file at a time: the next says what it was made from only when the one before has been answered.
async function save(source, place = null) {
  if (!source || !isChanged(source) && !place) return;
  if (source.saving) {
    source.again = true;
    return;
  }
  source.saving = true;
  source.again = false;
  const text = source.doc.getValue(), written = source.crlf ? text.replace(/\n/g, "\r\n") : text;
  try {
    const asked = { number: source.number, name: source.name, text: written, digest: source.digest }, changed = isChanged(source);
    const outcome = place ? await session.runCell(source.name, place.line + 1, place.only, changed ? asked : undefined) : await session.save(asked);
    const { now } = outcome;
    if (outcome.written && !changed) {
      // it runs as it is
    } else if (!outcome.written) {
      source.digest = "";
      meet(source, now);
    } else {
      source.digest = now.digest;
      source.saved = text;
      source.theirs = null;
      keepDraft(source);
      clearTimeout(source.keeping);
      source.keeping = setTimeout(() => keepHistory(source), 2000);
    }
    $("trouble").textContent = "";
  } catch (error) {
    $("trouble").textContent = say("notSaved", error instanceof Lost ? say("lost") : error.message);
    source.again = false;
  }
  source.saving = false;
  ++source.saves;
  showMarks();
  if (source.again && !source.theirs) save(source);
}

function onChange() {
  showMarks();
  showOutline();
  const source = open;
  if (!source) return;
  keepDraftSoon(source);
  clearTimeout(source.timer);
  if ($("at-once").checked) source.timer = setTimeout(() => save(source), 300);
}

export const hasUnsaved = () => [...sources.values()].some(isChanged);

/// Whether every file has its text then.
export async function saveAll() {
  await Promise.all([...sources.values()].map(save));
  return !hasUnsaved();
}

async function begin() {
  if (await loadCodeMirror()) defineScriptMode();
  await readNotes();
  document.body.classList.add("editing");
  if (window.CodeMirror) {
    const lineNow = (line) => lineIn(open.doc.getValue(), open.saved, line);
    let helped = {};
    const ask = (key) => () => helped[key]?.();
    const keys = { Enter: newLine, "Ctrl-Space": ask("Ctrl-Space"), F1: ask("F1"), "Shift-Enter": () => { runHere(true); }, "Ctrl-Enter": () => { runHere(false); },
                   "Ctrl-/": "toggleComment", "Cmd-/": "toggleComment", "Ctrl-S": () => save(open), "Cmd-S": () => save(open), Esc: () => $("bar").querySelector("button:not([hidden])").focus() };
    const typing = { ...keys, Tab: (cm) => cm.execCommand(cm.somethingSelected() ? "indentMore" : "insertSoftTab"), "Shift-Tab": "indentLess" };
    const passing = { ...keys, Tab: false, "Shift-Tab": false };  // who comes by the keyboard goes on by it
    mirror = window.CodeMirror($("code"), { lineNumbers: true, lineWrapping: true, indentUnit: 2, tabSize: 2, extraKeys: passing,
      phrases: phrases(), continueComments: { key: "Enter", continueLineComment: true }, matchBrackets: true, foldGutter: true,
      gutters: ["mistakes", "cells", "CodeMirror-linenumbers", "CodeMirror-foldgutter"] });
    $("field").remove();
    code = helpWithCode(mirror, () => ({ name: open?.name ?? "", lineNow }));
    helped = code.keys;
    refreshCells = showTextCells(mirror, () => open && open.name.endsWith(".lua") && !isChanged(open)
      ? { pieces: (first, last) => piecesOf(open.name, first, last), run: (line) => runCell(line) } : null);
    $("run-cell").onclick = () => runHere(false);
    $("run-above").onclick = runAbove;
    $("find").onclick = () => mirror.execCommand("replace");
    $("outline").onchange = () => {
      const line = Number($("outline").value);
      if ($("outline").value !== "") goTo(open.name, lineIn(open.saved, open.doc.getValue(), line + 1));
      $("outline").value = "";
    };
    window.addEventListener("pagehide", () => { for (const source of sources.values()) keepHistory(source); });
    mirror.on("changes", (cm, changes) => {
      if (changes.some(({ origin }) => origin !== "setValue")) mirror.setOption("extraKeys", typing);
      onChange();
    });
    mirror.on("mousedown", () => mirror.setOption("extraKeys", typing));
    mirror.on("blur", () => mirror.setOption("extraKeys", passing));
    const tell = () => followCursor(open.name, lineIn(open.saved, open.doc.getValue(), mirror.getCursor().line + 1));
    mirror.on("cursorActivity", () => { if (mirror.hasFocus()) tell(); });
    mirror.on("focus", tell);
  } else {
    const field = $("field");
    field.hidden = false;
    field.oninput = () => { open.doc.text = field.value; onChange(); };
    field.onkeyup = field.onclick = () => {
      open.doc.line = field.value.slice(0, field.selectionStart).split("\n").length - 1;
      followCursor(open.name, open.doc.line + 1);
    };
  }
  $("save").onclick = () => save(open);
  $("take-theirs").onclick = () => {
    const { theirs } = open, line = lineIn(theirs.text, open.doc.getValue(), open.doc.getCursor().line + 1);
    open.doc.setValue(theirs.text);
    open.doc.setCursor(line - 1, 0);
    Object.assign(open, { digest: theirs.digest, saved: theirs.text, theirs: null });
    keepDraft(open);
    showMarks();
  };
  $("keep-mine").onclick = () => {
    Object.assign(open, { digest: open.theirs.digest, saved: open.theirs.text, theirs: null });
    save(open);
  };
  $("take-draft").onclick = () => takeDraft(open);
  $("drop-draft").onclick = () => dropDraft(open);
  beginVariables();
  $("at-once").checked = noteOf("at-once") === "yes";
  $("at-once").onchange = () => {
    setNote("at-once", $("at-once").checked ? "yes" : "");
    onChange();
  };
  window.addEventListener("beforeunload", (event) => {
    if (hasUnsaved()) event.preventDefault();
  });
  document.addEventListener("keydown", (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key === "s" && !event.defaultPrevented) {
      event.preventDefault();
      save(open);
    }
  });
}

let beginning = null;

/// The digests of the files as they are on disk: reads those that are new.
export async function follow(digests, ways) {
  followCursor = ways.showLine;
  piecesOf = ways.piecesOf;
  if (Object.keys(digests).length === 0) return;
  beginning ??= begin();
  await beginning;
  const known = Object.entries(digests).every(([number, digest]) => {
    const source = sources.get(Number(number));
    return source && (source.digest === digest || source.theirs?.digest === digest);
  });
  if (known) return;
  const saves = new Map([...sources].map(([number, source]) => [number, source.saves]));
  const texts = await session.sources().catch(() => []);
  for (const text of texts) {
    const source = sources.get(text.number);
    if (source && (source.saving || source.saves !== saves.get(text.number))) continue;  // it is older than what was saved
    if (source) meet(source, text);
    else add(text);
  }
  const all = [...sources.values()];
  if (!open && all.length > 0) show(all.find(({ drafts }) => drafts.length > 0) ?? all[0]);
}

/// What the page shows is new; `error`: {file, line, text} at which the run stopped.
export function tell(error) {
  if (!beginning) return;
  forgetAnswers();
  followVariables();
  refreshCells();
  if (JSON.stringify(error) === toldError) return;
  toldError = JSON.stringify(error);
  beginning.then(() => code?.setFailure(error));
}
let toldError = JSON.stringify(null);

/// Puts the cursor on a line of a file, where the page may change it.
export function goTo(file, line) {
  for (const source of sources.values()) {
    if (source.name !== file) continue;
    if (source !== open) show(source);
    line = lineIn(source.doc.getValue(), source.saved, line);
    source.doc.setCursor(line - 1, 0);
    if (mirror) {
      mirror.scrollIntoView({ line: line - 1, ch: 0 }, 120);
      mirror.focus();
    }
    return true;
  }
  return false;
}
