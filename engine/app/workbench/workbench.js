// The workbench: a data set, its preparation, models and views, and next to them the script that contains all of it.
import * as link from "./bench_link.js";
import { change, connect, inTurn, onChange, post, request, session, settled, trouble } from "./bench_session.js";
import { openFirst, recordPanel } from "./bench_record.js";
import { partsPanel, preparationPanel } from "./bench_preparation.js";
import { estimatePanel, modelsPanel } from "./bench_models.js";
import { readingPanel } from "./bench_reading.js";
import { knownPanel } from "./bench_known.js";
import { arrange, ask, download, drawTiles, fillReport, redrawBrushes, renewTiles, shownViews, takeSaved, viewsPanel } from "./bench_views.js";
import { exportsPanel } from "./bench_exports.js";
import { closeScript, openScript, showMistake, showScript } from "./bench_script.js";
import { mistakeWords } from "./bench_mistake.js";
import { reportIn } from "./bench_report.js";
import { modelSteps, roles } from "./bench_steps.js";
import { browserLanguage, label, language, languages, say, useLanguage } from "./bench_words.js";

const $ = (id) => document.getElementById(id);
let connection = "here", opened = false, making = false, viewsBefore = "";

/// The script's header states the language of all messages of its run; a new session has the browser's language.
let languageBefore = null;
const languageOfScript = () => /^-- language:\s*(\w+)/m.exec(session.source)?.[1];
function speak() {
  const code = languageOfScript() ?? "en";
  if (code === languageBefore) return;
  useLanguage(code);
  label();
  $("language").value = language();
  if (languageBefore) { renewTiles(); viewsBefore = ""; }
  languageBefore = code;
}
const turnTo = (code) => change(() => ({ text: reportIn(inLanguage(session.source, code), code) }));
/// Each language is called as it calls itself.
for (const code of languages) {
  const name = new Intl.DisplayNames([code], { type: "language" }).of(code);
  $("language").append(Object.assign(document.createElement("option"), { value: code, lang: code, textContent: name[0].toLocaleUpperCase(code) + name.slice(1) }));
}
/// The script with this language in its header.
function inLanguage(source, code) {
  const line = `-- language: ${code}`;
  if (/^-- language:.*$/m.test(source)) return source.replace(/^-- language:.*$/m, line);
  return /^-- ---\n/.test(source) ? source.replace("-- ---\n", `-- ---\n${line}\n`) : `-- ---\n${line}\n-- ---\n\n${source}`;
}

function showState() {
  $("name").textContent = session.file.split("/").pop();
  const over = connection === "over", there = roles().raw || roles().study || modelSteps().length > 0, focused = document.activeElement;
  $("undo").disabled = over || !session.undo;
  $("redo").disabled = over || !session.redo;
  if (focused === $("undo") && focused.disabled) $("redo").focus();
  if (focused === $("redo") && focused.disabled) $("undo").focus();
  $("make-pdf").disabled = over || making || !there;
  $("invitation").hidden = Boolean(there);
  for (const id of ["stop", "again", "allow", "language"]) $(id).disabled = over;
  $("steps").inert = over;
  document.body.classList.toggle("over", over);
  if (over) closeScript();
  $("stop").hidden = !session.running;
  $("again").hidden = !session.stopped || session.running;
  const running = Object.values(session.states).find(({ state }) => state === "running");
  const share = running?.progress > 0 ? ` ${Math.floor(100 * running.progress)} %` : "";
  $("state").textContent = connection === "over" ? say("ended") : connection === "away" ? say("noAnswer")
    : making ? say("making") : session.running ? say("running") + share : session.error ? say("mistake") : session.stopped ? say("stopped") : say("ready");
  $("state").classList.toggle("broken", Boolean(session.error));
  $("question").hidden = !session.asking;
  $("unsaved").hidden = !session.unsaved;
  const unsaved = session.unsaved ? say("unsaved", session.unsaved) : "";
  if ($("unsaved").textContent !== unsaved) $("unsaved").textContent = unsaved;
  const [mistake, ...controls] = session.error ? mistakeWords(session.error) : [""], { dataset, hidden } = $("trouble");
  if (mistake && (dataset.mistake !== mistake || hidden)) trouble(mistake, ...controls);
  else if (!mistake && dataset.mistake) trouble(null);
  dataset.mistake = mistake;
}

