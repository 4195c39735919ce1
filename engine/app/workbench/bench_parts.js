// The parts of the data for estimation and validation: samples of the prepared data, or a second data set for
// validation.
import { change, session } from "./bench_session.js";
import { cellRemoval, isPreparing, linesWith, newCell, preparingSteps, replaced, roles, variables, written } from "./bench_steps.js";

const dataOf = (name) => variables()[name];
const kFewest = 10;  // samples of a part

/// The step that names a part of the data, if the part has a separate name.
function partStep(kind) {
  const part = roles(), name = part[kind];
  if (!name || name === part.prepared || name === part.raw || (kind === "validation" && name === part.estimation)) return null;
  return session.steps.find((step) => step.on && step.names.length === 1 && step.names[0] === name) ?? null;
}

/// [from, to] of the parts, in seconds of their data set. A second data set has no part here.
export function partsNow() {
  const part = roles(), parts = {};
  for (const kind of part.second ? ["estimation"] : ["estimation", "validation"]) {
    const data = dataOf(partStep(kind)?.names[0] ?? part.prepared);
    if (data?.kind === "data") parts[kind] = [data.start, data.last];
  }
  return parts;
}

/// Sets a part to the dragged range: samples of the prepared data, or all of it by its name.
let hand = null;
export function movePart(kind, [from, to], held) {
  const { prepared } = roles(), data = dataOf(prepared);
  if (data?.kind !== "data") return;
  const sample = (instant) => Math.min(Math.max(Math.round((instant - data.start) / data.Ts) + 1, 1), data.N);
  const first = sample(from), final = Math.min(Math.max(sample(to), first + kFewest - 1), data.N);
  const whole = first === 1 && final === data.N;
  const value = whole ? { receiver: "", function: "", arguments: [prepared] } : { receiver: prepared, function: "range", arguments: [String(first), String(final)] };
  hand ??= {};
  change(() => {
    const step = partStep(kind);
    return [step ? replaced(step, { ...value, options: [] }) : newCell(kind, `${kind} = ${whole ? prepared : `${prepared}:range(${first}, ${final})`}`)];
  }, { hand, held });
  if (!held) hand = null;
}

/// The lines behind `validation = second1` that prepare it, and that line.
function alikeBlock() {
  const { second, validation } = roles(), first = session.steps.findIndex((step) => step.on && step.names[0] === validation && step.names.length === 1);
  if (!second || first < 0 || session.steps[first].function || session.steps[first].arguments[0] !== second) return null;
  let last = first;
  while (isPreparing(session.steps[last + 1], validation)) ++last;
  return { name: validation, second, first: session.steps[first].first_line, last: session.steps[last].last_line };
}
/// Prepares a second data set like the first, without the step that selects samples of the first.
export function preparedAlike(steps = preparingSteps()) {
  const block = alikeBlock();
  if (!block) return [];
  const same = steps.filter((step) => step.on && step.function !== "range");
  const lines = same.map((step) => written({ ...step, names: [block.name], arguments: [block.name, ...step.arguments.slice(1)] }));
  const text = [`${block.name} = ${block.second}`, ...lines].join("\n");
  const now = session.source.split("\n").slice(block.first - 1, block.last).join("\n");
  return text === now ? [] : [{ first: block.first, last: block.last, text }];
}

/// The sampling grid of a data set after preparation steps.
function grid(steps, { N, Ts, start }) {
  for (const step of steps.filter((one) => one.on)) {
    const [a, b] = (step.receiver ? step.arguments : step.arguments.slice(1)).map(Number);
    if (step.function === "resample" && a > 0 && b > 0) [N, Ts] = [Math.floor((N - 1) * a / b) + 1, Ts * b / a];
    if (step.function === "range" && b >= a) [N, start] = [b - a + 1, start + (a - 1) * Ts];
  }
  return { N, Ts, start };
}
/// The sampling grid of the prepared data according to the script, which the last run may not have seen yet.
const UNTOLD = ["keep", "discard", "shift"];  // how many samples these leave
export function preparedNow() {
  const { raw, prepared } = roles(), data = dataOf(raw), steps = preparingSteps();
  return data?.kind === "data" && !steps.some((step) => UNTOLD.includes(step.function)) ? grid(steps, data) : dataOf(prepared);
}
/// Parts keep their place in time when the data are resampled or lose their ends. If too few samples of a part remain,
/// each part keeps its share of the data instead.
export function movedParts(before, after) {
  const { raw, prepared } = roles(), data = dataOf(raw);
  if (data?.kind !== "data") return [];
  const old = grid(before, data), now = grid(after, data);
  if (old.N === now.N && old.Ts === now.Ts && old.start === now.start) return [];
  const steps = ["estimation", "validation"].map(partStep).filter((step) => step?.receiver === prepared && step.function === "range" && step.arguments.every((text) => /^\d+$/.test(text)));
  const edge = (samples) => Math.min(Math.max(Math.ceil((old.start + samples * old.Ts - now.start) / now.Ts - 1e-6), 0), now.N);
  const kept = ([from, to]) => [edge(from - 1) + 1, edge(to)];  // where one part ends the next begins, as before
  const shared = ([from, to]) => [Math.floor((from - 1) * now.N / old.N) + 1, Math.floor(to * now.N / old.N)];
  const given = steps.map((step) => step.arguments.map(Number)), moved = given.map(kept);
  const result = moved.every(([from, to]) => to - from + 1 >= kFewest) ? moved : given.map(shared);
  return steps.map((step, i) => replaced(step, { arguments: result[i].map(String) }));
}

/// Both parts from the first data set: `share` of it for estimation, the rest for validation. A second data set is
/// removed, unless it is used elsewhere.
export function divide(share) {
  const { prepared } = roles(), { N } = preparedNow(), at = Math.round(share * N);
  const texts = { estimation: share < 1 ? `${prepared}:range(1, ${at})` : prepared, validation: share < 1 ? `${prepared}:range(${at + 1}, ${N})` : prepared };
  change(() => {
    const edits = [], fresh = [], block = alikeBlock();
    for (const [kind, text] of Object.entries(texts)) {
      const step = partStep(kind);
      if (kind === "validation" && block) edits.push({ ...withoutName(block), text: `${block.name} = ${text}` });
      else if (step) edits.push({ first: step.first_line, last: step.last_line, text: `${step.names[0]} = ${text}` });
      else fresh.push(`${kind} = ${text}`);
    }
    if (block) edits.push(...removalOfSecond(block));
    if (fresh.length > 0) edits.push(newCell("parts", fresh.join("\n")));
    return edits;
  });
}
const withoutName = ({ first, last }) => ({ first, last });
function removalOfSecond({ second, first, last }) {
  const own = session.steps.filter((step) => step.names[0] === second || step.names[0].startsWith(`${second}_file`));
  const isOurs = (line) => (line >= first && line <= last) || own.some((step) => line >= step.first_line && line <= step.last_line);
  return linesWith(second).every(isOurs) ? cellRemoval(own) : [];
}
