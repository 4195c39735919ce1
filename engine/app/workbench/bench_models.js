// Estimating, and the table of models.
import { change, request, session } from "./bench_session.js";
import { button, choice, element, firstCall, labeled, rewrite, stepControls, textField, typeset, why } from "./bench_fields.js";
import { formOf, freeName, keyOf, linesWith, modelSteps, newCell, preparingSteps, roles, taken, variables, written } from "./bench_steps.js";
import { addModel, choose, chosenStep, rechoose, redraw, rowOf } from "./bench_choice.js";
import { help } from "./bench_help.js";
import { drawnModels, firstOrders, isHidden, reveal, setHidden } from "./bench_views.js";
import { deleteStep } from "./bench_delete.js";
import { say, shortNumber } from "./bench_words.js";

let method = "tfsrivc";  // that a new model will have
let sorting = { key: null, way: 1 };

function methodList(act, now, name) {
  const list = element("select", { ariaLabel: name, onchange: () => act(list.value) });
  for (const domain of ["continuous", "discrete"]) {
    const group = element("optgroup", { label: domain });
    for (const form of session.forms.filter((one) => one.domain === domain)) group.append(element("option", { value: form.name, textContent: `${form.name} — ${form.structure}`, title: form.summary }));
    list.append(group);
  }
  list.value = now;
  return list;
}

function estimateNew(method) {
  const form = session.forms.find((one) => one.name === method);
  let orders = null;  // asked for once, however often the script is changed elsewhere meanwhile
  addModel(async () => {
    const { estimation } = roles(), usual = firstCall(form, estimation);
    if (method !== "tfsrivc" || modelSteps().some((step) => formOf(step.function))) return usual;
    orders ??= await firstOrders();
    return orders.length > 0 ? `tfsrivc(${[estimation, ...orders].join(", ")}, {TdMax = 0})` : usual;
  });
}