/// The panels are created again with each step; what is open, typed and focused stays.
let held = false, panelsAreOld = false;
document.addEventListener("benchheld", ({ detail }) => {
  held = detail;
  if (!held && panelsAreOld) drawPanels();
});
function drawPanels() {
  const steps = $("steps"), active = document.activeElement;
  panelsAreOld = held;
  if (held) return drawModels();
  const path = steps.contains(active) && active !== steps ? placeOf(steps, active) : null, known = path && markOf(steps, active), chosen = chosenDetails(steps), scrolled = steps.scrollTop;
  const typedText = path && ["text", "textarea"].includes(active.type) && active.value !== active.defaultValue ? active.value : null;
  steps.replaceChildren(...[recordPanel(), preparationPanel(), partsPanel(), readingPanel(), estimatePanel(), knownPanel(), viewsPanel(), exportsPanel()].filter(Boolean));
  for (const [key, node] of namedDetails(steps)) {
    if (chosen.has(key)) Object.assign(node, { open: chosen.get(key) }).dataset.chosen = "1";
  }
  steps.scrollTop = scrolled;
  const again = path && controlAt(steps, known);
  (again ?? (path && nearestControl(steps, path)))?.focus({ preventScroll: true });
  if (again && typedText !== null) again.value = typedText;
  drawModels();
}
function drawModels() {
  const models = modelsPanel(), old = document.querySelector("#views > .models"), active = document.activeElement;
  const path = old?.contains(active) && active !== old ? placeOf(old, active) : null, known = path && markOf(old, active);
  if (old && models) old.replaceWith(models);
  else old?.remove();
  if (models && !old) $("views").prepend(models);
  if (path) (models ? controlAt(models, known) ?? nearestControl(models, path) : $("views")).focus({ preventScroll: true });
}
/// A control is recognized after its panel was created again by its panel's title, its name and its place among those of that name.
const titleOf = (node) => node.closest(".panel")?.querySelector("h2, summary").textContent.replace(/ \(\d+\)$/, "");
const nameOf = (node) => node.ariaLabel ?? node.closest("label")?.firstChild.textContent ?? node.textContent.replace(/ \(\d+\)$/, "");
const keyOf = (node) => [titleOf(node), node.type, nameOf(node)].join("|");
const ofKey = (root, tag, key) => [...root.querySelectorAll(tag)].filter((node) => keyOf(node) === key);
const markOf = (root, node) => ({ tag: node.tagName, key: keyOf(node), number: ofKey(root, node.tagName, keyOf(node)).indexOf(node) });
function controlAt(root, { tag, key, number }) {
  const found = ofKey(root, tag, key)[number];
  return found && !found.disabled ? found : null;
}
/// Where focus goes when its control is no longer there: to the last one at a place on the way to it.
function nearestControl(root, path) {
  for (let depth = path.length - 1; depth > 0; --depth) {
    const found = nodeAt(root, path.slice(0, depth))?.querySelector("button:enabled, input:enabled, select:enabled, summary");
    if (found) return found;
  }
  return root;
}
/// What folds, by its title without the number behind it and its place among those of that title.
function namedDetails(root) {
  const seen = {};
  return [...root.querySelectorAll("details")].map((node) => {
    const title = node.querySelector("summary").textContent.replace(/ \(\d+\)$/, "");
    seen[title] = (seen[title] ?? 0) + 1;
    return [`${title} ${seen[title]}`, node];
  });
}
/// Which the user opened or closed: these stay as they are, the others follow what they hold.
const chosenDetails = (root) => new Map(namedDetails(root).filter(([, node]) => node.dataset.chosen).map(([key, node]) => [key, node.open]));
$("steps").addEventListener("click", ({ target }) => {
  const node = target.closest("summary")?.parentNode;
  if (node) node.dataset.chosen = "1";
});
function placeOf(root, node) {
  const path = [];
  for (; node !== root; node = node.parentNode) path.unshift([...node.parentNode.children].indexOf(node));
  return path;
}
const nodeAt = (root, path) => path.reduce((node, i) => node?.children[i], root);

