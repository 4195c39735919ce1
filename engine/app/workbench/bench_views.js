// The plots of a session, as many at once as wanted, and their messages.
import { change, isOlder, look, request, session, settled, trouble } from "./bench_session.js";
import { hasPrograms } from "./bench_link.js";
import { Brushes } from "./bench_brushes.js";
import { addModel, chosenStep, redraw } from "./bench_choice.js";
import { button, element, typeset, why } from "./bench_fields.js";
import { movePart, partsNow } from "./bench_parts.js";
import { channelOf, endOfScript, insertedBehind, keyOf, modelSteps, roles, variables } from "./bench_steps.js";
import { deleteStep } from "./bench_delete.js";
import { goesIntoReport, viewLines, wholeReport } from "./bench_report.js";
import { say, shortNumber, viewName, viewNames } from "./bench_words.js";

const HELP = { record: "idplot", second: "idplot", spectrum: "fft", compare: "compare", residuals: "resid", step: "step", impulse: "impulse", bode: "bode", nyquist: "nyquist",
               poles: "pzmap", parameters: "present", correlation: "impulseest", delay: "delayest", reading: "step_delayed", orders: "srivcstruc", study: "montecarlo" };
const WIDE = ["record", "second", "study", "reading", "orders"];
const PER_CHANNEL = ["compare", "residuals", "step", "impulse", "nyquist", "poles", "bode", "correlation", "spectrum"];
const OVER_TIME = [["record", "compare"], ["step", "impulse", "correlation"]];  // pictures whose cursors go together
const tiles = new Map();  // name -> {node, body, words, plot}
const hidden = new Set();  // models that are not drawn
let chosen = null;         // names of views; until the user chooses, the available results decide
let range = null;          // of the data, if it was zoomed
let timer = 0;

function defaultViews() {
  const { raw, second, orders, study, reading } = roles(), models = modelSteps().length > 0;
  const names = raw ? ["record"] : [];
  if (second) names.push("second");
  if (reading) names.push("reading");
  if (models) names.push("compare", "residuals", "step", "bode");
  else if (raw) names.push("correlation", "spectrum");
  if (orders) names.push("orders");
  if (study) names.push("study");
  return names;
}
export const shownViews = () => chosen ?? defaultViews();
export const isHidden = (model) => hidden.has(model);
export function setHidden(model, hide) {
  if (hide) hidden.add(model); else hidden.delete(model);
  ask();
  redraw();
}
const kMostDrawn = 8;  // the user cannot distinguish more curves
export const drawnModels = () => modelSteps().filter((step) => step.on && !hidden.has(step.names[0])).map((step) => step.names[0]).slice(-kMostDrawn);

/// What a view is of; without it the view has nothing to show, and says so.
const SUBJECTS = { record: "raw", second: "second", spectrum: "raw", correlation: "raw", orders: "orders", study: "study", reading: "reading" };
const isEmpty = (name) => (SUBJECTS[name] ? !roles()[SUBJECTS[name]] : modelSteps().length === 0);
const emptyWords = (name) => say(`no_${SUBJECTS[name] ?? "models"}`);

function toggleView(name, on = !shownViews().includes(name)) {
  chosen = viewNames().filter((other) => (other === name ? on : shownViews().includes(other)));
  const closes = tiles.get(name)?.node.contains(document.activeElement);
  arrange();
  redraw();
  if (on) reveal(name);
  if (closes) (document.querySelector("#views .tile .close") ?? document.getElementById("views")).focus();
}
export function viewsPanel() {
  const shown = shownViews(), { raw, study } = roles();
  if (!raw && !study && modelSteps().length === 0) return "";
  const toggle = (name) => button(viewName(name), () => toggleView(name), { ariaPressed: String(shown.includes(name)), title: isEmpty(name) ? emptyWords(name) : "" });
  return element("section", { className: "panel" }, element("h2", { textContent: say("views") }), element("div", { className: "adding" }, ...viewNames().map(toggle)));
}
/// Shows a view that was asked for, where it is to be seen.
export function reveal(name) {
  if (!shownViews().includes(name)) return toggleView(name, true);
  const { node } = tiles.get(name) ?? {};
  if (!node) return;
  for (const { node } of tiles.values()) node.classList.remove("asked");
  node.scrollIntoView({ block: "nearest" });
  node.classList.add("asked");
  setTimeout(() => node.classList.remove("asked"), 1500);
}

/// The instant under the cursor, in the other pictures of the same time.
function linkCursor(name, body, group) {
  const show = (instant) => { for (const other of group) if (other !== name) tiles.get(other)?.plot?.showMoment(instant); };
  body.addEventListener("pointermove", (event) => {
    const { plot } = tiles.get(name) ?? {};
    if (!plot) return;
    const [panel, only] = plot.panelAt(plot.place(event));
    show(panel && !only ? panel.x.value(plot.within(panel, plot.place(event))[0]) : undefined);
  });
  body.addEventListener("pointerleave", () => show(undefined));
}

