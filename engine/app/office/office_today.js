// Today: what is due, missing, late, unreadable or blocked, each with what can be done about it.
import { ask } from "./office_session.js";
import { askAndRun, button, duration, inFile, make, reasonField, row, table } from "./office_parts.js";
import { say } from "./office_words.js";

const kShownAtOnce = 12;  // rows of one kind, until the user opens the rest

let root = null, showStudent = () => {};
export const onStudent = (show) => { showStudent = show; };

const KINDS = {
  "late-waits": "lateWaits", unreadable: "unreadable", "no-pdf": "noPdf", stopped: "stopped", "missing-script": "missingScript", late: "late",
  held: "held", "newer-report": "newerReport", unsent: "unsent", unreleased: "unreleased", "newer-review": "newerReview", kin: "kin", unassigned: "unassigned", "same-file": "sameFile", dropped: "dropped",
};
const nameOf = ({ kind, stage }) => (kind !== "missing" ? KINDS[kind] : stage === "first" ? "missingFirst" : stage === "final" ? "missingFinal" : "missingReview");
const DUE = { first: "dueFirst", review: "dueReview", final: "dueFinal" };
const ORDER = ["lateWaits", "unreadable", "noPdf", "stopped", "missingFirst", "missingScript", "missingReview", "missingFinal", "late"];

export async function show(view) {
  root = view;
  await refresh();
}

export async function refresh() {
  const all = await ask("today"), open = new Set([...root.querySelectorAll("details[open]")].map((one) => one.dataset.key));
  const parts = all.map((one) => drawAssignment(one, open));
  root.replaceChildren(...(parts.length > 0 ? parts : [make("p", { textContent: say("noAssignments") })]));
}

function drawAssignment(one, open) {
  const counts = [say("submitted", one.present, one.groups)];
  for (const [key, word] of [["late", "countLate"], ["unreadable", "countUnreadable"], ["missing", "countMissing"]])
    if (one[key] > 0) counts.push(say(word, one[key]));
  const deadlines = one.deadlines.map(({ stage, due, seconds }) => make("span", { className: seconds < 0 ? "past" : "" },
    `${say(DUE[stage], due)} (${seconds < 0 ? "−" : ""}${duration(seconds)})`));
  const groups = grouped(one.tasks);
  const names = [...groups.keys()].sort((a, b) => (ORDER.indexOf(a) + 100) % 100 - (ORDER.indexOf(b) + 100) % 100);
  const section = make("section", { className: "panel", data: { assignment: one.name } }, make("h2", { textContent: one.name }),
    make("p", { className: "facts" }, ...deadlines, make("span", { textContent: counts.join(", ") })));
  if (one.next) section.append(make("p", { className: "facts" }, say("next", ""), make("code", { textContent: one.next }), nextButton(one)));
  for (const name of names) section.append(drawKind(one, name, groups.get(name), open));
  if (one.not_taken.length > 0) section.append(drawFiles(one, open));
  if (names.length === 0 && one.not_taken.length === 0) section.append(make("p", { className: "faint", textContent: say("nothingToDo") }));
  return section;
}

function grouped(tasks) {
  const groups = new Map();
  for (const task of tasks) groups.set(nameOf(task), [...groups.get(nameOf(task)) ?? [], task]);
  return groups;
}

function nextButton({ name, next }) {
  const step = ["assign", "send", "release"].find((one) => next === `dynlab course review ${one} ${name}`);
  return step ? button(say(step), () => askAndRun(say(step), [], () => ["review", step, name])) : null;
}

function box(key, title, count, open, ...content) {
  return make("details", { open: open.has(key) || (count <= kShownAtOnce && !open.has(`-${key}`)), data: { key } }, make("summary", {}, `${title} (${count})`), ...content);
}

function drawKind(one, name, tasks, open) {
  const remindable = ["missingFirst", "missingFinal", "missingReview", "missingScript", "unreadable", "noPdf"].includes(name);
  const rows = tasks.map((task) => row([button(task.group, () => showStudent(task.group), { className: "link" }), aboutOf(task), make("span", {}, ...buttonsOf(one, task))]));
  return box(`${one.name} ${name}`, say(name), tasks.length, open,
    remindable && tasks.length > 1 && button(say("remindAll"), () => askAndRun(say("remindAll"), [], () => ["remind", one.name, mail(one.name)])),
    table([], rows));
}

const mail = (name) => `--out=exports/${inFile(`mail-${name}`)}.csv`;

function aboutOf({ kind, about, received, late, costs }) {
  if (kind === "late" || kind === "late-waits") return `${say("lateBy", duration(late))} (${received})${costs > 0 ? `, ${say("costs", costs)}` : ""}`;
  return about;
}

function buttonsOf({ name }, { group, kind, stage, received }) {
  const remind = (word) => button(say(word), () => askAndRun(say(word), [], () => ["remind", name, `--only=${group}`, mail(`${name}-${group}`)]));
  const withReason = (word, words, fields = []) => button(say(word), () => askAndRun(say(word), [...fields, reasonField()], words));
  const timeField = (label, value) => ({ name: "time", label: say(label), value });
  const extend = (value = "") => withReason("extend",
    ({ time, reason }) => ["extend", name, group, time, `--stage=${stage}`, `--reason=${reason}`], [timeField("extendTo", value)]);
  const accept = (way) => withReason("accept", ({ reason }) => ["review", way, name, `--accept=${group}`, `--reason=${reason}`]);
  const review = (step) => button(say(step), () => askAndRun(say(step), [], () => ["review", step, name]));
  switch (kind) {
    case "missing": case "missing-script":
      return [remind("remind"), extend(), ...stage === "first" && kind === "missing" ? [withReason("drop", ({ reason }) => ["drop", group, `--reason=${reason}`])] : []];
    case "unreadable": case "no-pdf": return [remind("askAgain"), extend()];
    case "late": return [extend(received)];
    case "late-waits":
      return [extend(received), withReason("acceptTime",
        ({ time, reason }) => ["set-received", name, group, time, `--stage=${stage}`, `--reason=${reason}`], [timeField("received", received)])];
    case "stopped": return [accept(stage === "review" ? "release" : "send"), remind("askAgain")];
    case "held": return stage === "first" ? [withReason("free", ({ reason }) => ["withhold", name, group, "--end", `--reason=${reason}`])] : [];
    case "newer-report": case "unsent": return [review("send")];
    case "newer-review": case "unreleased": return [review("release")];
    case "kin": case "unassigned": return [review("assign")];
    case "dropped": return [withReason("restore", ({ reason }) => ["drop", group, "--end", `--reason=${reason}`])];
    default: return [];
  }
}

function drawFiles(one, open) {
  const rows = one.not_taken.map(({ name, hash, received, reason }) => row([name, received, reason, button(say("takeFile"), () =>
    askAndRun(say("takeFile"), [{ name: "group", label: say("group") }], ({ group }) => ["submit", hash.slice(0, 16), "--kept", `--assignment=${one.name}`, `--from=${group}`]))]));
  return box(`${one.name} files`, say("notTaken"), rows.length, open, table([], rows));
}
