// The steps that prepare the data, and the parts for estimation and validation.
import { change, session } from "./bench_session.js";
import { button, choice, element, isNumber, numberField, textField, why } from "./bench_fields.js";
import { insertedBehind, keyOf, preparingSteps, removed, replaced, roles, variables, written } from "./bench_steps.js";
import { divide, movedParts, preparedAlike, preparedNow } from "./bench_parts.js";
import { say, shortNumber } from "./bench_words.js";

/// `make(steps)` returns {edits, after}: edits of the preparation steps, and the steps after these edits. Parts and a
/// second data set follow.
function prepare(make, how) {
  return change(() => {
    const before = preparingSteps(), made = make(before);
    return made && [...made.edits, ...movedParts(before, made.after), ...preparedAlike(made.after)];
  }, how);
}

/// Appends a step to the preparation steps; the data get a new name for it if they have none yet. `call(z)` returns
/// function, arguments and receiver for the data z.
export function addPreparing(call) {
  prepare((steps) => {
    const { raw, prepared } = roles(), fresh = prepared === raw, from = fresh ? raw : prepared, name = fresh ? "prepared" : prepared;
    const step = { names: [name], receiver: "", options: [], on: true, ...call(from) };
    const before = fresh ? session.steps.find((one) => one.names[0] === raw) : steps[steps.length - 1] ?? session.steps.find((one) => one.names[0] === prepared);
    return before && { edits: [insertedBehind(before.last_line, (fresh ? "\n" : "") + written(step))], after: [...steps, step] };
  });
}

const calls = (name, ...rest) => (z) => ({ function: name, arguments: [z, ...rest.map((text) => (typeof text === "function" ? text(z) : text))] });
const NEW_STEPS = {
  level: calls("detrend", "\"mean\""), trend: calls("detrend", "\"linear\""), filter: calls("idfilt", () => `{0, ${luaCut()}}`),
  resample: calls("resample", "1", "2"), outliers: calls("filloutliers"),
  range: (z) => ({ receiver: z, function: "range", arguments: ["1", String(preparedNow().N)] }),
};
/// A tenth of the highest frequency.
function luaCut() {
  return String(Number((0.1 * Math.PI / preparedNow().Ts).toPrecision(3)));
}
/// What a button beside a finding of advice does: the remedy as a step.
export const REMEDIES = {
  offset: [calls("detrend", "\"mean\""), calls("detrend", "\"start\"")], drift: [calls("detrend", "\"linear\"")], random_walk: [calls("detrend", "\"linear\"")],
  outliers: [calls("filloutliers")], fast_sampling: [calls("resample", "1", "10")],
};
export const callWords = ({ function: name, arguments: list }) => `${name}(${["…", ...list.slice(1)].join(", ")})`;

function preparingStep(step, all) {
  const key = keyOf(step), at = all.indexOf(step);
  const row = element("li", { className: step.on ? "" : "off" });
  const now = (steps) => steps.find((one) => keyOf(one) === key);
  const alter = (make) => prepare((steps) => {
    const old = now(steps), next = old && { ...structuredClone(old), ...make(old) };
    return old && { edits: [replaced(old, next)], after: steps.map((one) => (one === old ? next : one)) };
  });
  const on = element("input", { type: "checkbox", checked: step.on, ariaLabel: say("labeled", say("off"), step.function) });
  on.onchange = () => alter(() => ({ on: on.checked }));
  row.append(on, element("code", { textContent: step.function }));
  const first = step.receiver ? 0 : 1;
  step.arguments.slice(first).forEach((text, i) => {
    const act = (value) => alter((old) => ({ arguments: old.arguments.map((one, k) => (k === i + first ? value : one)) }));
    const field = step.function === "detrend" ? choice(["\"mean\"", "\"linear\"", "\"start\""], text, act, ["mean", "linear", "start"])
      : isNumber(text) ? numberField(text, act, { slider: false }) : textField(text, act);
    field.ariaLabel = say("labeled", step.function, `${say("argument")} ${i + 1}`);
    row.append(field);
  });
  const swap = (other) => prepare((steps) => {
    const one = now(steps), two = steps.find((each) => keyOf(each) === other), [above, below] = one.first_line < two.first_line ? [one, two] : [two, one];
    const lines = (each) => session.source.split("\n").slice(each.first_line - 1, each.last_line).join("\n");
    return { edits: [{ first: above.first_line, last: below.last_line, text: `${lines(below)}\n${lines(above)}` }],
             after: steps.map((each) => (each === one ? two : each === two ? one : each)) };
  });
  if (at > 0 && all[at - 1].last_line + 1 === step.first_line) row.append(button("↑", () => swap(keyOf(all[at - 1])), { ariaLabel: say("labeled", say("up"), step.function) }));
  if (at + 1 < all.length && step.last_line + 1 === all[at + 1].first_line) row.append(button("↓", () => swap(keyOf(all[at + 1])), { ariaLabel: say("labeled", say("down"), step.function) }));
  const remove = () => prepare((steps) => now(steps) && { edits: [removed(now(steps))], after: steps.filter((one) => one !== now(steps)) });
  row.append(button("×", remove, { ariaLabel: say("labeled", say("remove"), step.function) }), why(step.receiver ? "iddata" : step.function));
  return row;
}

export function preparationPanel() {
  const { raw } = roles();
  if (!raw) return "";
  const steps = preparingSteps();
  const list = element("ol", { className: "preparing" }, ...steps.map((step) => preparingStep(step, steps)));
  const adding = element("div", { className: "adding" }, ...Object.entries(NEW_STEPS).map(([name, call]) => button(`+ ${say(name + "Step")}`, () => addPreparing(call), { disabled: !preparedNow() })));
  return element("section", { className: "panel" }, element("h2", { textContent: say("preparation") }), list, adding);
}

export function partsPanel() {
  const { raw, estimation, validation, prepared, second } = roles();
  if (!raw) return "";
  const node = element("section", { className: "panel" }, element("h2", { textContent: say("parts") }));
  const seen = variables(), a = seen[estimation], b = seen[validation];
  const same = estimation === validation || (!second && a && b && a.start === b.start && a.last === b.last && a.N === b.N);
  const about = (name, data, more = "") => node.append(element("p", { textContent: say("labeled", name, `${shortNumber(data.start)} … ${shortNumber(data.last)} s (${data.N})${more}`) }));
  if (a?.kind === "data") about(estimation, a);
  if (b?.kind === "data") about(validation, b, second ? ` – ${say("ofRecord", second)}` : "");
  if (b?.kind === "data" && (a?.outputs !== b.outputs || a?.inputs !== b.inputs)) node.append(element("p", { className: "warning", textContent: say("otherValidation") }));
  if (same) node.append(element("p", { className: "warning", textContent: say("sameParts") }));
  if (second && preparedAlike().length > 0) node.append(element("p", { className: "warning" }, say("notAlike"), " ", button(say("prepareAlike"), () => change(() => preparedAlike()))));
  const left = second ? ` (${say("without", second)})` : "";
  if (seen[prepared]?.kind === "data") node.append(button(say("divide") + left, () => divide(0.6)), button(say("whole") + left, () => divide(1)));
  return node;
}