let wanted = null, saves = 0;  // what is to be saved with the next run
export function save(order) {
  wanted = { ...order, number: ++saves };
  ask();
}
/// Downloads the file that a run has saved for this page's request.
export async function takeSaved() {
  const { saved } = session.views;
  if (!wanted || saved?.number !== wanted.number) return;
  wanted = null;
  ask();
  if (saved.error) return trouble(saved.error);
  const answer = await request(`saved/${encodeURIComponent(saved.file)}`);
  if (!answer.ok) return trouble(await answer.text());
  download(saved.file.replace(/-\d+(\.\w+)$/, "$1"), await answer.blob());
}
export function download(name, blob) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

let firstAsked = 0, questions = 0;  // the number of the question that is asked now
const kLongestFirst = 60000;  // ms; Stop ends it before
/// The numbers of poles and zeros of a first model without a delay; none where one of the usual orders is right.
export async function firstOrders() {
  firstAsked = ++questions;
  ask();
  await settled(() => session.views.first?.number === questions || session.error || session.stopped, kLongestFirst);
  firstAsked = 0;
  const { number, orders } = session.views.first ?? {};
  return number === questions ? orders : [];
}

/// Requests the shown views from the server, with their sizes.
export function ask() {
  clearTimeout(timer);
  timer = setTimeout(() => {
    const part = roles(), models = modelSteps().filter((step) => step.on), all = models.map((step) => step.names[0]);
    const channel_of = Object.fromEntries(models.map((step) => [step.names[0], channelOf(step)]).filter(([, { output }]) => output));
    const names = [...new Set([...Object.values(part), ...all].filter((name) => name && /^[A-Za-z_]\w*$/.test(name)))];
    const every = [...new Set([...names, ...session.steps.filter((step) => step.on).flatMap((step) => step.names)])];
    const sizes = {};
    sizeTiles();
    for (const [name, { node, body }] of tiles) {
      if (isEmpty(name)) continue;
      const failed = node.classList.contains("empty");  // its body is hidden, and has a size all the same
      node.classList.remove("empty");
      sizes[name] = [body.clientWidth - 8, body.clientHeight - (name === "record" ? 40 : 4)];
      node.classList.toggle("empty", failed);
    }
    const of = [part.raw, part.prepared];
    const until = Math.max(0, ...session.steps.filter((step) => step.names.some((name) => of.includes(name))).map((step) => step.last_line));
    look(every, { ...part, views: ["variables", "models", ...shownViews(), ...(firstAsked ? ["first"] : []), "advice"], models: drawnModels(), all_models: all, first: firstAsked, channel_of, sizes, range, ...(wanted ? { save: wanted } : {}) }, until);
  }, 0);
}

function makeTile(name) {
  const node = element("section", { className: "tile", ariaLabel: viewName(name) });
  node.dataset.view = name;
  node.classList.toggle("wide", WIDE.includes(name));
  const close = button("×", () => toggleView(name, false), { className: "close", ariaLabel: say("labeled", say("close"), viewName(name)) });
  const into = button(say("intoScript"), () => intoScript(name), { className: "into", ariaLabel: say("labeled", say("intoScript"), viewName(name)) });
  const body = element("div", { className: "body" }), words = element("p", { className: "told" });
  const title = element("h2", { textContent: viewName(name) });
  const saved = element("select", { className: "save", ariaLabel: say("labeled", say("saveAs"), viewName(name)) });
  saved.append(...["↓", "PDF", "SVG", "PNG"].map((text) => element("option", { value: text.toLowerCase(), textContent: text })));
  saved.onchange = () => { if (saved.selectedIndex > 0) save({ what: "figure", view: name, format: saved.value }); saved.selectedIndex = 0; };
  const made = ["orders", "study", "reading"].includes(name) ? [button(say("remove"), () => deleteStep(keyOf(session.steps.find((step) => step.on && step.names[0] === roles()[name]))), { ariaLabel: say("labeled", say("remove"), viewName(name)) })] : [];
  const tools = element("span", { className: "tools-of-tile" }, why(HELP[name]), ...(TABLES[name] || !hasPrograms ? [] : [saved]), ...(goesIntoReport(name) ? [into] : []), ...made, close);
  node.append(element("header", {}, title, tools), body, words);
  for (const group of OVER_TIME) if (group.includes(name)) linkCursor(name, body, group);
  return { node, body, words, tools, title };
}
/// The output whose structures the last search compares, where there are several.
function searchedName() {
  const { output } = channelOf(session.steps.find((step) => step.names[0] === roles().orders) ?? { arguments: [] });
  return output ? variables()[roles().estimation]?.output_names?.[output - 1] ?? "" : "";
}
/// What was read off, by the formulas of its shape.
function readingWords({ kind, numbers, fit }) {
  const list = numbers.map((value) => shortNumber(value, 4));
  return kind === "first" ? say("readFirst", ...list, shortNumber(fit, 3)) : kind === "delayed" ? say("readDelayed", ...list, shortNumber(fit, 3)) : say("readSecond", ...list, shortNumber(fit, 3));
}
/// All tiles again, in another language.
export function renewTiles() {
  for (const { node } of tiles.values()) node.remove();
  tiles.clear();
}