let searched = 1;  // the output whose structures are compared
/// Structures are compared for one output; with several one says which.
function searchControls() {
  const part = roles(), seen = variables()[part.estimation], names = seen?.output_names ?? [], output = Math.min(searched, names.length || 1);
  const select = names.length > 1 ? `:select(${output})` : "", apart = part.validation !== part.estimation ? `, validate = ${part.validation}${select}` : "";
  const search = () => change(() => {
    const name = freeName("orders");
    return [newCell(name, `${name} = srivcstruc(${part.estimation}${select}, {poles = {1, 4}, zeros = {0, 2}${apart}})`)];
  }).then(() => reveal("orders"));
  const several = seen?.inputs > 1, list = names.length > 1 && !several ? choice(names.map((_, i) => String(i + 1)), String(output), (value) => { searched = Number(value); redraw(); }, names) : "";
  if (list) list.ariaLabel = say("ofOutput");
  return [button(say("search"), search, { disabled: several }), list, why("srivcstruc"), several ? element("small", { textContent: say("oneInput") }) : ""];
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

const isMistake = (step) => session.error && session.error.line >= step.first_line && session.error.line <= step.last_line;

/// What the server says of the step's line: its mistake, or its model's own message.
function verdictOf(step) {
  if (isMistake(step)) return [session.error.text ?? session.error.message, "broken"];
  return [rowOf(step)?.message ?? "", ""];
}

export function estimatePanel() {
  if (!roles().raw) return "";
  const node = element("section", { className: "panel" }, element("h2", { textContent: say("estimate") }));
  const quick = element("div", { className: "adding" });
  const list = methodList((name) => { method = name; }, method, say("method"));
  quick.append(labeled(say("method"), list), button(say("newModel"), () => estimateNew(list.value), { className: "main" }),
               button(say("why"), () => help(list.value), { className: "why", ariaLabel: `${say("why")} ${say("method")}` }));
  quick.append(...searchControls());
  node.append(quick);
  const step = chosenStep();
  if (step) {
    const key = keyOf(step), form = session.forms.find((one) => one.name === step.function), name = step.names[0];
    const box = element("div", { className: "chosen" }, element("h3", { textContent: name }));
    if (form) box.append(methodList((method) => exchangeMethod(key, method), step.function, say("methodOf", name)), why(step.function), element("p", { className: "faint", textContent: `${form.structure}; ${form.noise}` }), stepControls(key, step));
    else box.append(labeled(`${name} =`, textField(rightSide(step), (text) => rewrite(key, () => ({ receiver: "", function: "", options: [], braces: false, arguments: [text] })))));
    for (const trap of trapsOf(step, form)) box.append(element("p", { className: "warning", textContent: trap }));
    const [words, kind] = verdictOf(step);
    if (words) box.append(element("p", { className: kind, textContent: words }));
    node.append(box);
  }
  return node;
}
/// What is easily taken for something else: fits of predictions for those of simulations, two delays for one.
function trapsOf(step, form) {
  const predicts = form?.domain === "discrete" && /^A y = B u \+ (C )?e$|C\/D e/.test(form.structure);
  const shift = preparingSteps().find((one) => one.on && one.function === "shift"), delay = rowOf(step)?.delay;
  return [...(predicts ? [say("predicts")] : []), ...(shift && delay > 0 ? [say("twoDelays", shift.arguments.at(-1), shortNumber(delay))] : [])];
}
const rightSide = (step) => (step.function ? written({ ...step, names: [], local: false, on: true }) : step.arguments[0]);

const ALL_COLUMNS = [
  ["name", (row) => row.name], ["method", (row) => row.method], ["output_", (row) => row.output_name], ["poles", (row) => row.poles], ["zeros", (row) => row.zeros],
  ["delay", (row) => row.delay], ["fitEstimation", (row) => row.estimation?.fit], ["fitValidation", (row) => row.validation?.fit],
  ["R_T^2", (row) => (row.validation ?? row.estimation)?.r_squared], ["YIC", (row) => row.estimation?.yic], ["condition", (row) => row.condition],
  ["white", (row) => (row.is_white === undefined ? null : say(row.is_white ? "yesWord" : "noWord"))],
  ["independent", (row) => (row.independent === undefined ? null : say(row.independent ? "noWord" : "yesWord"))],
];

function cellText(key, value, row) {
  if (typeof value !== "number") return value ?? "";
  if (key === "poles" || key === "zeros") return String(value);
  if (key === "delay" && row.delay_std) return `${shortNumber(value)} ± ${shortNumber(row.delay_std, 2)}`;
  return shortNumber(value, key === "condition" ? 2 : 4);
}

const KEYWORDS = "and break do else elseif end false for function goto if in local nil not or repeat return then true until while".split(" ");
/// Why a model cannot be called so; null where it can.
async function unfit(name) {
  if (!/^[A-Za-z_]\w*$/.test(name) || KEYWORDS.includes(name)) return say("noName");
  if (taken(name) || linesWith(name).length > 0) return say("nameTaken");
  return (await request(`help?name=${encodeURIComponent(name)}`)).ok ? say("nameOfFunction") : null;
}
function renameModel(step) {
  const now = step.names[0], dialog = document.getElementById("rename"), box = document.getElementById("new-name"), told = document.getElementById("name-trouble");
  document.getElementById("rename-title").textContent = say("labeled", say("rename"), now);
  Object.assign(box, { value: now, ariaLabel: say("newName") });
  told.textContent = "";
  dialog.querySelector("form").onsubmit = async (event) => {
    event.preventDefault();
    const next = box.value.trim(), wrong = next === now ? null : await unfit(next);
    told.textContent = wrong ? say("labeled", next, wrong) : "";
    if (wrong) return;
    dialog.close();
    if (next !== now) rename(now, next);
  };
  document.getElementById("give-up").onclick = () => dialog.close();
  dialog.showModal();
  box.select();
}
function rename(now, next) {
  const word = new RegExp(`(?<![\\w."])${now}(?!\\w)`, "g"), label = new RegExp(`"${now}(?=[",])`, "g");
  const renamed = (line) => (/labels = \{|^\s*\{"/.test(line) ? line.replace(label, `"${next}`) : line).replace(word, next);
  rechoose(now, next);
  change(() => ({ text: session.source.split("\n").map((line) => (/^\s*--(?! (off: |%%))/.test(line) ? line : renamed(line))).join("\n") }));
}

function actionsOf(step) {
  const key = keyOf(step), name = step.names[0];
  const act = (word, does) => button(say(word), does, { ariaLabel: say("labeled", say(word), name) });
  return element("span", { className: "actions" }, element("b", { textContent: name }),
    act("copy", () => change(() => {
      const other = freeName("G");
      return [newCell(other, written({ ...structuredClone(step), names: [other] }))];
    })), act("rename", () => renameModel(step)), act("remove", () => deleteStep(key)));
}

export function modelsPanel() {
  const steps = modelSteps();
  if (steps.length === 0) return "";
  const rows = Array.isArray(session.views.models?.rows) ? session.views.models.rows : [];
  const COLUMNS = ALL_COLUMNS.filter(([key]) => key !== "output_" || rows.some((row) => row.output_name));
  const rowsOf = (name) => { const own = rows.filter((row) => row.name === name); return own.length > 0 ? own : [{}]; };
  const lines = steps.map((step) => {
    const all = rowsOf(step.names[0]).map((row) => ({ ...row, name: step.names[0], method: step.function || rightSide(step) }));
    return { step, row: all[0], all };
  });
  const column = COLUMNS.find(([key]) => key === sorting.key);
  if (column) lines.sort((a, b) => sorting.way * ((column[1](a.row) ?? -Infinity) > (column[1](b.row) ?? -Infinity) ? 1 : -1));
  const head = element("tr", {}, element("th", { scope: "col", textContent: "✓", title: say("shown"), ariaLabel: say("shown") }), ...COLUMNS.map(([key]) => {
    const cell = element("th", { scope: "col" });
    cell.append(button("", () => { sorting = { key, way: sorting.key === key ? -sorting.way : 1 }; redraw(); }, { title: say(`${key}About`) }));
    cell.firstChild.append(...typeset(say(key)));
    if (sorting.key === key) cell.setAttribute("aria-sort", sorting.way > 0 ? "ascending" : "descending");
    return cell;
  }));
  const chosen = chosenStep();
  const body = lines.flatMap(({ step, all }) => all.map((row, i) => {
    const line = element("tr", { className: chosen === step ? "chosen" : "" }), span = (cell) => Object.assign(cell, { rowSpan: all.length });
    const shown = element("input", { type: "checkbox", checked: step.on && !isHidden(row.name), ariaLabel: say("labeled", say("shown"), row.name), onchange: () => setHidden(row.name, !shown.checked) });
    if (i === 0) line.append(span(element("td", {}, shown)));
    for (const [name, read] of COLUMNS) {
      if (i > 0 && ["name", "method"].includes(name)) continue;
      const value = read(row), cell = element("td", { className: typeof value === "number" ? "number" : name });
      if (name === "name") cell.append(button(row.name, () => choose(keyOf(step)), { title: row.text ?? "", ariaPressed: String(chosen === step) }));
      else cell.append(cellText(name, value, row));
      if (name === "method") cell.title = row.method;
      line.append(["name", "method"].includes(name) ? span(cell) : cell);
    }
    if (isMistake(step)) line.classList.add("broken");
    return line;
  }));
  const ticked = steps.filter((step) => step.on && !isHidden(step.names[0])).length, drawn = drawnModels().length;
  const few = drawn < ticked ? [element("p", { className: "warning", textContent: say("fewDrawn", drawn, ticked) })] : [];
  const legend = element("details", {}, element("summary", { textContent: say("columns") }), element("dl", {}, ...COLUMNS.flatMap(([key]) => [element("dt", {}, ...typeset(say(key))), element("dd", { textContent: say(`${key}About`) })])));
  const node = element("section", { className: "models", tabIndex: -1, ariaLabel: say("models") }, element("h2", {}, say("models"), " ", chosen ? actionsOf(chosen) : ""),
    ...few, element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)), legend);
  return node;
}
