// The workbench: a record, its preparation, models and views, and beside them the script that all of it is.
import { connect, onChange, post, session, trouble } from "/bench_session.js";
import { openFirst, partsPanel, preparationPanel, recordPanel } from "/bench_record.js";
import { estimatePanel, modelsPanel } from "/bench_models.js";
import { readingPanel } from "/bench_reading.js";
import { knownPanel } from "/bench_known.js";
import { arrange, ask, channelChoice, drawTiles, redrawBrushes, shownViews, takeSaved, toggleView, fillReport } from "/bench_views.js";
import { exportsPanel } from "/bench_exports.js";
import { openScript, showMistake, showScript } from "/bench_script.js";
import { button, element } from "/bench_fields.js";
import { say, useLanguage, viewName, viewNames } from "/bench_words.js";

const $ = (id) => document.getElementById(id);
let connection = "here", opened = false, viewsBefore = "";

function label() {
  const header = /^-- language:\s*(\w+)/m.exec(session.source)?.[1];
  useLanguage(header ?? (navigator.language?.startsWith("fr") ? "fr" : "en"));
  const words = { undo: "undo", redo: "redo", stop: "stop", again: "again", "make-pdf": "pdf", "show-script": "script", "close-help": "close", asked: "asked", allow: "allow" };
  for (const [id, key] of Object.entries(words)) $(id).textContent = say(key);
  $("steps").setAttribute("aria-label", say("estimate"));
  $("views").setAttribute("aria-label", say("views"));
  $("script").setAttribute("aria-label", say("script"));
}

function showState() {
  $("name").textContent = session.file.split("/").pop();
  $("undo").disabled = !session.undo;
  $("redo").disabled = !session.redo;
  $("stop").hidden = !session.running;
  $("again").hidden = !session.stopped || session.running;
  const running = Object.values(session.states).find(({ state }) => state === "running");
  const share = running?.progress > 0 ? ` ${Math.floor(100 * running.progress)} %` : "";
  $("state").textContent = connection === "over" ? say("ended") : connection === "away" ? say("noAnswer")
    : session.running ? say("running") + share : session.error ? say("mistake") : session.stopped ? say("stopped") : say("ready");
  $("state").classList.toggle("broken", Boolean(session.error));
  $("question").hidden = !session.asking;
  if (session.error) trouble(session.error.message);
  else if ($("trouble").dataset.mistake) trouble(null);
  $("trouble").dataset.mistake = session.error ? "1" : "";
}

/// The panels are made anew with each step; what is open, typed and focused stays.
let held = false, panelsAreOld = false;
document.addEventListener("benchheld", ({ detail }) => {
  held = detail;
  if (!held && panelsAreOld) drawPanels();
});
function drawPanels() {
  const steps = $("steps"), active = document.activeElement;
  panelsAreOld = held;
  if (held) return drawModels();
  const path = steps.contains(active) ? placeOf(steps, active) : null, chosen = chosenDetails(steps), scrolled = steps.scrollTop;
  const typedText = path && active.type === "text" && active.value !== active.defaultValue ? active.value : null;
  const views = element("section", { className: "panel" }, element("h2", { textContent: say("views") }),
    element("div", { className: "adding" }, ...viewNames().map((name) => button(viewName(name), () => toggleView(name), { ariaPressed: String(shownViews().includes(name)) }))), channelChoice() ?? "");
  steps.replaceChildren(...[recordPanel(), preparationPanel(), partsPanel(), readingPanel(), estimatePanel(), knownPanel(), views, exportsPanel()].filter(Boolean));
  for (const [key, node] of namedDetails(steps)) {
    if (chosen.has(key)) Object.assign(node, { open: chosen.get(key) }).dataset.chosen = "1";
  }
  steps.scrollTop = scrolled;
  const again = path && nodeAt(steps, path);
  if (again && again.tagName === active.tagName) {
    again.focus({ preventScroll: true });
    if (typedText !== null) again.value = typedText;
  }
  drawModels();
}
function drawModels() {
  const models = modelsPanel();
  document.querySelector("#views > .models")?.remove();
  if (models) $("views").prepend(models);
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
  if (changed.source) label();
  showState();
  if (changed.source || changed.whole || changed.views.some((name) => ["variables", "models", "advice"].includes(name))) drawPanels();
  const names = shownViews().join();
  if (names !== viewsBefore || changed.whole) {
    viewsBefore = names;
    arrange();
  } else {
    drawTiles(changed.views);
    if (changed.source || changed.views.includes("variables")) ask();
  }
  if (changed.views.includes("variables")) redrawBrushes();
  if (changed.views.includes("saved")) takeSaved();
  if (changed.source && opened) showScript();
  else if (opened) showMistake();
  if (!opened && session.source !== undefined) { opened = true; openScript(); openFirst(); }
}
onChange(draw);
document.addEventListener("benchdraw", drawPanels);
connect((state) => {
  const before = connection;
  connection = state;
  if (before !== state) showState();
});

$("undo").onclick = () => post("/undo");
$("redo").onclick = () => post("/redo");
$("stop").onclick = () => post("/stop");
$("again").onclick = () => post("/again");
$("allow").onclick = () => post("/allow");
$("show-script").onclick = () => {
  const hidden = document.body.classList.toggle("without-script");
  $("show-script").setAttribute("aria-pressed", String(!hidden));
};
$("make-pdf").onclick = async () => {
  $("make-pdf").disabled = true;
  try {
    await fillReport();
    const answer = await fetch("/document.pdf");
    if (!answer.ok) return trouble(await answer.text());
    window.open(URL.createObjectURL(await answer.blob()), "_blank");
  } finally {
    $("make-pdf").disabled = false;
  }
};
document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.target.closest(".CodeMirror, input, textarea")) return;
  if (event.key === "z" && !event.shiftKey) post("/undo");
  else if (event.key === "y" || (event.key === "z" && event.shiftKey)) post("/redo");
  else return;
  event.preventDefault();
});
