// Student: a search for a student by any name, with all submissions, times, receipts, marks and history.
import { ask } from "./office_session.js";
import { askAndRun, button, duration, make, reasonField, row, shown, table } from "./office_parts.js";
import { say } from "./office_words.js";

const kMaxFound = 12;

let root = null, people = [], name = "";

export const setPeople = (all) => { people = all; };
export const setName = (wanted) => { name = wanted; };

/// The text without accents and case, for the search.
const folded = (text) => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
function found(typed) {
  const words = folded(typed).split(/\s+/).filter(Boolean);
  if (words.length === 0) return [];
  return people.filter((one) => words.every((word) => folded(`${one.name} ${one.id} ${one.mail} ${one.group}`).includes(word)));
}

export async function show(view) {
  root = view;
  const field = make("input", { id: "search", type: "search", value: name, ariaLabel: say("search"), placeholder: say("search"), autocomplete: "off" });
  const list = make("div", { id: "found" });
  field.oninput = () => list.replaceChildren(...found(field.value).slice(0, kMaxFound).map((one) =>
    button(one.id ? `${one.name || one.id} (${one.id})` : one.name, () => take(one.id || one.name), { className: "link" })));
  field.onkeydown = (event) => {
    if (event.key === "ArrowDown") list.firstElementChild?.focus();
    if (event.key !== "Enter" || field.value.trim() === "") return;
    const typed = folded(field.value.trim()), all = found(field.value);
    const exact = all.filter((one) => [one.name, one.id, one.mail].some((text) => folded(text) === typed));
    const meant = exact.length > 0 ? exact : all;
    if (all.length === 0 || all.some((one) => folded(one.group) === typed)) take(field.value.trim());
    else if (meant.length === 1) take(meant[0].id || meant[0].name);  // of several, the list shows them
  };
  const take = (wanted) => {
    name = wanted;
    list.replaceChildren();
    refresh();
  };
  root.replaceChildren(make("p", { className: "search" }, field), list, make("div", { id: "facts" }, make("p", { className: "faint", textContent: say("searchAbout") })));
  if (name) await refresh();
  else field.focus();
}

export async function refresh() {
  if (!name) return;
  const box = document.getElementById("facts"), wanted = name;
  try {
    const facts = await ask("student", { name });
    if (wanted === name) box.replaceChildren(...draw(facts));
  } catch (error) {
    box.replaceChildren(make("p", { className: "broken", textContent: error.message }));
  }
}

function draw({ people: persons, former, groups, work, history }) {
  const heads = persons.map((one) => make("h2", {}, one.name || one.id, make("small", { textContent: ` ${[one.id, one.mail].filter(Boolean).join(", ")}` })));
  const parts = [...heads, ...former.map((one) => make("p", { className: "faint", textContent: say("before", one) }))];
  for (const group of groups) {
    const members = group.members.map((one) => (one.until ? `${one.name} (${say("until", one.until)})` : one.name));
    parts.push(make("p", {}, make("b", { textContent: `${group.name}: ` }), members.join(", ")));
  }
  for (const one of work) parts.push(drawWork(one));
  parts.push(make("h3", { textContent: say("history") }), make("ol", { className: "history" }, ...history.toReversed().map(lineOf)));
  return parts;
}

function percentOf({ missing, percent, open }) {
  if (missing) return say("nothingMissing");
  return percent !== undefined ? `${shown(percent)} %` : open ? say("notMarked") : "–";
}
const lineOf = ({ at, what }) => make("li", {}, make("time", { textContent: at }), ` ${what}`);

function drawWork({ name: assignment, kind, versions, extensions, marks }) {
  const rows = versions.map((one) => row([one.group, `${one.stage} ${one.part} v${one.number}`, one.name, one.received,
    one.withdrawn ? say("withdrawn") : one.trouble || (one.late > 0 ? say("lateBy", duration(one.late)) : say("inTime")),
    String(one.receipt).padStart(5, "0"), make("span", {}, ...actions(assignment, one))]));
  const told = marks.map((one) => `${one.name}: ${percentOf(one)}`);
  return make("section", { className: "panel" }, make("h3", { textContent: `${assignment} (${kind})` }),
    rows.length > 0 ? table([say("group"), say("file"), say("name"), say("received"), say("state"), say("receipt"), ""], rows)
      : make("p", { className: "faint", textContent: say("nothingSubmitted") }),
    ...extensions.map(({ stage, due, reason }) => make("p", { textContent: say("dueAs", stage, due || say("asForAll"), reason) })),
    ...told.map((text) => make("p", {}, make("b", { textContent: `${say("mark")}: ` }), text)));
}

function actions(assignment, { group, stage, part, number, received, withdrawn }) {
  const which = [`--stage=${stage}`, `--part=${part}`, `--version=${number}`];
  const act = (word, verb) => button(say(word), () => askAndRun(say(word), [reasonField()], ({ reason }) => [verb, assignment, group, ...which, `--reason=${reason}`]));
  if (stage === "review") return [];  // several in one group: the view of reviews has them
  if (withdrawn) return [act("restore", "restore")];
  const correct = () => askAndRun(say("correctTime"), [{ name: "time", label: say("time"), value: received }, reasonField()],
    ({ time, reason }) => ["set-received", assignment, group, time, ...which, `--reason=${reason}`]);
  return [act("withdraw", "withdraw"), button(say("correctTime"), correct)];
}
