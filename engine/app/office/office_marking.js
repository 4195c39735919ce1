// Marking: all answers to one question next to each other, without names, by the keyboard alone. A command stores a
// mark and refuses it if another user has changed the mark since this page showed it; the page sends the shown entry as
// "seen".
import { Lost, ask, command, connected, session, stateChanged } from "./office_session.js";
import { button, choice, make, shown, textBlocks } from "./office_parts.js";
import { say } from "./office_words.js";

const kCommentKeys = "abdefghil", kPointsKey = "p", kWriteKey = "c";
const kMaxDigit = 9;
const kUsualMax = 5;  // points, if the maximum is unknown
const $ = (id) => document.getElementById(id);

let data = null, at = 0, chosen = {}, cards = [], undone = [], waiting = 0, root = null;
/// By the answers' names: what is shown of a mark, and the order that is under way for it.
let marks = {};

export const unsaved = () => waiting;
const entryOf = ({ id, points = null, reason = "" }) => ({ id, points, reason });
const markOf = (name) => marks[name];
const most = () => data.checks.find((one) => one.id === data.check)?.points ?? null;
const mayMark = () => data.check !== "" && (!data.graded || data.checks.some((one) => one.id === data.check));

/// [points] of the digits 0, 1, ...
function rubric() {
  const full = most() ?? kUsualMax;
  if (full <= kMaxDigit && Number.isInteger(full)) return Array.from({ length: full + 1 }, (_, i) => i);
  const steps = 5;
  return Array.from({ length: steps + 1 }, (_, i) => Math.round(2 * full * i / steps) / 2);
}

export async function show(view) {
  root = view;
  data = await ask("marking", chosen);
  chosen = { assignment: data.assignment, question: data.question, check: data.check };
  marks = Object.fromEntries(data.answers.map((answer) => [answer.name, { ...entryOf(answer.entry), order: null, trouble: "" }]));
  at = Math.max(data.answers.findIndex((answer) => markOf(answer.name).points === null), 0);
  draw();
}

/// What has changed in the store; nothing that is under way here is overwritten.
export async function refresh() {
  if (!data) return;
  const fresh = await ask("marking", chosen);
  const sameAnswers = fresh.answers.length === data.answers.length &&
    fresh.answers.every((answer, i) => answer.name === data.answers[i].name && answer.text === data.answers[i].text && answer.is_reading === data.answers[i].is_reading);
  const current = data.answers[at]?.name, sameChecks = JSON.stringify(fresh.checks) === JSON.stringify(data.checks) && fresh.check === data.check;
  data = fresh;
  for (const { name, entry } of data.answers) {
    const mark = (marks[name] ??= { ...entryOf(entry), order: null, trouble: "" });
    if (mark.order || mark.id === entry.id) continue;
    Object.assign(mark, entryOf(entry), { trouble: say("changed") });
  }
  if (!sameAnswers || !sameChecks) {
    at = Math.max(data.answers.findIndex((answer) => answer.name === current), 0);
    return draw();
  }
  drawComments();
  cards.forEach((card, i) => drawMark(card, i));
  return drawProgress();
}

function choose(change) {
  chosen = { ...chosen, ...change };
  if (!("check" in change)) delete chosen.check;
  show(root).catch((error) => root.replaceChildren(make("p", { className: "broken", textContent: error.message })));
}

