// Estimating, and the table of models.
import { change, session } from "/bench_session.js";
import { button, element, firstCall, help, labelled, rewrite, stepControls, textField, why } from "/bench_fields.js";
import { freeName, keyOf, modelSteps, newCell, roles, stepOf, variables, written } from "/bench_steps.js";
import { isHidden, setHidden } from "/bench_views.js";
import { say, shortNumber } from "/bench_words.js";

let chosen = null;  // key of the step whose controls are shown
let method = "tfsrivc";  // that a new model will have
let sorting = { key: null, way: 1 };

const chosenStep = () => (chosen && stepOf(chosen)) ?? [...modelSteps()].reverse().find((step) => session.forms.some((form) => form.name === step.function)) ?? null;

function methodList(act, now) {
  const list = element("select", { ariaLabel: say("method"), onchange: () => act(list.value) });
  for (const domain of ["continuous", "discrete"]) {
    const group = element("optgroup", { label: domain });
    for (const form of session.forms.filter((one) => one.domain === domain)) group.append(element("option", { value: form.name, textContent: `${form.name} — ${form.structure}`, title: form.summary }));
    list.append(group);
  }
  list.value = now;
  return list;
}

function estimateNew(method) {
  addModel(firstCall(session.forms.find((one) => one.name === method), roles().estimation));
}

/// Another method for a step: what the new one does not know is left out.
function exchangeMethod(key, method) {
  const form = session.forms.find((one) => one.name === method);
  rewrite(key, (step) => {
    const known = new Set(form.options.map(({ name }) => name)), old = session.forms.find((one) => one.name === step.function);
    const same = JSON.stringify(old?.arguments.map(({ parts, name }) => [name, parts])) === JSON.stringify(form.arguments.map(({ parts, name }) => [name, parts]));
    const fresh = form.arguments.map((field) => (field.kind === "orders" ? `{${field.initial}}` : field.initial || "3"));
    return { function: method, arguments: same ? step.arguments : [step.arguments[0], ...fresh], options: step.options.filter(({ key }) => known.has(key)) };
  });
}

/// What the server says of the step's line: its mistake, or its model's own message.
function verdictOf(step) {
  const error = session.error;
  if (error && error.line >= step.first_line && error.line <= step.last_line) return [error.message, "broken"];
  const row = session.views.models?.rows?.find?.((one) => one.name === step.names[0]);
  return row?.message ? [row.message, row.verdict && !row.is_white ? "" : ""] : ["", ""];
}

export function estimatePanel() {
  const { raw, estimation } = roles();
  if (!raw) return "";
  const node = element("section", { className: "panel" }, element("h2", { textContent: say("estimate") }));
  const quick = element("div", { className: "adding" });
  const list = methodList((name) => { method = name; }, method);
  quick.append(labelled(say("method"), list), button(say("newModel"), () => estimateNew(list.value), { className: "main" }), why2(() => list.value));
  const seen = variables()[estimation];
  quick.append(button(say("search"), () => change(() => {
    const name = freeName("orders"), part = roles(), apart = part.validation !== part.estimation ? `, validate = ${part.validation}` : "";
    return [newCell(name, `${name} = srivcstruc(${part.estimation}, {poles = {1, 4}, zeros = {0, 2}${apart}})`)];
  }), { disabled: seen?.inputs > 1 || seen?.outputs > 1, title: "srivcstruc" }), why("srivcstruc"));
  node.append(quick);
  const step = chosenStep();
  if (step) {
    const key = keyOf(step), form = session.forms.find((one) => one.name === step.function);
    const box = element("div", { className: "chosen" }, element("h3", { textContent: step.names[0] }));
    if (form) box.append(methodList((method) => exchangeMethod(key, method), step.function), why(step.function), element("p", { className: "faint", textContent: `${form.structure}; ${form.noise}` }), stepControls(key, step));
    else box.append(textField(step.arguments[0] ?? "", (text) => rewrite(key, () => ({ arguments: [text] }))));
    const [words, kind] = verdictOf(step);
    if (words) box.append(element("p", { className: kind, textContent: words }));
    node.append(box);
  }
  return node;
}
function why2(name) {
  return button(say("why"), () => help(name()), { className: "why" });
}

/// A new cell with a model; its controls are shown.
export function addModel(call) {
  change(() => {
    const name = freeName("G");
    chosen = `${name}#0`;
    return [newCell(name, `${name} = ${call}`)];
  });
}

