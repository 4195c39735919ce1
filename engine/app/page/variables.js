// The variables of the executed part of the script, next to it.
import { noteOf, setNote } from "./notes.js";
import { session } from "./session.js";

const $ = (id) => document.getElementById(id);
const make = (name, kind = "", text = "") => Object.assign(document.createElement(name), { className: kind, textContent: text });
const kSoon = 150;  // ms
const kSvg = "http://www.w3.org/2000/svg";

/// A signal in 64 by 16 units.
function thumbnail(values) {
  const box = document.createElementNS(kSvg, "svg"), line = document.createElementNS(kSvg, "polyline");
  const low = Math.min(...values), high = Math.max(...values), last = values.length - 1;
  const place = (value, i) => `${(1 + 62 * i / last).toFixed(1)},${high > low ? (15 - 14 * (value - low) / (high - low)).toFixed(1) : 8}`;
  line.setAttribute("points", values.map(place).join(" "));
  box.setAttribute("viewBox", "0 0 64 16");
  box.setAttribute("preserveAspectRatio", "xMinYMid");
  box.setAttribute("aria-hidden", "true");
  box.append(line);
  return box;
}

function row({ name, kind, size, text, curve }) {
  const node = make("tr"), head = make("th", "", name), value = make("td", "value");
  head.scope = "row";
  value.title = text;
  value.append(curve.length > 1 ? thumbnail(curve) : text);
  node.append(head, make("td", "faint", size.replace(" x ", " × ")), make("td", "faint", kind), value);
  return node;
}

let timer = 0, shown = "";
async function refresh() {
  timer = 0;
  if ($("variables").hidden) return;
  const list = await session.variables().catch(() => null), text = JSON.stringify(list);
  if (!list || text === shown) return;
  shown = text;
  $("variable-rows").replaceChildren(...list.map(row));
  $("no-variables").hidden = list.length > 0;
}
/// The script has another state.
export function followVariables() {
  timer ||= setTimeout(refresh, kSoon);
}

function open(wanted) {
  $("variables").hidden = !wanted;
  $("show-variables").setAttribute("aria-pressed", String(wanted));
  shown = "";
  if (wanted) refresh();
}
/// Behind the reading of the notes.
export function beginVariables() {
  const wide = matchMedia("(min-width: 62rem)").matches, kept = noteOf("variables");
  open(kept ? kept === "yes" : wide);
  $("show-variables").onclick = () => {
    open($("variables").hidden);
    setNote("variables", $("variables").hidden ? "no" : "yes");
  };
}
