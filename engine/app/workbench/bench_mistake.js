// The mistake at which the script stops, at the step that made it, with buttons that fix or delete the step.
import { session } from "./bench_session.js";
import { button, rewrite, withOption } from "./bench_fields.js";
import { choose } from "./bench_choice.js";
import { deletion } from "./bench_delete.js";
import { showLine } from "./bench_script.js";
import { formOf, keyOf, variables } from "./bench_steps.js";
import { say } from "./bench_words.js";

export const stepAt = (line) => session.steps.find((step) => line >= step.first_line && line <= step.last_line);

/// An order search whose data set now has several outputs.
function orphanedSearch(step) {
  const data = step.function === "srivcstruc" ? variables()[step.arguments[0]] : null;
  if (!(data?.outputs > 1)) return null;
  const key = keyOf(step), validate = step.options.find((option) => option.key === "validate")?.text;
  const search = (i) => rewrite(key, (now) => ({ arguments: [`${now.arguments[0]}:select(${i})`, ...now.arguments.slice(1)], ...(validate ? withOption(now, "validate", `${validate}:select(${i})`) : {}) }));
  return [say("ordersOfOne", step.names[0] ?? step.function, step.arguments[0], data.output_names.join(", ")),
          ...(data.inputs > 1 ? [] : data.output_names.map((name, i) => button(say("searchOne", name), () => search(i + 1))))];
}

/// The words and the controls that the page shows for a mistake.
export function mistakeWords({ message, place, text, line }) {
  const step = stepAt(line), toLine = line > 0 ? [button(say("showLine"), () => showLine(line))] : [];
  if (!step) return [message, ...toLine];
  const controls = formOf(step.function) && step.names.length > 0 ? [button(say("showControls"), () => choose(keyOf(step)))] : [];
  const known = orphanedSearch(step) ?? [say("atStep", step.names[0] ?? step.function, place, text), ...controls];
  return [...known, ...toLine, deletion(step)];
}
