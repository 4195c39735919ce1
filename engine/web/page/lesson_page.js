// A lesson of a site: its cells run here, in the browser. The page is whole without this script; what it cannot do it says in one sentence
// above the text.
import { takeFigures, showInText, slidersOf } from "./cell_results.js";
import { forgetAnswers } from "./code_help.js";
import { loadCodeMirror } from "./code_mirror.js";
import { canRun } from "./engine.js";
import { cellsOfPage } from "./lesson_cells.js";
import { placeHints, showChecks, submit } from "./lesson_checks.js";
import { download, LessonWork } from "./lesson_work.js";
import { blocksOf } from "./markdown_text.js";
import "./page_words.js";
import { defineScriptMode } from "./script_mode.js";
import { useSession } from "./session.js";
import { number, say } from "./site_words.js";
import { controlsByCell } from "./sliders.js";
import { openSession } from "./worker_session.js";

const main = document.getElementById("lesson"), { lesson: lessonName, file: scriptName, language } = main.dataset;
const root = new URL(main.dataset.root, location.href), address = new URL(".", location.href);
const make = (name, kind = "", text = "") => Object.assign(document.createElement(name), { className: kind, textContent: text });
let work = null, session = null, cells = { all: [], code: [] };
let results = null, stopped = false, ran = new Map(), error = null;

// ----- above the text
const bar = make("div"), state = make("span", "", say("engineLoads")), notices = make("div"), panel = make("section");
Object.assign(bar, { id: "lesson-bar" });
Object.assign(state, { id: "lesson-state" });
Object.assign(panel, { id: "lesson-panel", hidden: true, tabIndex: -1 });
notices.id = "lesson-notices";
bar.setAttribute("role", "toolbar");
bar.setAttribute("aria-label", say("lessonBar"));
state.setAttribute("role", "status");
panel.setAttribute("aria-live", "polite");
function button(key, act, id) {
  const node = Object.assign(make("button", "", say(key)), { type: "button", id, onclick: act });
  return node;
}
const runAllButton = button("runEverything", () => runAll(), "lesson-run"), stopButton = button("stopRun", () => stop(), "lesson-stop");
const checkButton = button("checkWork", () => check(), "lesson-check"), submitButton = button("submitWork", () => makePack(), "lesson-submit");

/// A sentence with buttons, by the name of what it is about; an empty text takes it away.
function notice(name, text, buttons = []) {
  notices.querySelector(`[data-name="${name}"]`)?.remove();
  if (!text) return;
  const node = make("p", "lesson-notice");
  node.dataset.name = name;
  node.setAttribute("role", "alert");
  node.append(text, ...buttons.flatMap((one) => [" ", one]));
  notices.append(node);
}
function tell(...nodes) {
  panel.hidden = nodes.length === 0;
  panel.replaceChildren(...nodes);
}

// ----- the run
const cellOf = (id) => cells.code.find((cell) => cell.id === id) ?? null;
/// The page's cell that shows the results of a part's cells: results of cells that the user added belong to the
/// previous cell.
function showPart(ids, text) {
  let cell = null;
  for (const id of ids) cell = cellOf(id) ?? cell ?? lastShown;
  lastShown = cell;
  return { cell, text };
}
let lastShown = null;

const heard = {
  begun({ cells: ids }) {
    const { cell } = showPart(ids);
    cell?.setState("running");
    state.textContent = say("runningCell", cell?.id ?? ids[0] ?? "");
  },
  progress({ cells: ids, progress }) {
    if (ids.length === 0) return;
    const cell = cellOf(ids.at(-1));
    cell?.setState("running", progress);
    state.textContent = say("runningPart", cell?.id ?? ids[0], Math.floor(100 * progress));
  },
  done({ cells: ids, seconds, results: now, figures, error: failure }) {
    results = now;
    takeFigures(figures);
    const { cell } = showPart(ids);
    if (cell) {
      const known = ids.filter((id) => !cellOf(id) || cellOf(id) === cell);
      cell.shownIds = [...new Set([...(cell.ids.filter((id) => ids.includes(id) || cell.shownIds?.includes(id))), ...known])];
      cell.show(results, failure && (cell.isHidden || cellWithLine(failure.line) !== cell) ? failure.text : "");
      cell.setState(failure ? "failed" : "done");
      for (const id of ids) if (cellOf(id) && cellOf(id) !== cell) { cellOf(id).show(results); cellOf(id).setState(failure ? "failed" : "done"); }
      ran.set(cell.id, seconds);
    }
    showInText(main, results);
    placeSliders(true);
    setError(failure ?? null);
  },
  ended() {
    forgetAnswers();
    placeSliders(false);
    const seconds = [...ran.values()].reduce((sum, one) => sum + one, 0);
    if (!error) state.textContent = say("ranCells", ran.size, number(seconds.toFixed(seconds < 0.1 ? 2 : 1)));
  },
  failed({ error: failure }) { setError(failure); },
  checked(news) {
    showChecks(panel, news);
    panel.hidden = false;
    panel.focus();
  },
};

