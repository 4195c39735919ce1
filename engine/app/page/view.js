// The figures of a prompt as they are made, the newest first.
const $ = (id) => document.getElementById(id);
const shown = new Map();  // number -> element

function make({ number, name }) {
  const node = document.createElement("figure"), picture = document.createElement("img"), words = document.createElement("figcaption");
  picture.src = `/picture/${number}`;
  picture.alt = words.textContent = name;
  node.append(picture, words);
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
  $("state").textContent = figures.length === 0 ? "none yet: type, say, step(tf({1}, {1, 1}))" : `${figures.length}`;
}

const source = new EventSource("/events");
source.addEventListener("page", (event) => show(JSON.parse(event.data)));
source.addEventListener("over", () => {
  source.close();
  $("state").textContent = "dynlab has ended; these are its last figures";
});
source.onerror = () => { $("state").textContent = "no answer from dynlab; waiting for it"; };
