// The instructor's page: five views of one course, and the commands that were run from here.
import * as marking from "./office_marking.js";
import * as marks from "./office_marks.js";
import * as reviews from "./office_reviews.js";
import * as student from "./office_student.js";
import * as today from "./office_today.js";
import { ask, fileAddress, onLog, onNews, onState, open, session } from "./office_session.js";
import { button, make } from "./office_parts.js";
import { browserLanguage, label, language, languages, say, useLanguage } from "./office_words.js";

const $ = (id) => document.getElementById(id);
const VIEWS = { marking, today, student, reviews, marks };
const kShownLines = 100;
const kFastest = 250;  // ms between two readings of the store

let shownView = "";

function drawViews() {
  const names = { marking: say("marking"), today: say("today"), student: say("student"), reviews: say("reviews"), marks: say("marks") };
  $("views").replaceChildren(...Object.entries(names).map(([name, text]) =>
    button(text, () => show(name), { data: { view: name }, ariaCurrent: name === shownView ? "page" : null })));
}

async function show(name) {
  shownView = name;
  history.replaceState(null, "", `#${name}`);
  drawViews();
  $("view").dataset.view = name;
  $("view").replaceChildren();
  try {
    await VIEWS[name].show($("view"));
    drawState();
  } catch (error) {
    $("view").replaceChildren(make("p", { className: "broken", textContent: error.message }));
  }
}

async function readCourse() {
  const course = await ask("course");
  $("name").textContent = course.name;
  document.title = `${course.name} – dynlab`;
  student.setPeople(course.people);
}

/// What a command in a terminal, another window or this one has changed.
let reading = null, again = false;
function refresh() {
  if (reading) {
    again = true;
    return;
  }
  const pause = () => new Promise((yes) => setTimeout(yes, kFastest));
  reading = Promise.all([readCourse(), VIEWS[shownView]?.refresh()]).catch(() => {}).then(pause).then(() => {
    reading = null;
    if (again) refresh();
    again = false;
  });
}

function drawState() {
  const left = marking.unsaved();
  $("state").textContent = session.over ? say("ended") : session.lost ? say("noAnswer") : left > 0 ? say("unsaved", left) : "";
  $("state").classList.toggle("broken", session.over || session.lost);
}

function drawEntry({ line, code, words, file }) {
  return make("li", { className: code === 0 || code === null ? "" : "broken" }, make("code", { textContent: line }),
    file && code === 0 && make("a", { href: fileAddress(file), download: file, textContent: ` ${say("download", file)}` }),
    make("pre", { textContent: words }));
}

/// The newest command, and all of this window behind it.
function drawLog() {
  const last = session.log.at(-1);
  if (!last) return;
  $("last").textContent = last.line;
  $("last").className = last.code === null ? "running" : last.code === 0 ? "done" : "broken";
  $("lines").replaceChildren(...session.log.toReversed().slice(0, kShownLines).map(drawEntry));
  // While marking, the panel would cover the answer; its card says what was wrong.
  if (last.code !== null && last.code !== 0 && shownView !== "marking") $("log").querySelector("details").open = true;
  drawState();
}

function drawAll() {
  label();
  $("language").replaceChildren(...languages.map((one) => make("option", { value: one, textContent: one })));
  $("language").value = language();
  $("key-list").replaceChildren(...marking.keyList());
  drawLog();
}

addEventListener("keydown", (event) => {
  const typing = event.target.closest?.("input, select, textarea, dialog");
  if (shownView !== "marking" || typing || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "Enter" && event.target.closest?.("button, summary, a")) return;
  marking.key(event);
});
addEventListener("beforeunload", (event) => { if (marking.unsaved() > 0) event.preventDefault(); });

for (const view of [today, reviews, marks]) view.onStudent((name) => { student.setName(name); show("student"); });
$("language").onchange = () => {
  useLanguage($("language").value);
  drawAll();
  show(shownView);
};
onNews(refresh);
onLog(drawLog);
onState(drawState);
useLanguage(browserLanguage());
drawAll();
readCourse().catch(() => {});
const first = location.hash.slice(1);
show(Object.hasOwn(VIEWS, first) ? first : "marking").then(open);
