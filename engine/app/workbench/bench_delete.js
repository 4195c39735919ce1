// Steps go from the script with what shows them.
import { change, session, trouble } from "./bench_session.js";
import { button } from "./bench_fields.js";
import { cellRemoval, keyOf, linesWith, modelSteps, replaced, stepOf } from "./bench_steps.js";
import { reportWithout } from "./bench_report.js";
import { say } from "./bench_words.js";

/// Calls that show models, and how many arguments they need to show anything.
const SHOWS = { compare: 2, resid: 2, impulseest: 1, step: 1, impulse: 1, bode: 1, nyquist: 1, pzmap: 1, present: 1 };
const isIn = (step, line) => line >= step.first_line && line <= step.last_line;

/// Deletes a step with the calls that show only this step, and takes it out of the calls that show others, too. Where another
/// step is computed from it, nothing is deleted: the page names that step, with a button that deletes it.
export function deleteStep(key) {
  return change(() => {
    const own = stepOf(key);
    if (!own) return null;
    const mine = session.steps.filter((step) => step === own || (own.names[0] && step.names[0] === `${own.names[0]}_model`));
    const names = mine.flatMap((step) => step.names), isElsewhere = session.steps.some((step) => !mine.includes(step) && step.names.some((name) => names.includes(name)));
    if (names.length === 0 || isElsewhere) return cellRemoval([own]);
    const shows = session.steps.filter((step) => step.names.length === 0 && SHOWS[step.function] && step.arguments.some((text) => names.includes(text)));
    const without = (step) => step.arguments.filter((text) => !names.includes(text));
    const empty = shows.filter((step) => without(step).length < SHOWS[step.function]), others = shows.filter((step) => !empty.includes(step));
    const report = reportWithout(names, modelSteps().map((step) => step.names[0]));
    const isFree = (line) => report.seen.has(line) || [...mine, ...shows].some((step) => isIn(step, line));
    for (const name of names) {
      const used = linesWith(name).find((line) => !isFree(line)), user = session.steps.find((step) => isIn(step, used));
      if (!used) continue;
      trouble(say("isUsed", name, used, session.source.split("\n")[used - 1].trim()), ...(user ? [deletion(user)] : []));
      return null;
    }
    return [...cellRemoval([...mine, ...empty]), ...others.map((step) => replaced(step, { arguments: without(step) })), ...report.edits];
  });
}
export function deletion(step) {
  const key = keyOf(step);
  return button(say("labeled", say("remove"), step.names[0] ?? step.function), () => deleteStep(key));
}