function draw() {
  if (!data.assignment) return root.replaceChildren(make("p", { textContent: say("noLab") }));
  const selects = make("div", { className: "choices" },
    choice(say("assignment"), data.assignments.map((one) => [one, one]), data.assignment, (assignment) => choose({ assignment, question: undefined })),
    choice(say("question"), data.questions.map((one) => [one, one]), data.question, (question) => choose({ question })),
    data.checks.length > 0 && choice(say("check"), [["", "–"], ...data.checks.map((one) => [one.id, one.id])], data.check, (check) => choose({ check })),
    make("span", { id: "progress", role: "status" }), button(say("undo"), undo, { id: "undo-mark" }), button(say("showKeys"), () => $("keys").showModal()));
  if (data.questions.length === 0) return root.replaceChildren(selects, make("p", { textContent: say("noQuestion") }));
  const check = data.checks.find((one) => one.id === data.check), notes = [];
  if (!mayMark()) notes.push(make("p", { className: "broken", textContent: say("noCheck") }));
  if (!data.graded) notes.push(make("p", { className: "faint", textContent: say("notGradedYet") }));
  if (data.answers.length === 0) notes.push(make("p", { textContent: say("noWork") }));
  const asked = make("details", { className: "asked", open: true }, make("summary", { textContent: `${say("question")} ${data.question}` }),
    make("pre", { textContent: data.asked, dir: "auto" }),
    check?.rubric && make("pre", { className: "rubric-text", textContent: check.rubric }),
    data.solution && make("details", {}, make("summary", { textContent: say("solution") }), make("pre", { textContent: data.solution })));
  cards = data.answers.map((answer, i) => drawCard(answer, i));
  root.replaceChildren(selects, ...notes, asked, make("div", { id: "answers" }, ...cards), drawTools());
  drawComments();
  cards.forEach((card, i) => drawMark(card, i));
  drawProgress();
  return goTo(at, false);
}

function drawTools() {
  const full = most();
  const points = make("div", { id: "rubric", role: "group", ariaLabel: say("rubric") }, ...rubric().map((value, digit) =>
    make("button", { type: "button", onclick: () => give(value), data: { points: value } }, make("kbd", { textContent: digit }), ` ${shown(value)}`)));
  if (full !== null) {
    const all = make("button", { type: "button", onclick: () => give(full), className: "main" }, make("kbd", { textContent: say("enter") }), ` ${shown(full)}`);
    points.append(all);
  }
  const other = make("input", { id: "other-points", type: "text", inputMode: "decimal", size: 8 });
  Object.assign(other, { ariaLabel: say("otherPoints"), placeholder: say("otherPoints") });
  other.onkeydown = (event) => leaveField(event, () => {
    const value = Number(other.value.trim().replace(",", "."));
    if (other.value.trim() === "" || !Number.isFinite(value)) return;
    other.value = "";
    give(value);
  });
  const comment = make("input", { id: "comment", type: "text", ariaLabel: say("comment"), autocomplete: "off", dir: "auto" });
  comment.placeholder = say("commentAbout");
  comment.onkeydown = (event) => leaveField(event, () => {});
  return make("div", { id: "tools" }, points, make("div", { className: "field" }, make("kbd", { textContent: kPointsKey }), other),
    make("div", { className: "field long" }, make("kbd", { textContent: kWriteKey }), comment), make("div", { id: "comments" }));
}

/// Enter and Escape lead from a field back to the answers, whose keys then count again.
function leaveField(event, enter) {
  if (event.key !== "Enter" && event.key !== "Escape") return;
  event.preventDefault();
  event.stopPropagation();
  event.target.blur();
  if (event.key === "Enter") enter();
}

function drawCard(answer, i) {
  const card = make("article", { className: "answer", data: { name: answer.name }, onclick: () => goTo(i, false) });
  const lack = answer.is_reading ? say("beingRead", 1) : answer.trouble ? say("unreadable_", answer.trouble) : answer.text === "" ? say("noAnswer_") : "";
  const text = lack ? make("p", { className: "faint", textContent: lack }) : make("pre", { textContent: answer.text, dir: "auto" });
  card.append(make("header", {}, make("b", { textContent: answer.name }), make("span", { className: "mark" })), text);
  const shownBytes = new TextEncoder().encode(answer.text).length;
  if (answer.bytes > shownBytes) card.append(button(say("whole", Math.ceil(answer.bytes / 1024)), () => showWhole(i), { className: "whole-text" }));
  if (answer.same > 0) card.append(make("p", { className: "faint", textContent: say("sameAs", answer.same) }));
  card.append(make("p", { className: "reason", dir: "auto" }), make("p", { className: "broken", role: "alert" }));
  return card;
}

