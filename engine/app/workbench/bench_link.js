// How the workbench communicates with the server of `dynlab app`. A site has a different file of this name with the same
// functions (engine/web/page): its session runs in the page.
import { order } from "./orders.js";

export const hasPrograms = true;  // gnuplot for files of figures, LaTeX for reports
export const home = null;  // address of a page that leads here

/// The replies, each a Response.
export const ask = (path) => fetch(path);
export const send = order;

/// Calls page(state) with each change of the session, and over() when it has ended; away() while nothing can be reached.
export function listen({ page, over, away }) {
  const stream = new EventSource("events");
  stream.addEventListener("page", (event) => page(JSON.parse(event.data)));
  stream.addEventListener("over", () => { stream.close(); over(); });
  stream.onerror = away;
  return stream;
}