/// The cell in whose code a line of the script is.
function cellWithLine(number) {
  const place = number > 0 ? work.composed.first.findLastIndex((line) => line <= number) : -1;
  return cells.code.find((one) => one.place === place) ?? null;
}
function setError(failure) {
  error = failure;
  const told = failure && { file: scriptName, line: failure.line, text: failure.text };
  for (const cell of cells.code) cell.editor.setFailure(null);
  if (!failure) return;
  state.textContent = say("runFailed");
  cellWithLine(failure.line)?.editor.setFailure(told);
  if (failure.line === 0 && !lastShown) notice("error", failure.text);
}

function placeSliders(running) {
  for (const [id, controls] of controlsByCell(slidersOf(results), running)) {
    const cell = cellOf(id);
    if (!cell) continue;
    let behind = cell.results;
    for (const control of controls) {
      if (behind.nextElementSibling !== control) behind.after(control);
      behind = control;
    }
  }
}

// One run at a time; what is asked for meanwhile runs next, the newest only.
let under = null, next = null;
async function start(act) {
  if (work.shared) return;
  if (under) { next = act; return; }
  stopped = false;
  notice("error", "");
  bar.classList.add("running");
  stopButton.disabled = false;
  under = act;
  try {
    await act();
  } catch (failure) {
    if (!stopped) notice("error", failure.message === "no engine" || /fetch/i.test(failure.message) ? say("engineLost") : failure.message);
  }
  under = null;
  bar.classList.remove("running");
  stopButton.disabled = true;
  for (const cell of cells.code) if (cell.node.dataset.state === "running" || cell.node.dataset.state === "waiting") cell.setState("");
  const then = next;
  next = null;
  if (then) await start(then);
}
function run(cell, moveOn = false) {
  const following = cells.code[cells.code.indexOf(cell) + 1];
  if (moveOn && following) {
    following.editor.focus();
    following.node.scrollIntoView({ block: "nearest", behavior: "auto" });
  }
  lastShown = null;
  return start(() => session.runCell(cell.id, cell.ids.at(-1)));
}
function runAll() {
  ran = new Map();
  lastShown = null;
  for (const cell of cells.code) cell.setState("waiting");
  return start(() => session.runAll());
}
async function stop() {
  stopped = true;
  next = null;
  await session.stop();
  state.textContent = say("runStopped");
}

// ----- checks, pack
function check() {
  const { checks } = work.description, authors = checks[`checks.${language}.po`] ?? "";
  if (!checks["checks.lua"]) return tell(make("p", "", say("noChecks")));
  tell(make("p", "", say("checksRun")));
  return start(() => session.check({ lesson: lessonName, checks: checks["checks.lua"], authors }));
}
async function makePack() {
  await work.store();
  try {
    const { lines } = await submit(session, work);
    tell(...lines.map((line) => make("p", "pack-line", line)), make("p", "faint", say("packMissing")));
  } catch (failure) {
    tell(make("p", "trouble", failure.message));
  }
  panel.focus();
}