async function showWhole(i) {
  const { assignment, question } = data, { name, bytes } = data.answers[i], card = cards[i];
  if (new TextEncoder().encode(data.answers[i].text).length >= bytes) return;
  const text = await ask("answer", { assignment, question, name });
  card.querySelector("pre").replaceChildren(...textBlocks(text));
  card.querySelector(".whole-text")?.remove();
}

function drawMark(card, i) {
  const mark = markOf(data.answers[i].name), full = most();
  card.classList.toggle("marked", mark.points !== null);
  card.classList.toggle("waiting", mark.order !== null);
  card.querySelector(".mark").textContent = mark.points === null ? say("noMark") : full === null ? shown(mark.points) : say("pointsOf", shown(mark.points), shown(full));
  card.querySelector(".reason").textContent = mark.reason;
  card.querySelector(".broken").textContent = mark.trouble;
}

function drawProgress() {
  const marked = data.answers.filter((answer) => markOf(answer.name).points !== null).length, reading = data.answers.filter((answer) => answer.is_reading).length;
  const parts = [say("markedOf", marked, data.answers.length)];
  if (waiting > 0) parts.push(say("unsaved", waiting));
  if (reading > 0) parts.push(say("beingRead", reading));
  if ($("progress")) $("progress").textContent = parts.join(" · ");
}

/// Comments that were used for this question, each with its letter.
function drawComments() {
  if (!$("comments")) return;
  $("comments").replaceChildren(...data.comments.slice(0, kCommentKeys.length).map(({ text }, i) =>
    make("button", { type: "button", className: "reused", onclick: () => takeComment(i), data: { text }, ariaPressed: String($("comment").value === text) },
      make("kbd", { textContent: kCommentKeys[i] }), make("span", { textContent: ` ${text}`, dir: "auto" }))));
}

function takeComment(i) {
  const text = data.comments[i]?.text;
  if (text === undefined) return;
  $("comment").value = $("comment").value === text ? "" : text;
  drawComments();
}

function goTo(i, scroll = true) {
  if (data.answers.length === 0) return;
  cards[at]?.classList.remove("chosen");
  at = Math.min(Math.max(i, 0), data.answers.length - 1);
  cards[at].classList.add("chosen");
  $("comment").value = markOf(data.answers[at].name).reason;
  drawComments();
  for (const one of document.querySelectorAll("#rubric button[data-points]")) one.ariaPressed = String(Number(one.dataset.points) === markOf(data.answers[at].name).points);
  if (scroll) cards[at].scrollIntoView({ block: "nearest" });
}

/// The next one without a mark, behind this one first.
function goOn() {
  const count = data.answers.length;
  for (let step = 1; step < count; ++step)
    if (markOf(data.answers[(at + step) % count].name).points === null) return goTo((at + step) % count);
  return goTo(at + 1);
}

function give(points) {
  if (data.answers.length === 0 || !mayMark()) return;
  const { name } = data.answers[at], mark = markOf(name), before = { points: mark.points, reason: mark.reason }, reason = $("comment").value.trim();
  undone.push({ name, before, check: data.check, assignment: data.assignment, stored: store(name, { points, reason }) });
  goOn();
}

function undo() {
  const last = undone.pop();
  if (!last || last.assignment !== data?.assignment || last.check !== data.check) {
    $("progress").textContent = say("nothingToUndo");
    return;
  }
  const i = data.answers.findIndex((answer) => answer.name === last.name);
  last.stored.then((stored) => { if (stored) store(last.name, last.before); });
  goTo(i);
}

