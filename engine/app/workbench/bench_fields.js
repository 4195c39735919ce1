// Controls of a step that calls an estimator: they follow from its form, show what the step's line says, and change that line.
import { change, session, trouble } from "./bench_session.js";
import { help, inline } from "./bench_help.js";
import { formOf, luaNumber, replaced, stepOf } from "./bench_steps.js";
import { say } from "./bench_words.js";

export function element(tag, fields = {}, ...children) {
  const node = Object.assign(document.createElement(tag), fields);
  node.append(...children);
  return node;
}
export const button = (words, act, fields = {}) => element("button", { type: "button", textContent: words, onclick: act, ...fields });

export const why = (name) => button(say("why"), () => help(name), { className: "why", ariaLabel: `${say("why")} ${name}`, title: `dynlab help ${name}` });

/// Rewrites a step; `make(step)` returns the changes, or null for none.
export function rewrite(key, make, how) {
  return change(() => {
    const step = stepOf(key), made = step && make(step);
    return made ? [replaced(step, made)] : null;
  }, how);
}
const withArgument = (step, place, text) => ({ arguments: step.arguments.map((old, i) => (i === place ? text : old)) });
export function withOption(step, name, text) {
  const options = step.options.filter(({ key }) => key !== name);
  if (text !== "") {
    const at = step.options.findIndex(({ key }) => key === name);
    options.splice(at < 0 ? options.length : at, 0, { key: name, text });
  }
  return { options };
}
const optionText = (step, name) => step.options.find(({ key }) => key === name)?.text ?? "";
const isNumber = (text) => text.trim() !== "" && Number.isFinite(Number(text));

/// A text whose T_s, R_T² and the like are set as formulas are.
export const typeset = (words) => words.split(/\b([A-Z]_[A-Za-z])\b/).map((piece, i) => (i % 2 === 0 ? piece.replace(/^\^2/, "²") : element("span", {}, element("i", { textContent: piece[0] }), element("sub", { textContent: piece[2] }))));

