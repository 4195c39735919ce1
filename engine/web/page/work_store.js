// What a page keeps in the browser (IndexedDB): the work on each lesson, and notes. Where the browser keeps nothing, everything
// works until the page is closed, and `kept()` is false.
const kDatabase = "dynlab", kWork = "work", kNotes = "notes";

let database = null, works = true;
function opened() {
  database ??= new Promise((yes, no) => {
    const request = indexedDB.open(kDatabase, 1);
    request.onupgradeneeded = () => { for (const name of [kWork, kNotes]) request.result.createObjectStore(name); };
    request.onsuccess = () => {
      request.result.onversionchange = () => request.result.close();
      yes(request.result);
    };
    request.onerror = request.onblocked = () => no(request.error ?? new Error("blocked"));
  });
  return database;
}
async function inStore(name, mode, act) {
  try {
    const store = (await opened()).transaction(name, mode).objectStore(name), request = act(store);
    return await new Promise((yes, no) => {
      store.transaction.oncomplete = () => yes(request.result);
      store.transaction.onerror = store.transaction.onabort = () => no(store.transaction.error);
    });
  } catch {
    works = false;
    return undefined;
  }
}

/// Whether all that was to be kept is kept: false after the first that was not.
export const kept = () => works;

export const storedWork = (key) => inStore(kWork, "readonly", (store) => store.get(key));
export async function storeWork(key, work) {
  await inStore(kWork, "readwrite", (store) => store.put(work, key));
  return works;
}

export const notesOf = async (key) => (await inStore(kNotes, "readonly", (store) => store.get(key))) ?? {};
export async function keepNote(key, name, text) {
  const notes = await notesOf(key);
  if (text === "") delete notes[name];
  else notes[name] = text;
  await inStore(kNotes, "readwrite", (store) => store.put(notes, key));
  return works;
}

const kAnswer = 150;  // ms in which another tab says that it is there
/// Only one tab writes the work of a lesson. `onChange(writes)` is called when that changes. Returns {writes, take(), answered}; `answered`
/// is a promise for the time when other tabs have answered.
export function oneWriter(key, onChange) {
  const line = "BroadcastChannel" in window ? new BroadcastChannel(`dynlab ${key}`) : null, me = String(Math.random());
  let writes = true, asking = true;
  const say = (what) => line?.postMessage({ what, from: me });
  const become = (now) => { if (now !== writes) { writes = now; onChange(writes); } };
  if (line) line.onmessage = ({ data: { what, from } }) => {
    if (from === me) return;
    if (what === "is somebody there?" && writes && !asking) say("I write");
    if (what === "I write" || what === "I take it") become(false);
    if (what === "I leave" && !writes && !asking) { say("I take it"); become(true); }
  };
  say("is somebody there?");
  const answered = new Promise((yes) => { setTimeout(yes, line ? kAnswer : 0); }).then(() => { asking = false; });
  window.addEventListener("pagehide", () => { if (writes) say("I leave"); });
  return { answered, get writes() { return writes; }, take() { say("I take it"); become(true); } };
}