// ----- the work
function redrawAll() {
  for (const cell of cells.all) cell.renew();
  showReadOnly();
}
function showReadOnly() {
  const locked = !work.writer.writes || work.shared !== null;
  for (const cell of cells.all) cell.readOnly = locked;
  for (const node of [runAllButton, checkButton, submitButton, ...cells.code.map((cell) => cell.runButton)]) node.disabled = work.shared !== null;
  const here = Object.assign(make("button", "", say("editHere")), { type: "button", onclick: () => { work.writer.take(); } });
  notice("tab", work.writer.writes ? "" : say("otherTab"), [here]);
}
function showKept(kept) { notice("kept", kept ? "" : say("notKept")); }
function exportScript(text = work.composed.text) { download(scriptName, text); }
async function importScript(file) {
  const limit = LessonWork.mostMegabytes;
  const trouble = file.size > limit << 20 ? "tooLarge" : work.takeScript(await file.text());
  notice("work", say(trouble || "imported", limit));
  if (!trouble) redrawAll();
}
async function copyLink() {
  const link = await work.link();
  try {
    await navigator.clipboard.writeText(link);
    notice("work", say("linkCopied"));
  } catch {
    const field = Object.assign(make("input", "link-field"), { value: link, readOnly: true });
    field.setAttribute("aria-label", say("linkShown"));
    notice("work", say("linkShown"), [field]);
    field.select();
  }
}
function workMenu() {
  const menu = make("details", "work-menu"), list = make("div", "work-list"), chooser = Object.assign(make("input"), { type: "file", accept: ".lua,text/plain", hidden: true });
  const entry = (key, act, id) => button(key, () => { menu.open = false; act(); }, id);
  chooser.onchange = async () => {
    if (chooser.files[0]) await importScript(chooser.files[0]);
    chooser.value = "";
  };
  list.append(entry("exportWork", () => exportScript(), "work-export"), entry("importWork", () => chooser.click(), "work-import"), entry("shareWork", copyLink, "work-link"),
              entry("resetWork", () => { if (confirm(say("resetSure"))) { work.reset(); redrawAll(); } }, "work-reset"), chooser);
  menu.append(make("summary", "", say("workMenu")), list);
  menu.addEventListener("keydown", (event) => { if (event.key === "Escape") menu.open = false; });
  return menu;
}
/// report.md and the like, to be written in plain fields.
function otherFiles() {
  const box = make("details", "other-files");
  box.append(make("summary", "", say("otherFiles")));
  for (const file of work.others.filter(({ text }) => text !== undefined)) {
    const label = make("label", "", file.name), field = Object.assign(make("textarea", "cell-field"), { value: work.fileText(file), spellcheck: false, rows: 12 });
    field.oninput = () => work.changeFile(file, field.value);
    label.append(field);
    box.append(label);
  }
  return box;
}
function showLink(found) {
  if (found === null) notice("shared", say("badLink"));
  if (found !== true) return;
  const choose = (wanted) => () => { work.useShared(wanted); notice("shared", ""); redrawAll(); };
  notice("shared", say("sharedScript"), [button("useShared", choose(true), "use-shared"), button("keepOwn", choose(false), "keep-own")]);
}

const page = {
  textOf: (place) => work.textOf(place),
  ownText: (place) => work.ownText(place),
  placeAt: (line) => work.script.placeAt(line),
  change: (place, text) => work.change(place, text),
  run, redraw: (node) => { if (results) showInText(node.parentNode ?? main, results); },
  enter(cell) { cell.node.after(mistake); },
  where(place) {
    const { text, first } = work.composed;
    return { name: scriptName, text, before: first[place] - 1 };
  },
};
const mistake = Object.assign(make("p"), { id: "mistake" });
mistake.setAttribute("role", "status");

async function openWork(key) {
  const reply = await fetch(new URL("lesson.json", address));
  if (!reply.ok) throw new Error("lesson.json");
  return LessonWork.open(await reply.json(), address, key, () => { if (work) redrawAll(); });
}
async function begin() {
  main.before(bar, notices, panel);
  if (!canRun()) {
    bar.remove();
    return notice("engine", say("cannotRun"));
  }
  const key = `${root.pathname} ${lessonName} ${language}`;
  session = openSession({
    key,
    work: () => ({ name: scriptName, text: work.composed.text, language, files: work.folder().filter(({ name }) => name !== scriptName) }),
    news: (what) => { if (!stopped) heard[what.kind]?.(what); },
  });
  const prepared = session.prepare().then(() => true, () => false);  // it is fetched and compiled meanwhile
  const [opened, editor] = await Promise.all([openWork(key), loadCodeMirror()]);
  work = opened;
  if (editor) defineScriptMode();
  const { moveSliders } = session;
  useSession({ moveSliders: (values) => start(() => moveSliders(values)) });
  const found = await work.takeLink();
  work.onStored = showKept;
  for (const id of ["signature", "help"]) document.body.append(Object.assign(make("div"), { id, hidden: true }));
  document.body.append(mistake);
  cells = cellsOfPage(main, page);
  stopButton.disabled = true;
  bar.append(runAllButton, stopButton, state, checkButton, submitButton, workMenu());
  main.append(otherFiles());
  const hints = work.description.checks[`hints.${language}.md`] ?? work.description.checks["hints.md"];
  if (hints) placeHints(main, hints, blocksOf);
  showReadOnly();
  showLink(found);
  showKept(work.kept);
  if (work.takenOver) {
    const older = button("exportOlder", () => download(`before-${scriptName}`, work.older), "export-older");
    notice("older", say(work.takenOver), [older]);
  }
  main.dataset.ready = "";
  if (!await prepared) {
    state.textContent = "";
    return notice("engine", say("engineLost"));
  }
  if (!under) state.textContent = say("engineReady");
  main.dataset.engine = "";
}
window.addEventListener("pagehide", () => { if (work?.unsaved) work.store(); });
document.addEventListener("visibilitychange", () => { if (document.hidden && work?.unsaved) work.store(); });
begin().catch(() => notice("engine", say("engineLost")));