/// Views of several channels have room for all their panels; residuals and Bode have two rows or columns for each then.
function sizeTiles() {
  const { outputs = 1, inputs = 1 } = variables()[roles().estimation] ?? {}, several = outputs * inputs > 1;
  for (const [name, { node, body }] of tiles) {
    if (name === "record" || name === "second") body.style.height = outputs + inputs > 2 ? `${7 + 4.5 * (outputs + inputs)}rem` : "";
    if (!PER_CHANNEL.includes(name)) continue;
    node.classList.toggle("wide", several && ["residuals", "bode"].includes(name));
    const rows = name === "residuals" ? 1 + inputs : name !== "bode" ? outputs : outputs * inputs * (body.clientWidth < kNarrow ? 2 : 1);
    body.style.height = several ? `${5 + 8 * rows}rem` : "";
  }
}
const kNarrow = 490;  // px: panels of Bode are below each other, as in views.lua
const ASKED = ["reading", "orders", "study", "second"];  // views of steps that the user created in order to see them
export function arrange() {
  const main = document.getElementById("views"), names = shownViews(), before = tiles.size;
  for (const [name, tile] of tiles) if (!names.includes(name)) { tile.node.remove(); tiles.delete(name); }
  const fresh = names.filter((name) => !tiles.has(name));
  names.forEach((name, i) => {
    if (!tiles.has(name)) tiles.set(name, makeTile(name));
    const { node } = tiles.get(name), place = main.querySelectorAll(".tile")[i];
    if (place !== node) main.insertBefore(node, place ?? null);  // one that stays keeps its focus
  });
  sizeTiles();
  drawTiles(names);
  const asked = ASKED.find((name) => fresh.includes(name)) ?? (main.querySelector(".tile.asked") ? null : fresh[0]);
  if (before > 0 && asked) reveal(asked);
  ask();
}

const intoScript = (name) => change(() => [insertedBehind(endOfScript(), viewLines(name, drawnModels()))]);
/// A report that shows nothing yet gets what is on the page.
export async function fillReport() {
  const lines = wholeReport(shownViews(), drawnModels());
  if (lines) await change(() => [insertedBehind(endOfScript(), lines)]);
}

/// Zooms the plot of the data to samples of the prepared data, with a margin of the same length on both sides.
export function showSamples([first, last]) {
  const plot = tiles.get("record")?.plot, data = variables()[roles().prepared];
  if (!plot || data?.kind !== "data") return;
  const wide = Math.max((last - first) * data.Ts, 20 * data.Ts), from = data.start + (first - 1) * data.Ts, { x } = plot.panels[0];
  plot.zoom(plot.panels[0], [x.position(from - wide), x.position(from + (last - first) * data.Ts + wide)], null);
}

/// Zooming long data requests the visible samples.
function followZoom(tile) {
  tile.plot.box.addEventListener("zoomed", () => {
    const { x } = tile.plot.panels[0];
    range = x.moved ? [x.low, x.high] : null;
    ask();
  });
}

function drawFigure(name, tile, figure) {
  if (!tile.plot) {
    tile.body.replaceChildren();
    tile.plot = dynlabPlots.show(tile.body, figure, viewName(name));
    tile.tools.prepend(tile.plot.data);  // over the picture it would cover its numbers
    if (name === "record") { new Brushes(tile.plot, partsNow, movePart); followZoom(tile); }
    return;
  }
  const whole = name === "record" && range ? tile.plot.panels.map((panel) => panel.x.whole) : null;
  tile.plot.renew(figure, whole);
}

function table(head, rows) {
  const body = rows.map((cells) => element("tr", {}, ...cells.map((cell) => {
    const numeric = typeof cell === "number";
    const node = element("td", { className: numeric ? "number" : "" });
    node.append(numeric ? shortNumber(cell) : cell ?? "");
    return node;
  })));
  return element("table", {}, element("thead", {}, element("tr", {}, ...head.map((text) => element("th", { textContent: text, scope: "col" })))), element("tbody", {}, ...body));
}

