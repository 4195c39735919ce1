// What the page keeps for its next visit: named texts, which the server stores for the document.
import { session } from "./session.js";

let notes = {};

/// Before the first use of the others.
export async function readNotes() {
  try {
    notes = await session.notes();
  } catch { /* the server is gone: nothing is kept */ }
}

export const noteNames = () => Object.keys(notes);
export const noteOf = (name) => notes[name] ?? "";

let last = 0;

/// Stores a text; an empty one removes the note. Resolves to whether the server has it.
export async function setNote(name, text) {
  if (text === "") delete notes[name];
  else notes[name] = text;
  last = Math.max(last + 1, Date.now());
  try {
    await session.keepNote(name, text, last);
    return true;
  } catch {
    return false;
  }
}