function labeled(words, control, title = "") {
  control.title = title;
  const range = control.querySelector?.("input[type=range]");
  if (range) range.ariaLabel = say("labeled", words, say("slider"));
  return element("label", { title }, element("span", {}, ...typeset(words)), control);
}
/// The beginning of what a help page says of an option, and what is taken where it is not given.
function shortWords(words) {
  const [begin] = words.split(/[;.](?:\s|$)/), initial = /[^;.(]*\b(?:default|défaut)\b(?:[^;.]|\.\d)*/.exec(words.slice(begin.length))?.[0].trim();
  return inline(begin + (initial ? `; ${initial}` : ""));
}
const option = (key, field, now) => element("div", { className: "option" }, labeled(field.name, optionControl(key, field, now), field.words), element("small", {}, ...shortWords(field.words)));

function choice(values, now, act, names = values) {
  const list = element("select", { onchange: () => act(list.value) });
  for (const [i, value] of values.entries()) list.append(element("option", { value, textContent: names[i] }));
  if (!values.includes(now)) list.append(element("option", { value: now, textContent: now }));
  list.value = now;
  return list;
}

/// What is open at the end of an expression, or closed too often: a bracket or a quote; null where all is closed.
function openAt(text) {
  const open = [], closing = { ")": "(", "]": "[", "}": "{" };
  for (const [sign] of text.matchAll(/"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*'|["'()[\]{}]/g)) {
    if (sign.length > 1) continue;
    if ("([{".includes(sign)) open.push(sign);
    else if (!closing[sign] || open.pop() !== closing[sign]) return sign;
  }
  return open.pop() ?? null;
}
/// A field for an expression of Lua. An unclosed expression stays in the field, since it would swallow the following
/// lines. The run reports other invalid expressions, with their line.
function expression(box, now, act) {
  Object.assign(box, { value: now, defaultValue: now, spellcheck: false });
  box.onchange = () => {
    const text = box.value.trim(), wrong = openAt(text);
    if (wrong) trouble(say("notClosed", `${wrong}    ${text}`));
    else if (box.ariaInvalid === "true") trouble(session.error?.message ?? null);
    box.ariaInvalid = String(Boolean(wrong));
    if (!wrong) act(text);
  };
  return box;
}
const textField = (now, act) => expression(element("input", { type: "text" }), now, act);
const longField = (now, act) => expression(element("textarea", { rows: 2 }), now, act);

/// Controls are not created again while a hand is at one of them.
export const hold = (held) => document.dispatchEvent(new CustomEvent("benchheld", { detail: held }));

/// What is typed into one field until another has the focus is one step of the history. Fields are created again meanwhile: `place`
/// says which it is.
let typing = { place: "", hand: null };
document.addEventListener("focusin", ({ target }) => { if (target.dataset?.place !== typing.place) typing = { place: "", hand: null }; });
function typedHere(place) {
  if (typing.place !== place) typing = { place, hand: {} };
  return { hand: typing.hand };
}
/// A whole number, each form of which counts as it is typed.
function countField(place, now, act) {
  const box = element("input", { type: "number", min: 0, max: 99, value: now });
  box.dataset.place = place;
  box.oninput = () => { if (box.value !== "" && box.checkValidity()) act(box.value, typedHere(place)); };
  return box;
}

/// A number with a slider over 1/30 to 30 times what it is when a hand takes it.
function numberField(now, act, { slider = true } = {}) {
  if (now !== "" && !isNumber(now)) return textField(now, act);
  const box = element("input", { type: "number", step: "any", value: now });
  box.onchange = () => act(box.value === "" ? "" : luaNumber(box.value), {});
  if (!slider || !isNumber(now) || !(Number(now) > 0)) return box;
  const range = element("input", { type: "range", min: -1, max: 1, step: 0.01, value: 0, ariaLabel: say("slider") });
  let middle = Number(now), hand = null;
  range.oninput = () => {
    const text = luaNumber((middle * 30 ** Number(range.value)).toPrecision(3));
    box.value = text;
    if (!hand) hold(true);
    hand ??= {};
    act(text, { hand, held: true });
  };
  range.onchange = () => {
    act(box.value, { hand });
    hand = null;
    middle = Number(box.value);
    range.value = 0;
    hold(false);
  };
  const both = element("span", { className: "slid" }, box, range);
  return both;
}

function ordersField(key, parts, now, act) {
  const numbers = /^\{\s*[\d\s,]*\}$/.test(now) ? now.slice(1, -1).split(",").map((text) => text.trim()) : null;
  if (!numbers || numbers.length !== parts.length) return labeled(parts.join(", "), textField(now, act));
  const row = element("span", { className: "orders" });
  parts.forEach((name, i) => {
    const tell = (text, how) => { numbers[i] = text; act(`{${numbers.join(", ")}}`, how); };
    row.append(labeled(name, countField(`${key} ${name}`, numbers[i], tell)));
  });
  return row;
}

/// "P2DU": poles, and which letters.
function processField(now, act) {
  const read = /^"P([123])([DIZU]*)"$/.exec(now);
  if (!read) return textField(now, act);
  const letters = new Set(read[2]);
  let poles = read[1];
  const tell = () => act(`"P${poles}${[..."DIUZ"].filter((letter) => letters.has(letter) && !(letter === "U" && poles === "1")).join("")}"`, {});
  const row = element("span", { className: "orders" }, Object.assign(choice(["1", "2", "3"], poles, (value) => { poles = value; tell(); }, ["P1", "P2", "P3"]), { ariaLabel: say("poles") }));
  for (const letter of "DIZU") {
    const box = element("input", { type: "checkbox", checked: letters.has(letter), disabled: letter === "U" && poles === "1" });
    box.onchange = () => { if (box.checked) letters.add(letter); else letters.delete(letter); tell(); };
    row.append(labeled(letter, box, say("letter" + letter)));
  }
  return row;
}

function argumentControl(key, field, place, now) {
  const act = (text, how) => rewrite(key, (step) => withArgument(step, place, text), how);
  if (field.kind === "orders") return ordersField(key, field.parts, now, act);
  if (field.kind === "process") return processField(now, act);
  if (field.kind === "text") return labeled(field.name, longField(now, act), field.words);
  const whole = field.name !== "lambda" && isNumber(now);
  return labeled(field.name, whole ? countField(`${key} ${field.name}`, now, act) : numberField(now, act), field.words);
}

function optionControl(key, field, now) {
  const act = (text, how) => rewrite(key, (step) => withOption(step, field.name, text), how);
  if (field.kind === "choice") return choice(["", ...field.parts], now, act, [say("notGiven"), ...field.parts.map((text) => text.replace(/"/g, ""))]);
  if (field.kind === "flag") return choice(["", "true", "false"], now, act, [say("notGiven"), "true", "false"]);
  return field.kind === "number" ? numberField(now, act) : textField(now, act);
}

/// Free, fixed or none, where the method leaves the choice.
function delayControl(key, step) {
  const fixed = optionText(step, "IODelay"), none = optionText(step, "TdMax") === "0";
  const now = fixed ? "fixed" : none ? "none" : "free";
  const without = (step) => step.options.filter(({ key }) => !["IODelay", "TdMax", "TdMin", "Td0", "NumTd"].includes(key));
  const act = (way) => rewrite(key, (step) => ({
    options: [...without(step), ...(way === "free" ? [] : [way === "none" ? { key: "TdMax", text: "0" } : { key: "IODelay", text: fixed || "0.1" }])],
  }));
  const row = element("span", { className: "orders" }, labeled(say("delay"), choice(["free", "fixed", "none"], now, act, [say("free"), say("fixed"), say("noDelay")])));
  if (fixed) row.append(labeled("IODelay (s)", numberField(fixed, (text, how) => rewrite(key, (step) => withOption(step, "IODelay", text), how))));
  return row;
}

/// All controls of a step that calls an estimator.
export function stepControls(key, step, { open = false } = {}) {
  const form = formOf(step.function);
  const node = element("div", { className: "controls" });
  form.arguments.forEach((field, i) => { if (step.arguments[i + 1] !== undefined) node.append(argumentControl(key, field, i + 1, step.arguments[i + 1])); });
  const hasDelay = form.options.some(({ name }) => name === "IODelay") && form.options.some(({ name }) => name === "TdMax");
  if (hasDelay) node.append(delayControl(key, step));
  const given = form.options.filter(({ name }) => optionText(step, name) !== "" && !(hasDelay && ["IODelay", "TdMax"].includes(name)));
  const rest = form.options.filter((field) => !given.includes(field) && !(hasDelay && field.name === "IODelay"));
  for (const field of given) node.append(option(key, field, optionText(step, field.name)));
  if (rest.length > 0) {
    const more = element("details", { open }, element("summary", { textContent: `${say("options")} (${rest.length})` }));
    for (const field of rest) more.append(option(key, field, optionText(step, field.name)));
    node.append(more);
  }
  return node;
}

/// The line of a new step of this form.
export function firstCall(form, data) {
  const args = form.arguments.map((field) => (field.kind === "orders" ? `{${field.initial}}` : field.initial || "3"));
  return `${form.name}(${[data, ...args].join(", ")})`;
}
export { labeled, choice, numberField, textField, longField, isNumber };