/// The map of orders: a click estimates the structure.
function ordersMap(seen) {
  const rows = seen.rows, zeros = [...new Set(rows.map((row) => row.zeros))].sort((a, b) => a - b), poles = [...new Set(rows.map((row) => row.poles))].sort((a, b) => a - b);
  const fitOf = (row) => Math.max(0, row.validation ?? row.fit ?? 0), best = Math.max(...rows.map(fitOf)), worst = Math.min(...rows.map(fitOf));
  const cell = (p, z) => {
    const row = rows.find((row) => row.poles === p && row.zeros === z);
    if (!row) return "";
    const fit = fitOf(row), words = row.failure ? say("failed") : `${fit > 0 ? shortNumber(fit, 4) : "< 0"} %${row.best ? " ★" : ""}${row.doubt ? " ?" : ""}`;
    const node = button(words, () => takeOrders(p, z, row.delay), { title: row.failure ?? say("labeled", say("takeOrders"), `YIC ${shortNumber(row.yic, 3)}, BIC ${shortNumber(row.bic, 5)}`) });
    node.style.setProperty("--share", String(best > worst ? (fit - worst) / (best - worst) : 1));
    node.className = "order";
    return node;
  };
  return table([`${say("poles")} \\ ${say("zeros")}`, ...zeros.map(String)], poles.map((p) => [element("b", { textContent: p }), ...zeros.map((z) => cell(p, z))]));
}
/// The structure for one output: of the others the chosen model's numbers stay.
function takeOrders(poles, zeros, delay) {
  const { estimation, orders } = roles(), { output } = channelOf(session.steps.find((step) => step.names[0] === orders) ?? { arguments: [] });
  const count = variables()[estimation]?.outputs ?? 1, none = delay > 0 ? "" : ", {TdMax = 0}";
  if (!output || count === 1) return addModel(`tfsrivc(${estimation}, ${poles}, ${zeros}${none})`);
  const before = chosenStep(), known = before?.function === "tfsrivc" && before.arguments[0] === estimation ? before.arguments.slice(1) : [];
  const list = (orders, own) => {
    const text = String(orders ?? ""), numbers = /^\{[\d, ]+\}$/.test(text) ? text.slice(1, -1).split(",").map(Number) : Array(count).fill(/^\d+$/.test(text) ? Number(text) : own);
    numbers[output - 1] = own;
    return numbers.every((one) => one === numbers[0]) ? String(own) : `{${numbers.join(", ")}}`;
  };
  return addModel(`tfsrivc(${estimation}, ${list(known[0], poles)}, ${list(known[1], zeros)}${none})`);
}

const TABLES = {
  parameters: (seen) => table([say("model"), say("parameter"), say("value"), say("error")], seen.rows),
  orders: ordersMap,
};
const studyTable = (seen) => table(["", say("parameter"), say("truth"), say("meanOf"), say("scatter"), say("bound"), say("reported")], seen.rows);

function drawTile(name) {
  const tile = tiles.get(name), seen = session.views[name] ?? {}, older = isOlder(name), empty = isEmpty(name) && !seen.error, out = seen.left_out ?? [];
  const bare = !older && !seen.figure && !seen.rows && (Boolean(seen.error) || out.length > 0);
  tile.node.classList.toggle("older", older);
  tile.node.classList.toggle("empty", empty || bare);
  const error = seen.error && say("notDrawn", seen.error.replace(/^\S+:\d+: /, ""));
  const words = empty ? emptyWords(name) : error ?? [older && say("older"), name === "reading" && seen.numbers ? readingWords(seen) : seen.words, out.length > 0 && say("elsewhere", out.join(", ")), name === "delay" && !seen.figure && !session.running && say("no_delays")].filter(Boolean).join(" – ");
  tile.words.replaceChildren(...typeset(words));
  if (name === "orders") tile.title.textContent = say("labeled", viewName(name), searchedName()).replace(/\W+$/, "");
  tile.words.classList.toggle("broken", Boolean(seen.error));
  if (empty || bare) return;
  if (seen.figure) drawFigure(name, tile, seen.figure);
  if (tile.node.classList.contains("asked")) tile.node.scrollIntoView({ block: "nearest" });  // its words have come
  if (TABLES[name] && seen.rows) tile.body.replaceChildren(TABLES[name](seen));
  if (name === "study" && seen.rows) {
    tile.rows ??= tile.node.insertBefore(element("div", {}), tile.words);
    tile.rows.replaceChildren(studyTable(seen));
  }
}
export function drawTiles(names = shownViews()) {
  for (const name of names) if (tiles.has(name)) drawTile(name);
}
/// Redraws the marks in the plot of the data after its parts have moved.
export const redrawBrushes = () => tiles.get("record")?.plot?.box.dispatchEvent(new Event("drawn"));

new ResizeObserver(() => ask()).observe(document.getElementById("views"));
