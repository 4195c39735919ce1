// The session as the server tells it, and orders to it. An order that changes the script is made from the state that the page
// shows; while one is under way the last that was asked for waits.
export const session = { revision: 0, shown: 0, source: "", steps: [], cells: [], states: {}, views: {}, printed: {}, forms: [],
                         running: false, undo: false, redo: false, error: null, file: "" };
const listeners = [];
let waiting = null, busy = false;

export const onChange = (listen) => listeners.push(listen);
const tell = (changed) => { for (const listen of listeners) listen(changed); };

export async function post(path, body, written = false) {
  const answer = await fetch(path, { method: "POST", body: written ? body : JSON.stringify(body ?? {}), headers: { "Content-Type": "application/json" } });
  if (!answer.ok && answer.status !== 409) throw new Error(await answer.text());
  return answer;
}

/// Until the session is as `holds` wants it, or so many milliseconds have gone by.
export function settled(holds, longest) {
  if (holds()) return Promise.resolve();
  return new Promise((yes) => {
    const timer = setTimeout(finish, longest);
    function finish() {
      clearTimeout(timer);
      const at = listeners.indexOf(look);
      if (at >= 0) listeners.splice(at, 1);
      yes();
    }
    function look() { if (holds()) finish(); }
    listeners.push(look);
  });
}
const kLongestFrame = 300;  // ms: a run that takes longer is overtaken by the next place of a hand

/// `make()` gives the order's edits of the script as it is then (or {text} for all of it), or null for nothing to do.
/// `held`: a control is still being dragged.
export async function change(make, { goesOn = false, held = false } = {}) {
  waiting = { make, goesOn: goesOn || waiting?.goesOn === true && goesOn, held };
  if (busy) return;
  busy = true;
  try {
    while (waiting) {
      const { make, goesOn, held } = waiting;
      waiting = null;
      const made = make();
      if (!made || (Array.isArray(made) && made.length === 0)) continue;
      const whole = !Array.isArray(made), before = session.revision;
      const answer = await post("/script", { revision: before, edits: whole ? [] : made, whole, text: whole ? made.text : "",
                                             goes_on: goesOn, unsaved: held });
      const reached = answer.ok ? await answer.json() : before + 1;
      await settled(() => session.revision >= reached, 1000);
      if (answer.ok && held) await settled(() => session.shown === session.revision && !session.running, kLongestFrame);
    }
  } catch (error) {
    trouble(error.message);
  } finally {
    busy = false;
  }
}

let told = null;
export function trouble(words) {
  told = words;
  const node = document.getElementById("trouble");
  node.hidden = !words;
  node.textContent = words ?? "";
}

let looked = "", next = null, looking = false;
/// Asks for views; the same order again is nothing. While one is being made the last that was asked for waits.
export async function look(variables, settings, until) {
  next = JSON.stringify({ variables, settings: JSON.stringify(settings), data_until: until });
  if (looking) return;
  looking = true;
  try {
    while (next && next !== looked) {
      looked = next;
      next = null;
      const answer = await post("/look", looked, true);
      const serial = Number(await answer.text());
      await settled(() => session.looked >= serial && !session.running, kLongestFrame);
    }
  } catch (error) {
    trouble(error.message);
  } finally {
    looking = false;
  }
}

function take(page) {
  const changed = { source: page.source !== undefined, views: Object.keys(page.views ?? {}), whole: page.all };
  if (page.all) { looked = ""; session.views = {}; }
  Object.assign(session.views, page.views);
  for (const key of ["asking", "stopped", "looked", "revision", "shown", "running", "undo", "redo", "states", "printed"]) session[key] = page[key];
  for (const key of ["source", "steps", "cells", "forms", "file"]) if (page[key] !== undefined) session[key] = page[key];
  session.error = page.error ?? null;
  if (told && changed.source) trouble(null);
  tell(changed);
}

export function connect(onState) {
  const source = new EventSource("/events");
  source.addEventListener("page", (event) => { onState("here"); take(JSON.parse(event.data)); });
  source.addEventListener("over", () => { source.close(); onState("over"); });
  source.onerror = () => onState("away");
}
