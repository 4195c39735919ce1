// What a script's steps are to the workbench, and the edits that change them. A step is written as app/workbench/session_script.h
// reads it.
import { session } from "/bench_session.js";

const PREPARING = ["detrend", "idfilt", "resample", "fillmissing", "filloutliers", "remove_mean", "keep", "discard", "shift"];

const kWidest = 88;  // characters of a line that a report prints unbroken

/// Pieces behind a beginning, in as many lines as they need.
function inLines(begin, pieces, end) {
  const one = begin + pieces.join(", ") + end;
  if (one.length <= kWidest) return one;
  const lines = [begin.trimEnd()];
  for (const [i, piece] of pieces.entries()) {
    const text = piece + (i + 1 < pieces.length ? "," : end), last = lines.length - 1;
    if (lines[last].length + text.length + 1 <= kWidest) lines[last] += (lines[last].endsWith("{") || lines[last].endsWith("(") ? "" : " ") + text;
    else lines.push("  " + text);
  }
  return lines.join("\n");
}

export function written(step) {
  const options = step.options.map(({ key, text }) => `${key} = ${text}`);
  const before = (step.on ? "" : "-- off: ") + (step.local ? "local " : "") + (step.names.length ? step.names.join(", ") + " = " : "");
  const call = (step.receiver ? step.receiver + ":" : "") + step.function;
  if (!step.function) return before + step.arguments[0];
  if (step.braces) return inLines(`${before}${call}{`, options, "}");
  if (options.length === 0 || !step.on) return `${before}${call}(${[...step.arguments, ...(options.length > 0 ? [`{${options.join(", ")}}`] : [])].join(", ")})`;
  return inLines(`${before}${call}(${step.arguments.map((text) => text + ", ").join("")}{`, options, "})");
}

export const replaced = (step, change) => ({ first: step.first_line, last: step.last_line, text: written({ ...structuredClone(step), ...change }) + step.rest });
export const removed = (step) => ({ first: step.first_line, last: step.last_line, text: "" });
export const insertedBehind = (line, text) => ({ first: line + 1, last: line, text });

/// A step is known again after an edit by what it gives a name to and its place among those that do.
export const keyOf = (step) => `${step.names.join(",")}#${session.steps.filter((other) => other.names.join(",") === step.names.join(",")).indexOf(step)}`;
export const stepOf = (key) => session.steps.find((step) => keyOf(step) === key);

export const variables = () => session.views.variables ?? {};
const isData = (name) => variables()[name]?.kind === "data";
export const formOf = (name) => session.forms.find((form) => form.name === name);

const uses = (step) => (step.receiver ? [step.receiver] : []).concat(step.arguments);
const last = (list) => list[list.length - 1];

/// The names that parts of a session have in this script.
export function roles() {
  const steps = session.steps.filter((step) => step.on);
  const named = (...names) => names.find((name) => steps.some((step) => step.names.includes(name)));
  const estimators = steps.filter((step) => formOf(step.function) && step.arguments.length > 0);
  const raw = steps.find((step) => step.function === "iddata")?.names[0] ?? Object.keys(variables()).find(isData);
  const prepared = named("prepared") ?? raw;
  const estimation = named("estimation", "ze") ?? last(estimators)?.arguments[0].match(/^\w+$/)?.[0] ?? prepared;
  const validation = named("validation", "zv", "val") ?? estimation;
  const orders = last(steps.filter((step) => step.function === "srivcstruc"))?.names[0];
  const study = last(steps.filter((step) => step.function === "montecarlo"))?.names[0];
  const reading = last(steps.filter((step) => !step.function && /^\{\s*kind = "(first|second|delayed)"/.test(step.arguments[0])))?.names[0];
  return { raw, prepared, estimation, validation, orders, study, reading };
}

/// Models that were estimated or written down; not the true system of a study.
export function modelSteps() {
  const seen = variables(), truths = session.steps.flatMap((step) => step.options.filter(({ key }) => key === "system").map(({ text }) => text));
  return session.steps.filter((step) => step.names.length > 0 && !truths.includes(step.names[0]) &&
                                        (formOf(step.function) || seen[step.names[0]]?.kind === "model"));
}

export function preparingSteps() {
  const { prepared, raw } = roles();
  return session.steps.filter((step) => step.names[0] === prepared && prepared !== raw && PREPARING.includes(step.function));
}

/// The last line of the cell in which a line stands, without the empty ones at its end.
export function endOfCell(line) {
  const next = session.cells.map((cell) => cell.line).sort((a, b) => a - b).find((first) => first > line);
  const lines = session.source.split("\n");
  let end = next === undefined ? lines.length : next - 2;  // the marker stands before a cell's first line
  while (end > line && (lines[end - 1] ?? "").trim() === "") --end;
  return end;
}
export function endOfScript() {
  const lines = session.source.split("\n");
  let end = lines.length;
  while (end > 0 && lines[end - 1].trim() === "") --end;
  return end;
}

const taken = (name) => session.steps.some((step) => step.names.includes(name)) || session.cells.some((cell) => cell.id === name);
export function freeName(stem) {
  let k = 1;
  while (taken(stem + k)) ++k;
  return stem + k;
}
/// A cell of its own at the end.
export const newCell = (id, text) => insertedBehind(endOfScript(), `\n-- %% id=${id}\n${text}`);

/// Text of a number as a script has it.
export const luaNumber = (value) => String(Number(Number(value).toPrecision(6)));
export const luaText = (text) => JSON.stringify(text);
