// What a script's steps are to the workbench, and the edits that change them. A step is written as app/workbench/session_script.h
// reads it.
import { session } from "./bench_session.js";

const PREPARING = ["detrend", "idfilt", "resample", "fillmissing", "filloutliers", "remove_mean", "keep", "discard", "shift"];

const kWidest = 88;  // characters of a line that a report prints unbroken

/// Pieces behind a beginning, in as many lines as they need.
function inLines(begin, pieces, end, widest) {
  const one = begin + pieces.join(", ") + end;
  if (one.length <= widest) return one;
  const lines = [begin.trimEnd()];
  for (const [i, piece] of pieces.entries()) {
    const text = piece + (i + 1 < pieces.length ? "," : end), last = lines.length - 1;
    if (lines[last].length + text.length + 1 <= widest) lines[last] += (lines[last].endsWith("{") || lines[last].endsWith("(") ? "" : " ") + text;
    else lines.push("  " + text);
  }
  return lines.join("\n");
}

/// The same code in one line, with texts over several lines as texts with \n.
function inOneLine(code) {
  return code.replace(/"(?:[^"\\]|\\[^])*"|'(?:[^'\\]|\\[^])*'|\[(=*)\[\n?([^]*?)\]\1\]|\s*\n\s*/g, (piece, _, inside) => {
    if (!piece.includes("\n")) return piece;
    if (piece.startsWith("[")) return luaText(inside);
    return /^["']/.test(piece) ? piece.replace(/\\\n/g, "\\n") : " ";
  });
}

/// A step that is off is a remark, and so one line.
export const written = (step) => (step.on ? statement(step, kWidest) : `-- off: ${inOneLine(statement(step, Infinity))}`);

function statement(step, widest) {
  const options = step.options.map(({ key, text }) => `${key} = ${text}`);
  const before = (step.local ? "local " : "") + (step.names.length ? step.names.join(", ") + " = " : "");
  const call = (step.receiver ? step.receiver + ":" : "") + step.function;
  if (!step.function) return before + step.arguments[0];
  if (step.braces) return inLines(`${before}${call}{`, options, "}", widest);
  if (options.length === 0) return `${before}${call}(${step.arguments.join(", ")})`;
  return inLines(`${before}${call}(${step.arguments.map((text) => text + ", ").join("")}{`, options, "})", widest);
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

/// The variable from which a name takes its samples: the result of iddata.
function sourceOf(name) {
  for (let k = 0; name && k < 20; ++k) {
    const step = session.steps.find((one) => one.on && one.names.includes(name)), from = step?.receiver || step?.arguments[0];
    if (!step || step.function === "iddata" || !/^[A-Za-z_]\w*$/.test(from ?? "")) return name;
    name = from;
  }
  return name;
}

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
  const source = sourceOf(validation), isRecord = steps.some((step) => step.names[0] === source && step.function === "iddata");
  const second = isRecord && source !== raw ? source : undefined;  // validates, and is no part of the first
  return { raw, prepared, estimation, validation, second, orders, study, reading };
}

/// The channels, from 1 on, that a step's data were selected from others; {} for all of them.
export function channelOf(step) {
  const text = step.arguments[0] ?? "", named = session.steps.find((one) => one.on && one.function === "select" && one.names[0] === text);
  const [, output, input] = /:select\((\d+)(?:, *(\d+))?\)$/.exec(named ? `:select(${named.arguments.join(", ")})` : text) ?? [];
  return output ? { output: Number(output), ...(input ? { input: Number(input) } : {}) } : {};
}

/// Models that were estimated or written down; not the true system of a study.
export function modelSteps() {
  const seen = variables(), truths = session.steps.flatMap((step) => step.options.filter(({ key }) => key === "system").map(({ text }) => text));
  return session.steps.filter((step) => step.names.length > 0 && !truths.includes(step.names[0]) &&
                                        (formOf(step.function) || seen[step.names[0]]?.kind === "model"));
}

/// Whether a step transforms a data set under its own name.
export const isPreparing = (step, name) => step?.names[0] === name && (PREPARING.includes(step.function) || (step.function === "range" && step.receiver === name));
export function preparingSteps() {
  const { prepared, raw } = roles();
  return prepared === raw ? [] : session.steps.filter((step) => isPreparing(step, prepared));
}

export function endOfScript() {
  const lines = session.source.split("\n");
  let end = lines.length;
  while (end > 0 && lines[end - 1].trim() === "") --end;
  return end;
}

/// The numbers of lines that contain a name outside comments and strings.
export function linesWith(name) {
  const word = new RegExp(`(?<![\\w.:])${name}(?!\\w)`), numbers = [];
  session.source.split("\n").forEach((line, i) => {
    if (/^\s*--/.test(line) && !line.startsWith("-- off: ")) return;
    if (word.test(line.replace(/^-- off: /, "").replace(/"[^"]*"/g, '""').replace(/--.*$/, ""))) numbers.push(i + 1);
  });
  return numbers;
}

/// Edits that remove steps: with their cell if nothing else is in it, and with the heading before the cell.
export function cellRemoval(steps) {
  const lines = session.source.split("\n"), gone = new Set(), edits = [];
  for (const { first_line, last_line } of steps) for (let line = first_line; line <= last_line; ++line) gone.add(line);
  const isEmpty = (line) => (lines[line - 1] ?? "").trim() === "", isMarker = (line) => /^-- %%/.test(lines[line - 1] ?? "");
  const seen = new Set();
  for (const step of steps) {
    let first = step.first_line, last = step.last_line;
    while (first > 1 && (isEmpty(first - 1) || gone.has(first - 1))) --first;
    while (last < lines.length && (isEmpty(last + 1) || gone.has(last + 1))) ++last;
    const alone = isMarker(first - 1) && (last >= lines.length || isMarker(last + 1));
    if (!alone) { edits.push(removed(step)); continue; }
    while (isEmpty(last) && last > step.last_line) --last;
    first = withHeading(first - 1, isEmpty, lines);
    if (!seen.has(first)) edits.push({ first, last, text: "" });
    seen.add(first);
  }
  return edits;
}
/// The first line that goes with the cell whose marker is line `at`: a heading alone before it, and an empty line.
function withHeading(at, isEmpty, lines) {
  let first = at, line = at - 1;
  while (line > 0 && isEmpty(line)) --line;
  if (/^-- #+ /.test(lines[line - 1] ?? "") && /^-- %% \[markdown\]/.test(lines[line - 2] ?? "")) first = line - 1;
  return first > 1 && isEmpty(first - 1) ? first - 1 : first;
}

export const taken = (name) => session.steps.some((step) => step.names.includes(name)) || session.cells.some((cell) => cell.id === name);
export function freeName(stem) {
  let k = 1;
  while (taken(stem + k)) ++k;
  return stem + k;
}
/// A text as Lua has it.
export const luaText = (text) => JSON.stringify(text);
/// A separate cell at the end, with this id if no other cell has it yet.
export function newCell(id, text) {
  const own = session.cells.some((cell) => cell.id === id) ? freeName(id) : id;
  return insertedBehind(endOfScript(), `\n-- %% id=${own}\n${text}`);
}

/// Text of a number as a script has it.
export const luaNumber = (value) => String(Number(Number(value).toPrecision(6)));
