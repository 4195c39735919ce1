// The data set: its source, the roles of its columns, advice about it, and the steps that prepare it.
import { change, inTurn, post, request, session, settled, trouble, upload } from "./bench_session.js";
import { button, choice, element, labeled, rewrite, typeset, why, withOption } from "./bench_fields.js";
import { formOf, freeName, keyOf, newCell, roles, variables } from "./bench_steps.js";
import { chosenStep } from "./bench_choice.js";
import { preparedAlike } from "./bench_parts.js";
import { addPreparing, callWords, REMEDIES } from "./bench_preparation.js";
import { reveal, showSamples } from "./bench_views.js";
import { say, shortNumber } from "./bench_words.js";

let offered = null;  // RecordChoice of the file that is being opened

async function offer(answer) {
  if (!answer.ok) return trouble(await answer.text());
  offered = await answer.json();
  takeRolesInUse();
  trouble(null);
  document.dispatchEvent(new Event("benchdraw"));
}
const ownName = ({ name }) => name.slice(groupOf({ name }).length).replace(/^\./, "");
/// Gives the channels of another data set the same roles as in the current one, if it has all of these channels.
function takeRolesInUse() {
  const data = variables()[roles().raw];
  if (data?.kind !== "data") return;
  const group = groupNow(), own = offered.columns.filter((column) => groupOf(column) === group && column.usable);
  const inUse = [...data.input_names.map((name) => [name, "input"]), ...data.output_names.map((name) => [name, "output"])];
  if (!inUse.every(([name]) => own.some((column) => ownName(column) === name))) return;
  const units = Object.fromEntries([[data.input_names, data.input_units], [data.output_names, data.output_units]].flatMap(([names, list]) => names.map((name, i) => [name, list?.[i]])));
  for (const column of own.filter(({ role }) => role !== "time")) {
    column.role = inUse.find(([name]) => name === ownName(column))?.[1] ?? "";
    column.unit ||= units[ownName(column)] ?? "";
  }
}
/// Offers the columns of the current data set again, for another choice.
async function offerAgain() {
  const { raw } = roles(), file = session.steps.find((step) => step.function === "load" && step.names[0] === `${raw}_file`);
  if (!file) return;
  await offer(await request(`columns?data=${encodeURIComponent(JSON.parse(file.arguments[0]))}`));
  const data = session.steps.find((step) => step.function === "iddata" && step.names[0] === raw), group = groups().find((name) => data?.arguments[0].includes(`.${name}.`));
  if (group && group !== groupNow()) chooseGroup(group);
}
async function offerFile(file) {
  await offer(await upload(file));
}
document.addEventListener("dragover", (event) => event.preventDefault());
document.addEventListener("drop", (event) => {
  const file = event.dataTransfer?.files?.[0];
  if (!file) return;
  event.preventDefault();
  offerFile(file);
});

/// What the program was started with and could not decide alone; gives whether the session is a new one.
export async function openFirst() {
  const { data, words, fresh } = await (await request("opening")).json();
  if (data && !roles().raw) await offer(await request(`columns?data=${encodeURIComponent(data)}`));
  if (words) trouble(words);
  return fresh;
}

let sets = null;
async function fillSets(list) {
  sets ??= await (await request("datasets")).json();
  list.append(element("option", { value: "", textContent: say("course") }), ...sets.map((name) => element("option", { value: name, textContent: name })));
}

function opener() {
  const list = element("select", { ariaLabel: say("course"), onchange: async () => list.value && offer(await request(`columns?data=${encodeURIComponent(list.value)}`)) });
  fillSets(list);
  const file = element("input", { type: "file", ariaLabel: say("file"), accept: ".csv,.txt,.dat,.tsv,.lvm,.xlsx,.mat", onchange: () => file.files[0] && offerFile(file.files[0]) });
  return element("div", { className: "controls" }, element("p", { textContent: say("drop") }), file, list);
}

const ROLES = ["input", "output", "time", ""];
const redraw = () => document.dispatchEvent(new Event("benchdraw"));

/// The experiments of a file that holds several, as structs: one is looked at, and its signals have the roles.
const groupOf = ({ name }) => (name.includes(".") ? name.slice(0, name.indexOf(".")) : "");
const groups = () => [...new Set(offered.columns.map(groupOf))].filter(Boolean);
const groupNow = () => offered.group ?? groupOf(offered.columns.find(({ role }) => role) ?? { name: groups()[0] ?? "" });
function chooseGroup(group) {
  const roleOf = {};
  for (const column of offered.columns.filter((one) => groupOf(one) === groupNow())) {
    roleOf[ownName(column)] = column.role;
    column.role = "";
  }
  for (const column of offered.columns.filter((one) => groupOf(one) === group && one.usable)) column.role = roleOf[ownName(column)] ?? "";
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
      list.ariaLabel = say("labeled", say("role"), column.name);
      const about = column.trouble || `${shortNumber(column.smallest)} … ${shortNumber(column.largest)}`;
      const chip = element("div", { className: "chip", draggable: column.usable, title: say("labeled", column.name, about) }, element("b", { textContent: groups().length > 1 ? column.name.slice(group.length + 1) : column.name }),
        list, element("small", { textContent: about }));
      if (role === "input" || role === "output")
        chip.append(element("input", { className: "unit", value: column.unit, placeholder: say("unit"), ariaLabel: say("labeled", say("unit"), column.name), oninput: ({ target }) => { column.unit = target.value; } }));
      chip.ondragstart = (event) => event.dataTransfer.setData("text/plain", column.name);
      row.append(chip);
    }
    return row;
  };
  const node = element("div", { className: "roles" });
  if (groups().length > 1) node.append(labeled(say("experiment"), choice(groups(), group, chooseGroup)));
  node.append(...ROLES.map(chips));
  return node;
}