/// The words of the command that makes a mark this one.
function wordsOf(assignment, check, name, { points, reason }, seen) {
  if (points === null) return ["withdraw", assignment, name, `--mark=${check}`, `--after=${seen}`, "--reason=undo"];
  const words = ["mark", assignment, name, check, String(points), `--after=${seen}`];
  return reason === "" ? words : [...words, `--reason=${reason}`];
}

/// Stores a mark, after those of the same answer that are under way. Resolves to whether it is stored.
function store(name, wanted) {
  const { assignment, check } = data, mark = markOf(name), seen = mark.order ?? Promise.resolve(mark.id);
  Object.assign(mark, wanted, { trouble: "" });
  ++waiting;
  const order = seen.then((id) => ordered(assignment, check, name, wanted, id));
  mark.order = order.then((entry) => entry.id);
  const mine = mark.order;
  drawNow(name);
  return order.then((entry) => {
    --waiting;
    stateChanged();
    if (mark.order === mine) Object.assign(mark, { id: entry.id, points: entry.points, reason: entry.reason, trouble: entry.trouble, order: null });
    drawNow(name);
    return entry.trouble === "";
  });
}

function drawNow(name) {
  const i = data.answers.findIndex((answer) => answer.name === name);
  if (i >= 0 && cards[i]) drawMark(cards[i], i);
  drawProgress();
}

const isSame = (entry, { points, reason }) => entry.points === points && entry.reason === (points === null ? "" : reason);

const readEntry = async (assignment, check, name) => entryOf(await ask("entry", { assignment, check, name }));
/// Repeats the command until a reply arrives. A command whose reply was lost may have run: its entry shows whether it
/// did.
async function ordered(assignment, check, name, wanted, seen) {
  for (let sure = true; ; sure = false) {
    try {
      const now = sure ? null : await readEntry(assignment, check, name);
      if (now && now.id !== seen && isSame(now, wanted)) return { ...now, trouble: "" };
      const done = await command(wordsOf(assignment, check, name, wanted, seen));
      const entry = await readEntry(assignment, check, name);
      return { ...entry, trouble: done.code === 0 ? "" : done.words.trim() };
    } catch (error) {
      if (!(error instanceof Lost)) return { ...await readEntry(assignment, check, name), trouble: error.message };
      if (session.over) await new Promise(() => {});  // it stays among those that are not stored
      await new Promise((yes) => setTimeout(yes, 300));
      await connected();
    }
  }
}

/// A key that no field takes.
export function key(event) {
  if (!data || data.answers?.length === 0 || !data.check) return event.key === "?" ? $("keys").showModal() : undefined;
  const digit = /^[0-9]$/.test(event.key) ? Number(event.key) : -1, comment = kCommentKeys.indexOf(event.key);
  if (digit >= 0 && digit < rubric().length) give(rubric()[digit]);
  else if (event.key === "Enter" && most() !== null) give(most());
  else if (event.key === "j" || event.key === "ArrowDown" || event.key === "ArrowRight") goTo(at + 1);
  else if (event.key === "k" || event.key === "ArrowUp" || event.key === "ArrowLeft") goTo(at - 1);
  else if (event.key === kWriteKey) $("comment").focus();
  else if (event.key === kPointsKey) $("other-points").focus();
  else if (event.key === "u") undo();
  else if (event.key === "w") showWhole(at);
  else if (event.key === "?") $("keys").showModal();
  else if (comment >= 0) takeComment(comment);
  else return;
  event.preventDefault();
}

export function keyList() {
  const keys = [["0 … 9", "keyDigits"], [say("enter"), "keyEnter"], ["j k ↓ ↑", "keyMove"], [kWriteKey, "keyComment"],
    [[...kCommentKeys].join(" "), "keyLetters"], [kPointsKey, "keyPoints"], ["u", "keyUndo"], ["w", "keyWhole"], ["?", "keyHelp"]];
  return keys.flatMap(([name, about]) => [make("dt", {}, make("kbd", { textContent: name })), make("dd", { textContent: say(about) })]);
}
