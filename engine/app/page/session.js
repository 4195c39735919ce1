// The requests of a document's page to the engine, and the engine's news. Only this file communicates with the server;
// in a page without a server, a session with the same interface replaces it, whose engine runs in a worker of the
// browser (engine/web/page/worker_session.js). Every method throws `Lost` if there is no reply, and Error with the
// engine's sentence if the engine refuses.
import { order } from "./orders.js";

export class Lost extends Error {}

async function reached(ask) {
  try {
    return await ask();
  } catch {
    throw new Lost("no answer");
  }
}
async function answerOf(reply) {
  if (!reply.ok) throw new Error(await reply.text());
  return reply;
}
const get = async (path) => answerOf(await reached(() => fetch(path)));
const post = async (path, body = {}, how = {}) => answerOf(await reached(() => order(path, JSON.stringify(body), how)));
async function saving(path, body) {
  const reply = await reached(() => order(path, JSON.stringify(body)));
  if (reply.status === 403) throw new Lost("no answer");
  const written = reply.status !== 409;
  return { written, now: await (written ? await answerOf(reply) : reply).json() };
}
const bytesOf = (text) => new TextEncoder().encode(text).length;
const kKeptAlive = 60_000;  // bytes that a browser still sends for a page that is closed

let stream = null;

export const session = {
  /// News until `close`: page(the changes, or everything), over(), away() while there is no reply.
  open({ page, over, away }) {
    session.close();
    stream = new EventSource("events");
    stream.addEventListener("page", (event) => page(JSON.parse(event.data)));
    stream.addEventListener("over", () => { session.close(); over(); });
    stream.onerror = away;
  },
  close() {
    stream?.close();
    stream = null;
  },

  // Runs
  allow: () => post("allow"),
  stop: () => post("stop"),
  runAll: () => post("run-all"),
  /// From the cell at a line of a file on, changed or not; with `only`, what has changed up to that cell. `source` is saved
  /// before, where it is given: answers as `save` does.
  runCell: (file, line, only, source) => saving("run", { source, place: { file, line, again: !only } }),
  moveSliders: (values) => post("slider", { values }),

  // Files: [{number, name, text, digest, place}]
  sources: async () => (await get("sources")).json(),
  /// {written, now: the file as it is}; not written where it has changed since `digest`.
  save: (source) => saving("save", source),

  // The requests of an editor while the user types; null if there is no answer
  /// {typed, candidates: [{text, note}], signature, summary, argument} for the end of a text
  complete: async (text) => (await post("complete", { text, cursor: 0 })).json(),
  /// {text}: of the name at a place in a line
  help: async (line, place) => (await post("help", { text: line, cursor: bytesOf(line.slice(0, place)) })).json(),
  /// [{line, column, kind, text}]
  lint: async (name, text) => (await post("lint", { name, text })).json(),
  /// [{name, kind, size, text, curve}]
  variables: async () => (await (await reached(() => order("variables", ""))).json()),

  // What is made of the document: {done, words}
  makeReport: async () => (await post("report")).json(),
  makePack: async () => (await post("pack")).json(),
  pdfAddress: (version) => `document.pdf?version=${version}`,

  // Named texts that are kept for the page's next visit
  notes: async () => (await get("notes")).json(),
  keepNote(name, text, at) {
    const note = { name, text, at };
    return post("notes", note, { keepalive: JSON.stringify(note).length < kKeptAlive });
  },

  /// The figure of a prompt, as plot.js draws it; null where it is forgotten.
  async figure(number) {
    const reply = await reached(() => fetch(`plot/${number}`));
    return reply.ok ? reply.text() : null;
  },
};

/// Another implementation takes this one's place, method by method.
export const useSession = (other) => Object.assign(session, other);
