// What the instructor's page asks of the server, and the news it gets. This file alone speaks to the server. Commands run one
// after the other, in the order in which they were given.
import { order } from "./orders.js";
import { language, say } from "./office_words.js";

export class Lost extends Error {}
export const session = { over: false, lost: false, log: [] };
const kMaxLines = 500;

async function reached(ask) {
  try {
    return await ask();
  } catch {
    throw new Lost(say(session.over ? "ended" : "noAnswer"));
  }
}
async function answerOf(reply) {
  if (!reply.ok) throw new Error(await reply.text());
  return reply;
}

export async function ask(view, values = {}) {
  const reply = await answerOf(await reached(() => fetch(`${view}?${new URLSearchParams({ language: language(), ...values })}`)));
  return reply.headers.get("Content-Type").startsWith("application/json") ? reply.json() : reply.text();
}
export const upload = async (file, name) => answerOf(await reached(() => order(`upload?${new URLSearchParams({ name })}`, file)));
export const fileAddress = (name) => `exports/${encodeURIComponent(name)}`;

const listeners = { news: [], log: [], state: [] };
export const onNews = (listen) => listeners.news.push(listen);
export const onLog = (listen) => listeners.log.push(listen);
export const onState = (listen) => listeners.state.push(listen);
const tell = (kind) => { for (const listen of listeners[kind]) listen(); };
export const stateChanged = () => tell("state");

let back = [];  // those that wait for the connection
/// Until the server is reached again.
export const connected = () => (session.lost && !session.over ? new Promise((yes) => back.push(yes)) : Promise.resolve());

export function open() {
  const stream = new EventSource("events");
  const now = (lost) => {
    session.lost = lost;
    if (!lost) for (const yes of back.splice(0)) yes();
    tell("state");
  };
  stream.addEventListener("page", () => { now(false); tell("news"); });
  stream.addEventListener("over", () => { stream.close(); session.over = true; now(true); });
  stream.onopen = () => now(false);
  stream.onerror = () => now(true);
}

/// A word of a command as a shell reads it.
const quoted = (word) => (/^[\w./:=@%+,-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

let turn = Promise.resolve();
/// Runs `dynlab course WORDS`; returns {line, code, words}. Throws Lost if there is no reply: the command may or may
/// not have run.
export function command(words) {
  const entry = { line: `dynlab course ${words.map(quoted).join(" ")}`, code: null, words: "", file: words.find((word) => word.startsWith("--out=exports/"))?.slice(14) };
  session.log.push(entry);
  session.log.splice(0, session.log.length - kMaxLines);
  tell("log");
  const run = turn.then(async () => {
    try {
      const body = JSON.stringify({ command: ["course", ...words], language: language() });
      Object.assign(entry, await (await answerOf(await reached(() => order("command", body)))).json());
    } catch (error) {
      Object.assign(entry, { code: -1, words: error.message });
      throw error;
    } finally {
      tell("log");
    }
    return entry;
  });
  turn = run.catch(() => {});
  return run;
}
