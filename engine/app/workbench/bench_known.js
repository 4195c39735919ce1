// A system that is known, an input, noise, and what estimators make of it: the cloud of their estimates grows while one looks.
import { change, session } from "./bench_session.js";
import { button, element, labeled, longField, numberField, rewrite, textField, why, withOption } from "./bench_fields.js";
import { formOf, freeName, keyOf, newCell, stepOf, written } from "./bench_steps.js";
import { say } from "./bench_words.js";

const kFew = 25;  // runs while a hand is at a control
const optionOf = (step, name) => step.options.find(({ key }) => key === name)?.text ?? "";

let growth = null;  // behind a hand at a study: {all}, the runs that it comes to in the end

/// A number of the study: few runs during dragging, then more and more until all runs are done, or until the user
/// enters another number of runs.
function dragged(key, make) {
  return async (text, how = {}) => {
    const step = stepOf(key);
    if (!step) return;
    const mine = growth = { all: growth?.all ?? Number(optionOf(step, "runs")) }, hand = how.hand ?? {};
    const runsOf = (count) => String(Math.min(count, mine.all));
    const write = (count, before) => rewrite(key, (step) => {
      if (growth !== mine) return null;
      if (before && optionOf(step, "runs") !== before) return growth = null;
      const next = { ...step, ...make(step, text) };
      return { ...next, ...withOption(next, "runs", runsOf(count)) };
    }, { hand, held: how.held });
    if (how.held) return write(kFew);
    for (let count = kFew, before = null; growth === mine; count *= 2) {
      await write(count, before);
      before = runsOf(count);
      if (count >= mine.all && growth === mine) growth = null;
      await new Promise((yes) => setTimeout(yes, 60));
    }
  };
}

/// The expression that a name of the study refers to, in a separate line.
function defined(study, name, words) {
  const value = optionOf(study, name), step = session.steps.find((one) => one.on && one.names[0] === value);
  if (!step) return labeled(words, textField(value, (text) => rewrite(keyOf(study), (now) => withOption(now, name, text))));
  const place = keyOf(step), right = step.function ? written(step).replace(/^[^=]*= /, "") : step.arguments[0];
  return labeled(words, textField(right, (text) => change(() => {
    const now = stepOf(place);
    return now ? [{ first: now.first_line, last: now.last_line, text: `${now.names[0]} = ${text}` }] : null;
  })));
}

/// The first lambda of the estimators, if they contain one.
function lambdaControl(key, study) {
  const found = /(lambda = )([\d.eE+-]+)/.exec(optionOf(study, "estimators"));
  if (!found) return "";
  const make = (step, text) => withOption(step, "estimators", optionOf(step, "estimators").replace(/(lambda = )[\d.eE+-]+/, `$1${text}`));
  return labeled("lambda (rad/s)", numberField(found[2], dragged(key, make)));
}

/// The estimators with their arguments, and what these are called in each of them.
function estimatorsControl(key, study) {
  const text = optionOf(study, "estimators"), named = [...new Set([...text.matchAll(/(\w+) = \{/g)].map(([, name]) => name))].map(formOf).filter(Boolean);
  const call = (form) => `${form.name} {${form.arguments.map((field) => (field.parts.length > 0 ? `{${field.parts.join(", ")}}` : field.name)).join(", ")}}`;
  const field = longField(text, (now) => rewrite(key, (step) => withOption(step, "estimators", now)));
  return element("div", { className: "tall" }, labeled("estimators", field), element("small", { textContent: named.map(call).join("; ") }));
}

function begin() {
  change(() => {
    const name = freeName("study"), k = name.slice(5);
    return [newCell(name, [`s = tf("s")`, `system${k} = 2/(s^2 + 4*s + 3)`, `input${k} = prbs(6, 8)`,
      `${name} = montecarlo{system = system${k}, input = input${k}, Ts = 0.05, sigma = 0.1, runs = 200,`, "  estimators = {srivc = {{1, 2, 0}, {lambda = 3}}}}"].join("\n"))];
  });
}

export function knownPanel() {
  const study = [...session.steps].reverse().find((step) => step.on && step.function === "montecarlo");
  const node = element("details", { className: "panel", open: Boolean(study) }, element("summary", { textContent: say("known") }));
  if (!study) {
    node.append(button(say("begin"), begin), why("montecarlo"));
    return node;
  }
  const key = keyOf(study);
  const number = (name, words) => labeled(words, numberField(optionOf(study, name), dragged(key, (step, text) => withOption(step, name, text))));
  const plain = (name, words, field = textField) => labeled(words, field(optionOf(study, name), (text) => rewrite(key, (step) => withOption(step, name, text)), { slider: false }));
  node.append(defined(study, "system", say("system")), defined(study, "input", say("inputSignal")), number("Ts", "T_s (s)"), number("sigma", say("noise")),
              lambdaControl(key, study), plain("runs", say("runs"), numberField), estimatorsControl(key, study), why("montecarlo"));
  return node;
}
