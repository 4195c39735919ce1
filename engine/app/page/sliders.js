// Sliders of a document: a control behind the cell that asks for it. What was chosen goes to the server; while a run is
// under way only the newest choice waits, so that dragging shows every result that there was time for.
import { number, say, typeset } from "./page_words.js";
import { session } from "./session.js";

const kPlaces = 1000;  // of a slider without steps
const controls = new Map();  // name -> {node, input, output, slider}
const waiting = new Map();   // name -> value that is to be sent
let sent = null;             // {values, at}: what the page does not show yet, by the sliders' names
const kLongestWait = 3000;   // ms for what was sent to be shown

const exact = (value) => Number(value.toPrecision(12));  // steps are added up without their last digits
const digits = (value) => Number(value.toPrecision(4));

function valueAt(slider, place) {
  const { from, to, step, logarithmic } = slider;
  if (step) return Math.min(to, exact(from + step * place));
  const part = place / kPlaces;
  if (place === 0) return from;
  if (place === kPlaces) return to;
  return digits(logarithmic ? from * (to / from) ** part : from + (to - from) * part);
}

function placeOf(slider, value) {
  const { from, to, step, logarithmic } = slider;
  if (step) return Math.round((value - from) / step);
  const part = logarithmic ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from);
  return Math.round(part * kPlaces);
}

const written = (slider, value) => number(String(slider.step ? exact(value) : digits(value))) + (slider.unit ? "\u202f" + slider.unit : "");

function send() {
  if (sent && performance.now() - sent.at < kLongestWait || waiting.size === 0) return;
  sent = { values: Object.fromEntries(waiting), at: performance.now() };
  waiting.clear();
  session.moveSliders(sent.values).catch(() => { sent = null; });
  setTimeout(send, kLongestWait + 1);
}

function note(control, value) {
  control.output.textContent = written(control.slider, value);
  control.input.setAttribute("aria-valuetext", control.output.textContent);
  control.reset.hidden = value === control.slider.initial;
  waiting.set(control.slider.name, value);
}

function choose(control, value) {
  note(control, value);
  send();
}

function moveTo(control, place) {
  const { input, slider } = control;
  input.value = place;
  note(control, valueAt(slider, Number(input.value)));
}

/// What a figure's handle asks for: numbers by the sliders' names, or a step of one.
document.addEventListener("slidermove", ({ detail }) => {
  for (const [name, value] of Object.entries(detail)) {
    const control = controls.get(name);
    if (control) moveTo(control, placeOf(control.slider, value));
  }
  send();
});
document.addEventListener("sliderstep", ({ detail: { name, by } }) => {
  const control = controls.get(name);
  if (!control) return;
  moveTo(control, Number(control.input.value) + by * (control.slider.step ? 1 : kPlaces / 50));
  send();
});

function make(slider) {
  const node = document.createElement("div");
  node.className = "slider";
  const label = document.createElement("label");
  const input = document.createElement("input");
  const output = document.createElement("output");
  const reset = document.createElement("button");
  input.type = "range";
  input.id = "slider-" + slider.name;
  label.htmlFor = input.id;
  const control = { node, label, input, output, reset, slider };
  input.oninput = () => choose(control, valueAt(control.slider, Number(input.value)));
  reset.onclick = () => {
    input.value = placeOf(control.slider, control.slider.initial);
    choose(control, control.slider.initial);
    input.focus();
  };
  node.append(label, input, output, reset);
  return control;
}

function update(control, slider) {
  control.slider = slider;
  typeset(control.label, slider.label);
  control.reset.textContent = say("asInScript");
  control.input.min = 0;
  control.input.max = slider.step ? Math.round((slider.to - slider.from) / slider.step) : kPlaces;
  if (waiting.has(slider.name) || sent && slider.name in sent.values) return;  // the hand is ahead of the page
  control.input.value = placeOf(slider, slider.value);
  control.output.textContent = written(slider, slider.value);
  control.input.setAttribute("aria-valuetext", control.output.textContent);
  control.reset.hidden = slider.value === slider.initial;
}

/// What the page shows now; gives the controls of each cell.
export function controlsByCell(sliders, running) {
  const numbers = Object.fromEntries(sliders.map((slider) => [slider.name, slider.value]));
  if (sent && !running && Object.entries(sent.values).every(([name, value]) => numbers[name] === value)) sent = null;
  const byCell = new Map();
  for (const slider of sliders) {
    if (!controls.has(slider.name)) controls.set(slider.name, make(slider));
    const control = controls.get(slider.name);
    update(control, slider);
    if (!byCell.has(slider.cell)) byCell.set(slider.cell, []);
    byCell.get(slider.cell).push(control.node);
  }
  const names = new Set(sliders.map((slider) => slider.name));
  for (const [name, { node }] of controls) {
    if (names.has(name)) continue;
    node.remove();
    controls.delete(name);
  }
  if (!running) send();
  return byCell;
}
