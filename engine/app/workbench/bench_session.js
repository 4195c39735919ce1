// The session as the engine reports it, and the orders to it: no other part of the workbench communicates with the
// engine. Each order that changes the script starts from the state that the previous order left.
import * as link from "./bench_link.js";
import { say } from "./bench_words.js";

export const session = { revision: 0, shown: 0, source: "", steps: [], cells: [], states: {}, views: {}, printed: {}, forms: [],
                         running: false, undo: false, redo: false, error: null, unsaved: "", file: "", over: false };
const kMostOfLeaving = 20000;  // letters that a browser sends on for a page that is left: 64 KiB at most
const listeners = [];

export const onChange = (listen) => listeners.push(listen);
const tell = (changed) => { for (const listen of listeners) listen(changed); };

/// The server's reply. For a server that has ended or cannot be reached, the page's state already reports the failure.
export async function request(path, ask = link.ask) {
  try {
    return await ask(path);
  } catch {
    throw new Error(say(session.over ? "ended" : "noAnswer"));
  }
}
export const upload = (file) => request(`upload?name=${encodeURIComponent(file.name)}`, (path) => link.send(path, file));
export async function post(path, body, written = false) {
  const text = written ? body : JSON.stringify(body ?? {}), keepalive = document.hidden && text.length < kMostOfLeaving;
  const answer = await request(path, () => link.send(path, text, { keepalive }));
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

const kLongestNews = 1000;  // ms until the news of an order are there
const kAttempts = 6;  // of an order that meets what was changed elsewhere

let turn = Promise.resolve(), waiting = 0, last = null, sendTyped = () => {};
/// Text that the user types is sent before later clicks.
export const beforeOrders = (send) => { sendTyped = send; };
/// What changes the script, one after the other: `run()` when all that was asked for before is done.
export function inTurn(run) {
  sendTyped();
  last = null;
  ++waiting;
  const result = turn.then(async () => {
    openOrClose();
    await settled(() => here, kLongestNews);
    return run();
  });
  turn = result.catch(() => {}).then(() => { --waiting; openOrClose(); });
  return result;
}

/// `make()` gives the order's edits of the script as it is in its turn (or {text} for all of it), or null for nothing to do;
/// it is called again where the script was changed elsewhere meanwhile. `hand`: an object of one drag, or of what is typed in one
/// go, whose moves are one step of the history as long as nothing else changes the script; a move that is `held` still is
/// overtaken by the next one of its hand. `done()` is called when the session has taken it.
export function change(make, { hand = null, held = false, goesOn = false, done = () => {} } = {}) {
  if (hand && last?.hand === hand && last.held) {
    Object.assign(last, { make, held });
    return last.ended;
  }
  const order = { make, hand, held, goesOn, done };
  order.ended = inTurn(() => obey(order)).catch((error) => trouble(error.message));
  last = order;
  return order.ended;
}

async function obey(order) {
  if (last === order) last = null;
  const { make, hand, held, goesOn, done } = order;
  for (let attempt = 0; attempt < kAttempts; ++attempt) {
    const made = await make();
    if (!made || (Array.isArray(made) && made.length === 0)) return done();
    const whole = !Array.isArray(made), before = session.revision;
    const answer = await post("script", { revision: before, edits: whole ? [] : made, whole, text: whole ? made.text : "",
                                           goes_on: hand ? hand.reached === before : goesOn, unsaved: held });
    const reached = answer.ok ? await answer.json() : before + 1;
    await settled(() => session.revision >= reached, kLongestNews);
    if (!answer.ok) continue;
    if (hand && reached > before) hand.reached = reached;
    if (held) await settled(() => session.shown === session.revision && !session.running, kLongestFrame);
    return done();
  }
  throw new Error(say("changedMeanwhile"));
}

let told = null;
/// Shows a message at the top until the script changes, followed by controls; null removes it.
export function trouble(words, ...controls) {
  told = words;
  const node = document.getElementById("trouble");
  node.hidden = !words;
  node.replaceChildren(words ?? "", ...controls.flatMap((control) => [" ", control]));
}

let looked = "", next = null, looking = false, asked = {};  // asked: the settings that are looked at
/// Asks for views; the same order again is nothing. While one is being made the last that was asked for waits.
export async function look(variables, settings, until) {
  asked = settings;
  next = JSON.stringify({ variables, settings: JSON.stringify(settings), data_until: until });
  if (looking) return;
  looking = true;
  try {
    while (next && next !== looked) {
      looked = next;
      next = null;
      const answer = await post("look", looked, true);
      const serial = Number(await answer.text());
      await settled(() => session.looked >= serial && !session.running, kLongestFrame);
    }
  } catch (error) {
    trouble(error.message);
  } finally {
    looking = false;
  }
}

/// What a view is made of, by what look() calls it.
const NEEDS = { variables: [], record: ["raw"], second: ["second"], spectrum: ["raw", "prepared"], advice: ["raw", "prepared"], models: ["estimation", "validation", "all_models"],
                compare: ["estimation", "validation", "models"], residuals: ["estimation", "validation", "models"], correlation: ["estimation", "models"],
                orders: ["orders"], study: ["study"], reading: ["raw", "reading"] };
let latest = {};  // the server's last views

/// Whether a script that stops at a mistake has come to all that a view is made of.
function isWhole(view) {
  const there = latest.variables ?? {};
  return (NEEDS[view] ?? ["models"]).flatMap((part) => asked[part] ?? []).every((name) => name in there);
}
/// Views of the script before a mistake: they stay until the script gets as far again.
export const isOlder = (view) => session.error !== null && !isWhole(view);

/// The views that are shown after news; gives the names of those that are others now.
function takeViews(page) {
  if (page.all) { latest = {}; session.views = {}; }
  Object.assign(latest, page.views);
  const before = { ...session.views };
  if (!session.error) {
    Object.assign(session.views, !page.running && page.shown === page.revision ? latest : page.views);
  } else {
    for (const view of Object.keys(latest)) if (isWhole(view) || !before[view]) session.views[view] = latest[view];
    session.views.variables = { ...before.variables, ...latest.variables };
    const rows = latest.models?.rows, old = before.models?.rows;
    if (Array.isArray(rows) && Array.isArray(old)) session.views.models = { rows: [...rows, ...old.filter(({ name }) => !rows.some((row) => row.name === name))] };
  }
  return Object.keys(session.views).filter((view) => session.views[view] !== before[view]);
}

/// A call that is half typed keeps the controls of what it was; a value is shown as it is typed.
let finished = new Map();
function takeSteps(steps) {
  const now = new Map(), count = {};
  session.steps = steps.map((step) => {
    const names = step.names.join(","), key = `${names}#${count[names] = (count[names] ?? 0) + 1}`, was = finished.get(key);
    const known = step.broken && was?.function ? { ...was, first_line: step.first_line, last_line: step.last_line, rest: "", broken: true } : step;
    now.set(key, known);
    return known;
  });
  finished = now;
}

function take(page) {
  const changed = { source: page.source !== undefined, whole: page.all }, edited = changed.source && page.source !== session.source;
  if (page.all) looked = "";
  for (const key of ["asking", "stopped", "looked", "revision", "shown", "running", "undo", "redo", "unsaved", "states", "printed"]) session[key] = page[key];
  for (const key of ["source", "cells", "forms", "file"]) if (page[key] !== undefined) session[key] = page[key];
  if (page.steps) takeSteps(page.steps);
  changed.error = Boolean(session.error) !== Boolean(page.error);
  session.error = page.error ?? null;
  changed.views = takeViews(page);
  if (told && edited) trouble(null);
  tell(changed);
}

let stream = null, here = false, onState = () => {};
function open() {
  stream = link.listen({
    page(state) { here = true; onState("here"); take(state); },
    over() { session.over = true; onState("over"); },
    away: () => onState("away"),
    trouble,
  });
}
/// Browsers open six connections to one server, whatever the number of tabs: hidden tabs close theirs, when all their
/// orders are done.
function openOrClose() {
  if (session.over || (stream !== null) === (!document.hidden || waiting > 0)) return;
  if (!stream) return open();
  stream.close();
  stream = null;
  here = false;
}
export function connect(listen) {
  onState = listen;
  document.addEventListener("visibilitychange", openOrClose);
  openOrClose();
}
