// The issues that `dynlab check` found in the folder, and the open answers, in a panel next to the document. Each issue
// is counted once: a missing answer appears only among the open answers, and an issue for which the lesson's checks
// deduct points appears with the points.
import { language, number, say } from "./page_words.js";

const $ = (id) => document.getElementById(id);
const make = (name, text = "", kind = "") => Object.assign(document.createElement(name), { textContent: text, className: kind });

function button(text, onclick) {
  return Object.assign(make("button", text), { onclick });
}

/// Where a finding leads to: a line of a file, the beginning of one, or a page of the PDF.
function placeOf({ place, page }, { goTo, goToPage }) {
  const line = /([^\s/:]+):(\d+)$/.exec(place ?? "");
  if (line) return button(place, () => goTo(line[1], Number(line[2])));
  if (/^[^\s/:]+\.(lua|md|toml)$/.test(place ?? "")) return button(place, () => goTo(place, 1));
  if (page || /\.pdf$/.test(place ?? "")) return button(place || say("onPage", page), () => goToPage(page || 1));
  return place ? make("span", place, "faint") : null;
}

function item(finding, ways) {
  const node = make("li", "", finding.severity), place = placeOf(finding, ways);
  node.append(make("p", finding.what));
  if (place) node.append(place);
  if (finding.remedy) node.append(make("p", finding.remedy, "faint"));
  return node;
}

/// "gain (number)": the name is a button that leads to where the document speaks of it.
function answer(text, { goToName }) {
  const node = make("li"), [, name, kind] = /^(\S+) \((.*)\)$/.exec(text);
  node.append(button(name, () => goToName(name)), ` (${say(kind)})`);
  return node;
}

/// "3 of 20 points", where the lesson has checks.
function pointsIn(messages) {
  const told = messages?.find(({ id }) => id.startsWith("checks of ")); // "... lesson {}: {} of {} points"
  const points = told?.arguments.slice(1).map(({ number: { value, digits } }) => number(value.toFixed(digits)));
  return points ? say("points", ...points) : "";
}

/// `older`: the files have changed since, and are being checked again. `ways` lead to places: goTo(file, line),
/// goToPage(number), goToName(name of an answer). `checking`: the part of a check that is done while it runs.
export function showFindings(result, openAnswers, older, ways, checking) {
  const answers = openAnswers ? openAnswers.split(", ") : [];
  const isOpen = ({ id, remedy_message: remedy }) =>  // "Give it: answer("{}", ...)."
    id === "answer-missing" && answers.some((text) => text.split(" ")[0] === remedy?.arguments[0].text);
  const findings = (result?.findings ?? []).filter((finding) => !isOpen(finding));
  const rules = findings.filter(({ severity }) => severity === "rule");
  const lost = findings.filter(({ id }) => id === "check-failed");
  const hints = findings.filter((finding) => !rules.includes(finding) && !lost.includes(finding));
  const points = pointsIn(result?.checked_messages);
  const words = [];
  if (answers.length > 0) words.push(say("openAnswers", answers.length));
  if (rules.length > 0) words.push(say("brokenRules", rules.length));
  if (hints.length > 0) words.push(say("hints", hints.length));
  if (points) words.push(points);
  if (words.length === 0 && result) words.push(say("checked"));
  if (checking !== undefined) words.push(say("checking", Math.round(100 * checking)));
  const told = words.join(", "), shown = $("show-findings");
  if (shown.textContent !== told) shown.textContent = told;
  shown.hidden = words.length === 0;
  shown.classList.toggle("broken", rules.length > 0);
  shown.classList.toggle("older", older);
  shown.title = older ? say("older") : "";
  fill($("findings"), { answers, rules, lost, hints, points }, ways);
}

let filled = "";  // what the panel shows: who reads in it is not disturbed by what is the same
function fill(panel, content, ways) {
  const text = JSON.stringify([language(), content]);
  if (text === filled) return;
  filled = text;
  const { answers, rules, lost, hints, points } = content, parts = [];
  const add = (title, nodes) => {
    if (nodes.length === 0) return;
    const list = make("ul");
    list.append(...nodes);
    parts.push(make("h2", title), list);
  };
  add(say("notGiven"), answers.map((one) => answer(one, ways)));
  add(say("toMend"), rules.map((one) => item(one, ways)));
  add(say("remarks"), hints.map((one) => item(one, ways)));
  if (points) parts.push(make("h2", say("checksOfLesson", points)));
  if (lost.length > 0) {
    const list = make("ul");
    list.append(...lost.map((one) => item(one, ways)));
    parts.push(list);
  }
  if (answers.length + rules.length + lost.length + hints.length === 0) parts.push(make("p", say("nothingToMend")));
  panel.replaceChildren(...parts);
}

$("show-findings").onclick = () => {
  const panel = $("findings");
  panel.hidden = !panel.hidden;
  $("show-findings").setAttribute("aria-expanded", String(!panel.hidden));
  if (!panel.hidden) panel.focus({ preventScroll: true });
};
