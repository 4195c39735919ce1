// The lesson's visible checks and hints, and the pack, in a panel of its page.
import { download } from "./lesson_work.js";
import { number, say } from "./site_words.js";

const make = (name, kind = "", text = "") => Object.assign(document.createElement(name), { className: kind, textContent: text });
const shown = (points) => number(String(Number(points.toFixed(2))));

function item({ about, hint, message, points, earned, tried }) {
  const node = make("li", !tried ? "later" : earned >= points ? "full" : earned > 0 ? "part" : "none");
  node.append(make("p", "check-about", about), make("span", "check-points", tried ? say("pointsOf", shown(earned), shown(points)) : `${shown(points)}`));
  if (!tried) node.append(make("p", "faint", say("checkedLater")));
  if (tried && earned < points && message) node.append(make("p", "", message));
  if (tried && earned < points && hint) {
    const more = make("details");
    more.append(make("summary", "", say("hintOf")), make("p", "", hint));
    node.append(more);
  }
  return node;
}

/// Shows the engine's checks, and the error of the script, in `panel`.
export function showChecks(panel, { checks, trouble }) {
  const list = make("ul", "checks"), tried = checks.filter((check) => check.tried);
  const sum = (key) => shown(tried.reduce((total, check) => total + check[key], 0));
  list.append(...checks.map(item));
  panel.replaceChildren(make("h2", "", say("pointsOf", sum("earned"), sum("points"))));
  if (trouble) panel.append(make("p", "trouble", say("scriptStopped", trouble)));
  panel.append(list);
}

/// hints.md: by the number of the question, the stages of its hint.
export function hintsIn(markdown) {
  const hints = new Map();
  let stages = null;
  for (const line of markdown.split("\n")) {
    const heading = /^# Question (\d+)/.exec(line), stage = /^\d+\. (.*)/.exec(line);
    if (heading) hints.set(Number(heading[1]), stages = []);
    else if (stage && stages) stages.push(stage[1].trim());
    else if (line.trim() && stages?.length) stages[stages.length - 1] += " " + line.trim();
  }
  return hints;
}

/// Behind each question of the text that has hints: one stage more with each click.
export function placeHints(main, markdown, write) {
  for (const [question, stages] of hintsIn(markdown)) {
    const mark = [...main.querySelectorAll(".text strong")].find((node) => new RegExp(`^Question\\s${question}\\b`).test(node.textContent));
    const behind = mark?.closest("p");
    if (!behind || stages.length === 0) continue;
    const box = make("div", "question-hints"), list = make("ol"), more = make("button", "", say("questionHints", question));
    more.type = "button";
    more.onclick = () => {
      const stage = make("li");
      stage.append(...write(stages[list.children.length]));
      list.append(stage);
      more.textContent = say("moreHint");
      more.hidden = list.children.length === stages.length;
    };
    box.append(list, more);
    behind.after(box);
  }
}

/// The pack goes into the downloads; gives what is said of it.
export async function submit(session, work) {
  const bytes = await session.makePack(work.folder()), name = `${work.description.lesson}.zip`;
  download(name, bytes, "application/zip");
  const lines = [say("packReady", name)];
  if (globalThis.crypto?.subtle) {
    const hash = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
    lines.push(say("packSays", [...hash].map((byte) => byte.toString(16).padStart(2, "0")).join("")));
  }
  return { bytes, lines };
}
