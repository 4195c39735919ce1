// Reading a step response by hand: marks in its picture are the numbers of a line.
import { change, session } from "./bench_session.js";
import { button, element, hold, why } from "./bench_fields.js";
import { keyOf, luaNumber, newCell, roles, stepOf, freeName } from "./bench_steps.js";
import { addModel } from "./bench_choice.js";
import { reveal } from "./bench_views.js";
import { say } from "./bench_words.js";

const MODELS = {
  first: (r) => `tf({${r}.K}, {${r}.T, 1})`,
  delayed: (r) => `tf({${r}.K}, {${r}.T, 1}, {IODelay = ${r}.Td})`,
  second: (r) => `tf({${r}.K*${r}.w0^2}, {1, 2*${r}.z*${r}.w0, ${r}.w0^2})`,
};
const HELP = { first: "step_first_order", second: "step_second_order", delayed: "step_delayed" };
const PARAMETERS = ["K", "T", "Td", "z", "w0"];

function begin(kind) {
  const found = session.views.advice.readings[kind];
  const numbers = ["start", "rest", "change", ...PARAMETERS].filter((name) => typeof found[name] === "number").map((name) => `${name} = ${luaNumber(found[name].toPrecision(4))}`);
  change(() => {
    const name = freeName("reading");
    return [newCell(name, `${name} = {kind = "${kind}", ${numbers.join(", ")}}\n${name}_model = ${MODELS[kind](name)}`)];
  }).then(() => reveal("reading"));
}

const readingStep = () => session.steps.find((step) => step.on && step.names[0] === roles().reading);
function put(numbers, how) {
  const step = readingStep(), key = step && keyOf(step);
  change(() => {
    const now = key && stepOf(key);
    if (!now) return null;
    let text = now.arguments[0];
    for (const [name, value] of Object.entries(numbers)) text = text.replace(new RegExp(`\\b${name} = [-+.\\deE]+`), `${name} = ${luaNumber(Number(value).toPrecision(4))}`);
    return text === now.arguments[0] ? null : [{ first: now.first_line, last: now.last_line, text: `${now.names[0]} = ${text}` }];
  }, how);
}
const ours = (name) => name.startsWith("reading-");

let hand = null, last = {};
document.addEventListener("slidermove", ({ detail }) => {
  if (!Object.keys(detail).every(ours)) return;
  last = Object.fromEntries(Object.entries(detail).map(([name, value]) => [name.slice(8), value]));
  if (!hand) hold(true);
  hand ??= {};
  put(last, { hand, held: true });
});
for (const name of ["pointerup", "pointercancel"]) document.addEventListener(name, () => {
  if (!hand) return;
  put(last, { hand });
  change(() => ({ text: session.source }), { hand });  // the file follows
  hand = null;
  hold(false);
});
document.addEventListener("sliderstep", ({ detail: { name, by } }) => {
  if (!ours(name)) return;
  const parameter = name.slice(8), now = new RegExp(`\\b${parameter} = ([-+.\\deE]+)`).exec(readingStep()?.arguments[0] ?? "");
  if (now) put({ [parameter]: Number(now[1]) * (1 + 0.02 * by) });
});

export function readingPanel() {
  const { raw, reading, estimation } = roles();
  if (!raw) return "";
  const node = element("details", { className: "panel", open: Boolean(reading) }, element("summary", { textContent: say("reading") }));
  const found = session.views.advice?.readings ?? {};
  const kinds = Object.keys(MODELS).filter((kind) => found[kind]);
  if (kinds.length === 0) node.append(element("p", { className: "faint", textContent: say("noStep") }));
  for (const kind of kinds) node.append(button(say("shape" + kind[0].toUpperCase() + kind.slice(1)), () => begin(kind)), why(HELP[kind]));
  if (reading) {
    const kind = /kind = "(\w+)"/.exec(readingStep()?.arguments[0] ?? "")?.[1];
    node.append(element("p", {}, button(say("estimateHere"), () => addModel(`tfsrivc(${estimation}, ${reading}_model${kind === "delayed" ? "" : ", {TdMax = 0}"})`), { className: "main" }), why("tfsrivc")));
  }
  return node;
}
