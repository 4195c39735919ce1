// What was typed in the editor and is not saved yet, as a note of the page until it is saved: by the file's place, and for each
// opening of the file apart, so that none writes over another's. What an earlier one left is offered when the page is opened
// again and the file is another text.
import { noteNames, noteOf, setNote } from "./notes.js";
import { language, say } from "./page_words.js";

const kDelay = 400;  // ms behind the last letter
const waiting = new Map();  // source -> timer

const nameOf = (source) => `dynlab-draft ${source.place}`;
const newKey = (source) => `${nameOf(source)} ${Date.now()}-${Math.floor(1e9 * Math.random())}`;
function isOf(source, key) {
  const name = nameOf(source);
  return key.startsWith(`${name} `) && /^\d+-\d+$/.test(key.slice(name.length + 1));
}

export const forget = (draft) => setNote(draft.key, "");

/// Without those that are the file's text by now.
function stillDrafts(source, drafts) {
  drafts.filter(({ text }) => text === source.saved).forEach(forget);
  return drafts.filter(({ text }) => text !== source.saved);
}

/// The drafts that were left, the newest first: [{key, text, digest, at}]; `digest`: of the text from which it was made.
export function draftsOf(source) {
  const drafts = noteNames().filter((key) => isOf(source, key)).map((key) => ({ ...JSON.parse(noteOf(key)), key }));
  return stillDrafts(source, drafts.sort((a, b) => b.at - a.at));
}

/// Stores the text in the editor; no draft where the file has that text. Resolves to whether that is done. Drafts that are
/// offered stay until they are taken or dropped.
export async function keepDraft(source) {
  clearTimeout(waiting.get(source));
  waiting.delete(source);
  source.drafts = stillDrafts(source, source.drafts);
  const text = source.doc.getValue();
  if (text !== source.saved) return setNote(source.key ??= newKey(source), JSON.stringify({ text, digest: source.digest, at: Date.now() }));
  return !source.key || noteOf(source.key) === "" || setNote(source.key, "");
}
export function keepDraftSoon(source) {
  clearTimeout(waiting.get(source));
  waiting.set(source, setTimeout(() => keepDraft(source), kDelay));
}
window.addEventListener("pagehide", () => { for (const source of [...waiting.keys()]) keepDraft(source); });

/// The text in the editor becomes a draft that the page offers; later text is kept separately.
export function setAside(source) {
  keepDraft(source);
  source.drafts.push({ key: source.key, text: source.doc.getValue(), digest: source.digest, at: Date.now() });
  source.key = null;
}

/// "A draft of 14:03 was not saved": with the day where that is another one.
export function wordsOf({ at }) {
  const then = new Date(at), today = then.toDateString() === new Date().toDateString();
  const time = { hour: "2-digit", minute: "2-digit", hourCycle: "h23" }, day = { day: "numeric", month: "long" };
  const when = then.toLocaleString(language(), today ? time : { ...day, ...time });
  return say("draft", when);
}