function draw(changed) {
  if (changed.source) speak();
  showState();
  if (changed.source || changed.whole || changed.error || changed.views.some((name) => ["variables", "models", "advice"].includes(name))) drawPanels();
  const names = shownViews().join();
  if (names !== viewsBefore || changed.whole) {
    viewsBefore = names;
    arrange();
  } else {
    drawTiles(changed.error || session.error ? undefined : changed.views);
    if (changed.source || changed.views.includes("variables")) ask();
  }
  if (changed.views.includes("variables")) redrawBrushes();
  if (changed.views.includes("saved")) takeSaved();
  if (changed.source && opened) showScript();
  else if (opened) showMistake();
  if (!opened && session.source !== undefined) open();
}
/// All that has changed since the last frame is drawn once; the engine works meanwhile. A hidden page has no frames.
let waiting = null;
function drawWaiting() {
  const changed = waiting;
  waiting = null;
  draw(changed);
}
onChange((changed) => {
  if (waiting === null) (document.hidden ? setTimeout : requestAnimationFrame)(drawWaiting);
  const { source, whole, error, views } = waiting ?? { views: [] };
  waiting = { source: source || changed.source, whole: whole || changed.whole, error: error || changed.error, views: [...new Set([...views, ...changed.views])] };
});
async function open() {
  opened = true;
  openScript();
  if (await openFirst() && !languageOfScript() && browserLanguage() !== "en") turnTo(browserLanguage());
}
document.addEventListener("benchdraw", drawPanels);
connect((state) => {
  const before = connection;
  connection = state;
  if (before !== state) showState();
});

const told = (answer) => answer.catch((error) => trouble(error.message));
const order = (path) => told(inTurn(() => post(path)));  // of the script as all that was asked for before leaves it
for (const name of ["undo", "redo"]) $(name).onclick = () => order(name);
for (const name of ["stop", "again", "allow"]) $(name).onclick = () => told(post(name));
$("language").onchange = () => turnTo($("language").value);
$("show-script").onclick = () => {
  const hidden = document.body.classList.toggle("without-script");
  $("show-script").setAttribute("aria-pressed", String(!hidden));
};
/// A page without LaTeX downloads the script of the report.
if (!link.hasPrograms) $("make-pdf").dataset.say = "reportScript";
function addToBar(behind, tag, words, what) {
  const node = Object.assign(document.createElement(tag), what);
  node.dataset.say = words;
  behind.after(node);
}
if (link.home) addToBar($("state"), "a", "home", { href: link.home });
if (link.renew) addToBar($("make-pdf"), "button", "newSession", { onclick: () => told(link.renew()) });
/// Saved under the session's name: the browser would block a window that opens automatically, later than the click.
$("make-pdf").onclick = async () => {
  making = true;
  showState();
  try {
    await inTurn(() => {});  // what was asked for and typed is in it
    await fillReport();
    await settled(() => session.shown === session.revision && !session.running, 3000);
    showState();  // the error's own message, drawn with the next frame, would replace what is said below
    await takeReport();
  } catch (error) {
    trouble(error.message);
  } finally {
    making = false;
    showState();
    if (document.activeElement === document.body) $("make-pdf").focus();
  }
};
async function takeReport() {
  const name = session.file.split("/").pop();
  if (!link.hasPrograms) {
    download(name, new Blob([session.source], { type: "text/plain" }));
    return trouble(say("reportHow", name));
  }
  const answer = await request("document.pdf");
  if (answer.ok) download(name.replace(/\.lua$/, "") + ".pdf", await answer.blob());
  else trouble(await answer.text());
}
document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.target.closest(".CodeMirror, input, textarea")) return;
  if (event.key === "z" && !event.shiftKey) order("undo");
  else if (event.key === "y" || (event.key === "z" && event.shiftKey)) order("redo");
  else return;
  event.preventDefault();
});
