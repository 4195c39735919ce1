// Which model's controls are shown, and new models, which become it.
import { change, session } from "./bench_session.js";
import { formOf, freeName, modelSteps, newCell, stepOf } from "./bench_steps.js";

let chosen = null;  // key of the step

export const redraw = () => document.dispatchEvent(new Event("benchdraw"));
export const chosenStep = () => (chosen && stepOf(chosen)) ?? [...modelSteps()].reverse().find((step) => formOf(step.function)) ?? null;
export function choose(key) {
  chosen = key;
  redraw();
}
/// A new cell with a model, a text or what a function gives in its turn; its controls are shown.
export function addModel(call) {
  return change(async () => {
    const text = typeof call === "function" ? await call() : call, name = freeName("G");
    chosen = `${name}#0`;
    return [newCell(name, `${name} = ${text}`)];
  });
}
/// After a rename: the same model by its other name.
export function rechoose(before, after) {
  if (chosen?.startsWith(`${before}#`)) chosen = chosen.replace(before, after);
}
export const rowOf = (step) => session.views.models?.rows?.find?.((row) => row.name === step.names[0]);