const COLUMNS = [
  ["name", (row) => row.name], ["method", (row) => row.method], ["poles", (row) => row.poles], ["zeros", (row) => row.zeros],
  ["delay", (row) => row.delay], ["fitEstimation", (row) => row.estimation?.fit], ["fitValidation", (row) => row.validation?.fit],
  ["R_T²", (row) => (row.validation ?? row.estimation)?.r_squared], ["YIC", (row) => row.estimation?.yic], ["condition", (row) => row.condition],
  ["white", (row) => (row.is_white === undefined ? null : say(row.is_white ? "yesWord" : "noWord"))],
  ["independent", (row) => (row.independent === undefined ? null : say(row.independent ? "noWord" : "yesWord"))],
];

function cellText(key, value, row) {
  if (typeof value !== "number") return value ?? "";
  if (key === "poles" || key === "zeros") return String(value);
  if (key === "delay" && row.delay_std) return `${shortNumber(value)} ± ${shortNumber(row.delay_std, 2)}`;
  return shortNumber(value, key === "condition" ? 2 : 4);
}

function renameModel(step) {
  const now = step.names[0], next = window.prompt(say("rename"), now)?.trim();
  if (!next || next === now || !/^[A-Za-z_]\w*$/.test(next)) return;
  const word = new RegExp(`(?<![\\w."])${now}(?!\\w)`, "g");
  change(() => ({ text: session.source.split("\n").map((line) => (/^\s*--(?! (off: |%%))/.test(line) ? line : line.replace(word, next))).join("\n") }));
}

/// The cell of a model alone goes with it.
function deleteModel(key) {
  change(() => {
    const step = stepOf(key);
    if (!step) return null;
    const lines = session.source.split("\n"), alone = /^-- %%/.test(lines[step.first_line - 2] ?? "") && /^(-- %%.*)?$/.test((lines[step.last_line] ?? "").trim());
    let first = alone ? step.first_line - 1 : step.first_line;
    if (alone && (lines[first - 2] ?? "").trim() === "") --first;
    return [{ first, last: step.last_line, text: "" }];
  });
}

export function modelsPanel() {
  const steps = modelSteps();
  if (steps.length === 0) return "";
  const rows = new Map((Array.isArray(session.views.models?.rows) ? session.views.models.rows : []).map((row) => [row.name, row]));
  const lines = steps.map((step) => ({ step, row: { ...(rows.get(step.names[0]) ?? {}), name: step.names[0], method: step.function || written(step).replace(/^.*?= /, "") } }));
  const column = COLUMNS.find(([key]) => key === sorting.key);
  if (column) lines.sort((a, b) => sorting.way * ((column[1](a.row) ?? -Infinity) > (column[1](b.row) ?? -Infinity) ? 1 : -1));
  const head = element("tr", {}, element("th", {}), ...COLUMNS.map(([key]) => {
    const cell = element("th", { scope: "col" });
    cell.append(button(say(key), () => { sorting = { key, way: sorting.key === key ? -sorting.way : 1 }; document.dispatchEvent(new Event("benchdraw")); }));
    if (sorting.key === key) cell.setAttribute("aria-sort", sorting.way > 0 ? "ascending" : "descending");
    return cell;
  }), element("th", {}));
  const body = lines.map(({ step, row }) => {
    const key = keyOf(step), line = element("tr", { className: chosenStep() === step ? "chosen" : "" });
    const shown = element("input", { type: "checkbox", checked: step.on && !isHidden(row.name), ariaLabel: `${say("shown")}: ${row.name}`, onchange: () => setHidden(row.name, !shown.checked) });
    line.append(element("td", {}, shown));
    for (const [name, read] of COLUMNS) {
      const value = read(row), cell = element("td", { className: typeof value === "number" ? "number" : "" });
      if (name === "name") cell.append(button(row.name, () => { chosen = key; document.dispatchEvent(new Event("benchdraw")); }, { title: row.text ?? "" }));
      else cell.append(cellText(name, value, row));
      line.append(cell);
    }
    const error = session.error && session.error.line >= step.first_line && session.error.line <= step.last_line;
    if (error) line.classList.add("broken");
    line.append(element("td", {}, button(say("copy"), () => change(() => {
      const name = freeName("G");
      return [newCell(name, written({ ...structuredClone(step), names: [name] }))];
    }), { ariaLabel: `${say("copy")}: ${row.name}` }), button(say("rename"), () => renameModel(step), { ariaLabel: `${say("rename")}: ${row.name}` }),
      button("×", () => deleteModel(key), { ariaLabel: `${say("remove")}: ${row.name}` })));
    return line;
  });
  return element("section", { className: "models" }, element("h2", { textContent: say("models") }), element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)));
}
