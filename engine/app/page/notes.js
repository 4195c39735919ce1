// What the page keeps for its next visit: named texts, which the server stores for the document.
import { order } from "./orders.js";

let notes = {};

/// Before the first use of the others.
export async function readNotes() {
  try {
    const reply = await fetch("notes");
    if (reply.ok) notes = await reply.json();
  } catch { /* the server is gone: nothing is kept */ }
}

export const noteNames = () => Object.keys(notes);
export const noteOf = (name) => notes[name] ?? "";

let last = 0;
const kKeptAlive = 60_000;  // bytes that a browser still sends for a page that is closed

/// Stores a text; an empty one removes the note. Resolves to whether the server has it.
export async function setNote(name, text) {
  if (text === "") delete notes[name];
  else notes[name] = text;
  const at = last = Math.max(last + 1, Date.now()), body = JSON.stringify({ name, text, at });
  try {
    return (await order("notes", body, { keepalive: body.length < kKeptAlive })).ok;
  } catch {
    return false;
  }
}
