// What was typed in the editor and is not saved yet, as the browser keeps it: by the file's place, until it is saved. It is offered
// when the page is opened again and the file is another text.
import { isFrench, say } from "/page_words.js";

const kDelay = 400;  // ms behind the last letter
const nameOf = (source) => `dynlab-draft ${source.place}`;
const waiting = new Map();  // source -> timer

/// {text, digest, at} of a draft that is no longer the file's text; `digest`: of the text from which it was made.
export function draftOf(source) {
  try {
    const draft = JSON.parse(localStorage.getItem(nameOf(source)));
    if (typeof draft?.text === "string" && draft.text !== source.saved) return draft;
    localStorage.removeItem(nameOf(source));
  } catch { /* a browser that keeps nothing, or not this */ }
  return null;
}

/// What stands in the editor; nothing where the file has it. A draft that is offered stays until it is taken or thrown away.
export function keepDraft(source) {
  clearTimeout(waiting.get(source));
  waiting.delete(source);
  if (source.draft && source.draft.text !== source.saved) return;
  source.draft = null;
  const text = source.doc.getValue();
  try {
    if (text === source.saved) localStorage.removeItem(nameOf(source));
    else localStorage.setItem(nameOf(source), JSON.stringify({ text, digest: source.digest, at: Date.now() }));
  } catch { /* a browser that keeps nothing, or not so much */ }
}
export function keepDraftSoon(source) {
  clearTimeout(waiting.get(source));
  waiting.set(source, setTimeout(() => keepDraft(source), kDelay));
}
window.addEventListener("pagehide", () => { for (const source of [...waiting.keys()]) keepDraft(source); });

/// "A draft of 14:03 was not saved": with the day where that is another one.
export function wordsOf({ at }) {
  const then = new Date(at), today = then.toDateString() === new Date().toDateString();
  const time = { hour: "2-digit", minute: "2-digit", hourCycle: "h23" }, day = { day: "numeric", month: "long" };
  const when = then.toLocaleString(isFrench() ? "fr" : "en", today ? time : { ...day, ...time });
  return say("draft", when);
}
