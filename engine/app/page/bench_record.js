// The record: where it comes from, which column is what, what advice says of it, and the steps that prepare it.
import { change, post, session, settled, trouble } from "/bench_session.js";
import { button, choice, element, labelled, numberField, rewrite, textField, why, withOption } from "/bench_fields.js";
import { freeName, insertedBehind, keyOf, luaText, newCell, preparingSteps, removed, replaced, roles, variables } from "/bench_steps.js";
import { divide, showSamples } from "/bench_views.js";
import { say, shortNumber } from "/bench_words.js";

let offered = null;  // RecordChoice of the file that is being opened

async function offer(answer) {
  if (!answer.ok) return trouble(await answer.text());
  offered = await answer.json();
  trouble(null);
  document.dispatchEvent(new Event("benchdraw"));
}
async function upload(file) {
  await offer(await fetch(`/upload?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file }));
}
document.addEventListener("dragover", (event) => event.preventDefault());
document.addEventListener("drop", (event) => {
  const file = event.dataTransfer?.files?.[0];
  if (!file) return;
  event.preventDefault();
  upload(file);
});

/// What the program was started with and could not decide alone.
export async function openFirst() {
  const { data, words } = await (await fetch("/opening")).json();
  if (data && !roles().raw) await offer(await fetch(`/columns?data=${encodeURIComponent(data)}`));
  if (words) trouble(words);
}

let sets = null;
async function fillSets(list) {
  sets ??= await (await fetch("/datasets")).json();
  list.append(element("option", { value: "", textContent: say("course") }), ...sets.map((name) => element("option", { value: name, textContent: name })));
}

function opener() {
  const list = element("select", { ariaLabel: say("course"), onchange: async () => list.value && offer(await fetch(`/columns?data=${encodeURIComponent(list.value)}`)) });
  fillSets(list);
  const file = element("input", { type: "file", ariaLabel: say("file"), accept: ".csv,.txt,.dat,.tsv,.xlsx,.mat", onchange: () => file.files[0] && upload(file.files[0]) });
  return element("div", { className: "controls" }, element("p", { textContent: say("drop") }), file, list);
}

const ROLES = ["input", "output", "time", ""];
const redraw = () => document.dispatchEvent(new Event("benchdraw"));

/// The experiments of a file that holds several, as structs: one is looked at, and its signals have the roles.
const groupOf = ({ name }) => (name.includes(".") ? name.slice(0, name.indexOf(".")) : "");
const groups = () => [...new Set(offered.columns.map(groupOf))].filter(Boolean);
const groupNow = () => offered.group ?? groupOf(offered.columns.find(({ role }) => role) ?? { name: groups()[0] ?? "" });
function chooseGroup(group) {
  const roleOf = {}, own = ({ name }) => name.slice(name.indexOf(".") + 1);
  for (const column of offered.columns.filter((one) => groupOf(one) === groupNow())) {
    roleOf[own(column)] = column.role;
    column.role = "";
  }
  for (const column of offered.columns.filter((one) => groupOf(one) === group && one.usable)) column.role = roleOf[own(column)] ?? "";
  offered.group = group;
  redraw();
}

/// Columns with their roles: lists to choose from, or dragged from one role's row into another's.
function columnsTable() {
  const group = groupNow(), shown = offered.columns.filter((column) => groups().length < 2 || groupOf(column) === group);
  const chips = (role) => {
    const row = element("div", { className: "role", ariaLabel: say(role || "unused") }, element("b", { textContent: say(role || "unused") }));
    row.ondragover = (event) => event.preventDefault();
    row.ondrop = (event) => {
      event.preventDefault();
      event.stopPropagation();
      const column = offered.columns.find(({ name }) => name === event.dataTransfer.getData("text/plain"));
      if (column && (column.usable || role === "")) { column.role = role; redraw(); }
    };
    for (const column of shown.filter((one) => one.role === role)) {
      const list = choice(ROLES, column.role, (value) => { column.role = value; redraw(); }, ROLES.map((one) => say(one || "unused")));
      list.disabled = !column.usable;
      list.ariaLabel = `${say("role")}: ${column.name}`;
      const about = column.trouble || `${shortNumber(column.smallest)} … ${shortNumber(column.largest)}`;
      const chip = element("div", { className: "chip", draggable: column.usable, title: `${column.name}: ${about}` }, element("b", { textContent: groups().length > 1 ? column.name.slice(group.length + 1) : column.name }),
        list, element("small", { textContent: about }));
      if (role === "input" || role === "output")
        chip.append(element("input", { className: "unit", value: column.unit, placeholder: say("unit"), ariaLabel: `${say("unit")}: ${column.name}`, oninput: ({ target }) => { column.unit = target.value; } }));
      chip.ondragstart = (event) => event.dataTransfer.setData("text/plain", column.name);
      row.append(chip);
    }
    return row;
  };
  const node = element("div", { className: "roles" });
  if (groups().length > 1) node.append(labelled(say("experiment"), choice(groups(), group, chooseGroup)));
  node.append(...ROLES.map(chips));
  return node;
}

/// The record becomes a variable of this name; whether it did.
async function take(name) {
  const of = (role) => offered.columns.filter((column) => column.role === role), named = (role) => of(role).map((column) => column.name);
  const outputs = named("output"), inputs = named("input");
  if (outputs.length === 0 || inputs.length === 0) return trouble(say("tooFew")), false;
  const units = Object.fromEntries([...of("input"), ...of("output")].filter(({ unit }) => unit).map((column) => [column.name, column.unit]));
  try {
    await post("/record", { data: offered.data, inputs, outputs, time: named("time")[0] ?? "", Ts: Number(offered.Ts) || 0, name, units });
    offered = null;
    trouble(null);
    redraw();
    return true;
  } catch (error) {
    trouble(error.message);
    return false;
  }
}

function offeredRecord() {
  const box = element("input", { type: "number", min: 0, step: "any", placeholder: say("asFile"), value: offered.Ts ?? "", oninput: () => { offered.Ts = box.value; } });
  const node = element("div", { className: "controls" }, element("h3", { textContent: offered.data }), columnsTable(), labelled(say("sampling"), box));
  node.append(element("details", {}, element("summary", { textContent: "dynlab look" }), element("pre", { textContent: offered.look, tabIndex: 0 })));
  node.append(button(say("take"), () => take("data"), { className: "main" }));
  if (roles().raw) node.append(button(say("second"), takeForValidation));
  node.append(button(say("close"), () => { offered = null; document.dispatchEvent(new Event("benchdraw")); }));
  return node;
}
/// A second record stands in for the part that validates.
async function takeForValidation() {
  const name = freeName("second");
  if (!await take(name)) return;
  await settled(() => session.steps.some((one) => one.names[0] === name), 3000);
  change(() => {
    const step = session.steps.find((one) => one.on && one.names.length === 1 && one.names[0] === "validation");
    const known = session.steps.some((one) => one.names[0] === name);
    if (!known) return null;
    return [...(step ? [removed(step)] : []), newCell("validation", `validation = ${name}`)];
  });
}

/// What a button beside a finding does: the remedy as a step.
function remedies(finding) {
  const add = (line) => addPreparing(line);
  return { offset: [["detrend(…, \"mean\")", () => add((z) => `detrend(${z}, "mean")`)], ["detrend(…, \"start\")", () => add((z) => `detrend(${z}, "start")`)]],
           drift: [["detrend(…)", () => add((z) => `detrend(${z}, "linear")`)]], random_walk: [["detrend(…)", () => add((z) => `detrend(${z}, "linear")`)]],
           outliers: [["filloutliers(…)", () => add((z) => `filloutliers(${z})`)]], fast_sampling: [["resample(…, 1, 10)", () => add((z) => `resample(${z}, 1, 10)`)]] }[finding.code] ?? [];
}
function findingsList() {
  const { list = [] } = session.views.advice ?? {};
  const node = element("details", { open: list.some(({ warning }) => warning), className: "advice" }, element("summary", { textContent: `${say("advice")} (${list.length})` }), why("advice"));
  if (list.length === 0) node.append(element("p", { textContent: say("clean") }));
  for (const finding of list) {
    const line = element("p", { className: finding.warning ? "warning" : "" }, finding.message + " ");
    if (finding.sections?.length > 0) line.append(button(say("show"), () => showSamples(finding.sections[0])));
    for (const [words, act] of remedies(finding)) line.append(button(words, act));
    node.append(line);
  }
  return node;
}

/// A step behind the last that prepares; the record gets another name for it where it has none yet.
export function addPreparing(call) {
  change(() => {
    const { raw, prepared } = roles(), steps = preparingSteps();
    if (prepared !== raw) {
      const before = steps[steps.length - 1] ?? session.steps.find((step) => step.names[0] === prepared);
      return [insertedBehind(before.last_line, `${prepared} = ${call(prepared)}`)];
    }
    const source = session.steps.find((step) => step.names[0] === raw);
    return [insertedBehind(source.last_line, `\nprepared = ${call(raw)}`)];
  });
}

const NEW_STEPS = {
  level: (z) => `detrend(${z}, "mean")`, trend: (z) => `detrend(${z}, "linear")`, filter: (z) => `idfilt(${z}, {0, ${luaCut()}})`,
  resample: (z) => `resample(${z}, 1, 2)`, outliers: (z) => `filloutliers(${z})`, range: (z) => `${z}:range(1, ${variables()[z]?.N ?? 100})`,
};
const NEW_NAMES = { level: ["Level", "Niveau"], trend: ["Trend", "Tendance"], filter: ["Filter", "Filtrer"], resample: ["Resample", "Rééchantillonner"],
                    outliers: ["Outliers", "Valeurs aberrantes"], range: ["Range", "Étendue"] };
/// A tenth of the highest frequency.
function luaCut() {
  const data = variables()[roles().prepared];
  return data?.Ts ? shortNumber(0.1 * Math.PI / data.Ts, 3).replace(",", ".").replace("−", "-") : "1";
}

function preparingStep(step, all) {
  const key = keyOf(step), at = all.indexOf(step);
  const row = element("li", { className: step.on ? "" : "off" });
  const on = element("input", { type: "checkbox", checked: step.on, ariaLabel: `${say("off")}: ${step.function}` });
  on.onchange = () => rewrite(key, () => ({ on: on.checked }));
  row.append(on, element("code", { textContent: step.function }));
  step.arguments.slice(step.receiver ? 0 : 1).forEach((text, i) => {
    const place = i + (step.receiver ? 0 : 1);
    const act = (value, how) => rewrite(key, (now) => ({ arguments: now.arguments.map((old, k) => (k === place ? value : old)) }), how);
    if (step.function === "detrend") row.append(choice(["\"mean\"", "\"linear\"", "\"start\""], text, act, ["mean", "linear", "start"]));
    else row.append(/^\d+$/.test(text) ? numberField(text, act, { slider: false }) : textField(text, act));
  });
  const swap = (other) => change(() => [{ first: Math.min(step.first_line, other.first_line), last: Math.max(step.last_line, other.last_line),
    text: (step.first_line < other.first_line ? [other, step] : [step, other]).map((one) => session.source.split("\n").slice(one.first_line - 1, one.last_line).join("\n")).join("\n") }]);
  if (at > 0 && all[at - 1].last_line + 1 === step.first_line) row.append(button("↑", () => swap(all[at - 1]), { ariaLabel: `${say("up")}: ${step.function}` }));
  if (at + 1 < all.length && step.last_line + 1 === all[at + 1].first_line) row.append(button("↓", () => swap(all[at + 1]), { ariaLabel: `${say("down")}: ${step.function}` }));
  row.append(button("×", () => change(() => [removed(step)]), { ariaLabel: `${say("remove")}: ${step.function}` }), why(step.function));
  return row;
}

export function recordPanel() {
  const node = element("section", { className: "panel" }, element("h2", { textContent: say("record") }));
  const { raw } = roles(), data = variables()[raw];
  if (offered) node.append(offeredRecord());
  else if (!raw) node.append(opener());
  else {
    if (data?.kind === "data") node.append(element("p", { textContent: `${raw}: ${data.N} × ${data.inputs} → ${data.outputs}, Ts = ${shortNumber(data.Ts)} s` }));
    node.append(element("details", {}, element("summary", { textContent: say("open") }), opener()), findingsList());
  }
  return node;
}

export function preparationPanel() {
  const { raw } = roles();
  if (!raw) return "";
  const steps = preparingSteps(), french = document.documentElement.lang === "fr" ? 1 : 0;
  const list = element("ol", { className: "preparing" }, ...steps.map((step) => preparingStep(step, steps)));
  const adding = element("div", { className: "adding" }, ...Object.entries(NEW_STEPS).map(([name, call]) => button(`+ ${NEW_NAMES[name][french]}`, () => addPreparing(call))));
  return element("section", { className: "panel" }, element("h2", { textContent: say("preparation") }), list, adding);
}

export function partsPanel() {
  const { raw, estimation, validation, prepared } = roles();
  if (!raw) return "";
  const node = element("section", { className: "panel" }, element("h2", { textContent: say("parts") }));
  const seen = variables(), a = seen[estimation], b = seen[validation];
  const same = estimation === validation || (a && b && a.start === b.start && a.last === b.last && a.N === b.N && !String(validation).startsWith("second"));
  if (a?.kind === "data") node.append(element("p", { textContent: `${estimation}: ${shortNumber(a.start)} … ${shortNumber(a.last)} s (${a.N})` }));
  if (b?.kind === "data") node.append(element("p", { textContent: `${validation}: ${shortNumber(b.start)} … ${shortNumber(b.last)} s (${b.N})` }));
  if (same) node.append(element("p", { className: "warning", textContent: say("sameParts") }));
  if (seen[prepared]?.kind === "data") node.append(button(say("divide"), () => divide(0.6)), button(say("whole"), () => divide(1)));
  return node;
}
