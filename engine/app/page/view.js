// The figures of a prompt as they are made, the newest first. The page speaks the browser's language.
import { label, say } from "./page_words.js";
import { session } from "./session.js";

const $ = (id) => document.getElementById(id);
const shown = new Map();  // number -> element

/// What plot.js draws the figure from takes the picture's place on the screen.
async function enliven(node, number) {
  const drawn = await session.figure(number);
  if (drawn === null) return;  // forgotten meanwhile
  const data = document.createElement("script");
  data.type = "application/json";
  data.className = "plot-data";
  data.textContent = drawn;
  node.querySelector("img").after(data);
  dynlabPlots.enliven(node);
}

function make({ number, name }) {
  const node = document.createElement("figure"), picture = document.createElement("img"), words = document.createElement("figcaption");
  picture.src = `picture/${number}`;
  picture.alt = words.textContent = name;
  node.append(picture, words);
  enliven(node, number);
  return node;
}

function show({ figures }) {
  const wanted = new Set(figures.map(({ number }) => number));
  for (const [number, node] of shown) {
    if (wanted.has(number)) continue;
    node.remove();
    shown.delete(number);
  }
  for (const figure of [...figures].reverse()) {
    if (shown.has(figure.number)) continue;
    shown.set(figure.number, make(figure));
    $("figures").prepend(shown.get(figure.number));
  }
  $("state").textContent = figures.length === 0 ? say("noFigures", "step(tf({1}, {1, 1}))") : String(figures.length);
}

label();
const tell = (key) => () => { $("state").textContent = say(key); };
session.open({ page: show, over: tell("lastFigures"), away: tell("noAnswer") });
