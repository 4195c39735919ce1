// Parts that several views of the instructor's page are made of. All text goes into the page as text, never as HTML.
import { command } from "./office_session.js";
import { number, say } from "./office_words.js";

const $ = (id) => document.getElementById(id);

/// An element with properties and children; a text is a text node. `data`, `aria` and `role` are attributes.
export function make(name, properties = {}, ...children) {
  const { data = {}, aria = {}, role, ...rest } = properties, node = Object.assign(document.createElement(name), rest);
  Object.assign(node.dataset, data);
  if (role) node.setAttribute("role", role);
  for (const [key, value] of Object.entries(aria)) node.setAttribute(`aria-${key}`, value);
  node.append(...children.filter((child) => child !== null && child !== undefined && child !== false));
  return node;
}
export const button = (text, onclick, properties = {}) => make("button", { type: "button", textContent: text, onclick, ...properties });

export function choice(name, values, chosen, onchange) {
  const list = make("select", { onchange: () => onchange(list.value) }, ...values.map(([value, text]) => make("option", { value, textContent: text })));
  list.value = chosen;
  return make("label", {}, make("span", { textContent: name }), list);
}

export function table(heads, rows, properties = {}) {
  const head = heads.length > 0 && make("thead", {}, make("tr", {}, ...heads.map((text) => make("th", { textContent: text, scope: "col" }))));
  return make("div", { className: "wide" }, make("table", properties, head, make("tbody", {}, ...rows)));
}
const cellOf = (content) => (content instanceof HTMLElement && content.tagName === "TD" ? content : make("td", {}, content ?? ""));
export const row = (cells, properties = {}) => make("tr", properties, ...cells.map(cellOf));
export const numberCell = (value, properties = {}) => make("td", { className: "number", textContent: shown(value), ...properties });

/// At most four digits, as the language writes them.
export function shown(value) {
  return typeof value === "number" ? number(String(Number(value.toPrecision(4)))) : "";
}

/// "2 d 3 h"
export function duration(seconds) {
  const units = [[86400, say("unitDay")], [3600, "h"], [60, "min"], [1, "s"]], parts = [];
  let rest = Math.abs(seconds);
  for (const [size, unit] of units) {
    if (rest >= size && parts.length < 2) parts.push(`${Math.floor(rest / size)} ${unit}`);
    rest %= size;
  }
  return parts.join(" ") || "0 s";
}

/// Asks for the fields [{name, label, value}] and then runs the command that `words` makes of them; without
/// fields at once.
export function askAndRun(title, fields, words, done = () => {}) {
  const run = (values) => command(words(values)).then(done, () => {});
  if (fields.length === 0) return run({});
  const dialog = $("ask"), inputs = {};
  $("ask-title").textContent = title;
  $("ask-do").textContent = title;
  $("ask-fields").replaceChildren(...fields.map(({ name, label, value = "" }) => {
    inputs[name] = make("input", { type: "text", value, required: true, autocomplete: "off" });
    return make("label", {}, make("span", { textContent: label }), inputs[name]);
  }));
  $("ask-cancel").onclick = () => dialog.close();
  dialog.querySelector("form").onsubmit = () => run(Object.fromEntries(Object.entries(inputs).map(([name, input]) => [name, input.value.trim()])));
  dialog.showModal();
  return null;
}
export const reasonField = (value = "") => ({ name: "reason", label: say("reason"), value });
const kMaxBlock = 4096;  // letters
/// A long text in blocks: a browser takes minutes for one word of a million letters.
export function textBlocks(text) {
  const blocks = [];
  for (let from = 0; from < text.length;) {
    const line = text.lastIndexOf("\n", from + kMaxBlock);
    let to = from + kMaxBlock >= text.length ? text.length : line > from ? line + 1 : from + kMaxBlock;
    if (to < text.length && /[\uD800-\uDBFF]/.test(text[to - 1])) --to;  // not within a letter
    blocks.push(make("span", { className: "block", textContent: text.slice(from, to) }));
    from = to;
  }
  return blocks;
}

/// A file name of a word.
export const inFile = (word) => word.replace(/[^\p{L}\p{N}_.-]/gu, "_");