/// Makes the offered data a variable of this name; returns whether that succeeded.
async function take(name) {
  const of = (role) => offered.columns.filter((column) => column.role === role), named = (role) => of(role).map((column) => column.name);
  const outputs = named("output"), inputs = named("input");
  if (outputs.length === 0 || inputs.length === 0) return trouble(say("tooFew")), false;
  const units = Object.fromEntries([...of("input"), ...of("output"), ...of("time")].filter(({ unit }) => unit).map((column) => [column.name, column.unit]));
  try {
    await inTurn(() => post("record", { data: offered.data, inputs, outputs, time: named("time")[0] ?? "", Ts: Number(offered.Ts) || 0, name, units }));
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
  const box = element("input", { type: "number", className: "sampling", min: 0, step: "any", placeholder: say("asFile"), value: offered.Ts ?? "", oninput: () => { offered.Ts = box.value; } });
  const node = element("div", { className: "controls" }, element("h3", { textContent: offered.data }), columnsTable(), labeled(say("sampling"), box));
  node.append(element("details", {}, element("summary", { textContent: "dynlab inspect" }), element("pre", { textContent: offered.look, tabIndex: 0 })));
  node.append(button(say("take"), () => take("data"), { className: "main" }));
  if (roles().raw) node.append(button(say("second"), takeSecond));
  node.append(button(say("close"), () => { offered = null; document.dispatchEvent(new Event("benchdraw")); }));
  return node;
}
async function takeSecond() {
  const data = variables()[roles().raw], wanted = [data?.inputs, data?.outputs].join(), count = (role) => offered.columns.filter((column) => column.role === role).length;
  if (data?.kind === "data" && [count("input"), count("output")].join() !== wanted) return trouble(say("otherChannels", channelsOf(data)));
  await takeForValidation();
  await settled(() => roles().second, 3000);
  await change(preparedAlike, { goesOn: true });
  reveal("second");
}
const withUnits = (names, units) => names.map((name, i) => (units?.[i] ? `${name} (${units[i]})` : name)).join(", ");
const channelsOf = (data) => `${withUnits(data.input_names, data.input_units)} → ${withUnits(data.output_names, data.output_units)}`;
/// A second data set replaces the part for validation.
async function takeForValidation() {
  const name = freeName("second");
  if (!await take(name)) return;
  await settled(() => session.steps.some((one) => one.names[0] === name), 3000);
  change(() => {
    const step = session.steps.find((one) => one.on && one.names.length === 1 && one.names[0] === "validation");
    const known = session.steps.some((one) => one.names[0] === name);
    if (!known) return null;
    return [step ? { first: step.first_line, last: step.last_line, text: `validation = ${name}` } : newCell("validation", `validation = ${name}`)];
  });
}

/// An option of the chosen model that answers a finding, where its method knows it.
const OPTIONS = { running_start: ["InitialState", "\"estimate\""] };
function remedies(finding) {
  const steps = (REMEDIES[finding.code] ?? []).map((call) => button(callWords(call("…")), () => addPreparing(call)));
  const [name, text] = OPTIONS[finding.code] ?? [], model = name && chosenStep();
  const knows = model && formOf(model.function)?.options.some((option) => option.name === name) && !model.options.some((option) => option.key === name && option.text === text);
  const key = knows && keyOf(model);
  return knows ? [...steps, button(`${model.names[0]}: ${name} = ${text}`, () => rewrite(key, (step) => withOption(step, name, text)))] : steps;
}
function findingsList() {
  const { list = [] } = session.views.advice ?? {};
  const node = element("details", { open: list.some(({ warning }) => warning), className: "advice" }, element("summary", { textContent: `${say("advice")} (${list.length})` }), why("advice"));
  if (list.length === 0) node.append(element("p", { textContent: say("clean") }));
  for (const finding of list) {
    const line = element("p", { className: finding.warning ? "warning" : "" }, finding.message + " ");
    if (finding.sections?.length > 0) line.append(button(say("show"), () => showSamples(finding.sections[0]), { ariaLabel: say("labeled", say("show"), finding.code) }));
    line.append(...remedies(finding));
    node.append(line);
  }
  return node;
}

export function recordPanel() {
  const node = element("section", { className: "panel" }, element("h2", { textContent: say("record") }));
  const { raw } = roles(), data = variables()[raw];
  if (offered) node.append(offeredRecord());
  else if (!raw) node.append(opener());
  else {
    if (data?.kind === "data") {
      node.append(element("p", {}, ...typeset(say("labeled", raw, `${say("samples", data.N)}, T_s = ${shortNumber(data.Ts)} s`))),
                  element("p", { className: "channels" }, channelsOf(data), " ", button(say("channels"), offerAgain)));
    }
    node.append(element("details", {}, element("summary", { textContent: say("open") }), opener()), findingsList());
  }
  return node;
}
