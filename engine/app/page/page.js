// A live document: puts what the server tells of into the page, and keeps the page where the reader has it.
const $ = (id) => document.getElementById(id);
const nodes = new Map();  // id of a piece -> its element
let version = -1;
let source = null;

/// The piece at the top of the window, and how far from there: what must not move.
function anchor() {
  const top = $("bar").getBoundingClientRect().bottom;
  for (const node of $("document").children) {
    const box = node.getBoundingClientRect();
    if (box.bottom > top) return { node, index: [...node.parentNode.children].indexOf(node), top: box.top };
  }
  return null;
}

/// The anchor itself, or what stands in its place now.
function hold(held) {
  if (!held) return;
  const list = $("document").children;
  const node = held.node.isConnected ? held.node : list[Math.min(held.index, list.length - 1)];
  if (node) window.scrollBy(0, node.getBoundingClientRect().top - held.top);
}

function element(id, html) {
  const node = document.createElement("div");
  node.className = "piece";
  node.id = id;
  node.innerHTML = html;
  return node;
}

function place(pieces, html) {
  const main = $("document");
  const first = nodes.size === 0;
  const wanted = new Set(pieces.map(([id]) => id));
  for (const node of main.querySelectorAll(".piece.fresh")) node.classList.remove("fresh");
  for (const [id, node] of nodes) {
    if (wanted.has(id)) continue;
    node.remove();
    nodes.delete(id);
  }
  let before = main.firstElementChild;
  for (const [id, cell, file, line] of pieces) {
    let node = nodes.get(id);
    if (!node) {
      if (!(id in html)) return false;
      node = element(id, html[id]);
      if (!first) node.classList.add("fresh");
      nodes.set(id, node);
    }
    node.dataset.cell = cell;
    node.dataset.line = line;
    node.dataset.file = file;
    if (node === before) before = before.nextElementSibling;
    else main.insertBefore(node, before);
  }
  return true;
}

function showStates(page) {
  let done = 0, failed = 0, total = 0, seconds = 0, running = "";
  for (const [cell, { state, seconds: took }] of Object.entries(page.states)) {
    ++total;
    seconds += took;
    if (state === "done") ++done;
    if (state === "failed") ++failed;
    if (state === "running") running = cell;
  }
  for (const node of $("document").children) {
    const state = page.states[node.dataset.cell]?.state;
    if (state) node.dataset.state = state;
    else delete node.dataset.state;
    node.classList.toggle("older", failed > 0 && state === "waiting");
  }
  const words = page.running ? `cell ${Math.min(done + 1, total)} of ${total}${running ? ", " + running : ""}`
    : failed > 0 ? "stopped at a mistake" : total > 0 ? `${total} cells, ${seconds.toFixed(1)} s` : "";
  $("state").textContent = words;
  $("stop").hidden = !page.running;
}

function showComplaints(complaints) {
  $("complaints").hidden = complaints.length === 0;
  $("complaints").replaceChildren(...complaints.map((text) => {
    const line = document.createElement("p");
    line.textContent = text;
    return line;
  }));
}

function show(page) {
  if (!page.all && version < 0) return;
  if (page.version < version) return;
  const held = anchor();
  if (page.pieces) {
    if (!page.all && page.version > version + 1 || !place(page.pieces, page.html)) return connect();
    $("head").innerHTML = page.head;
    $("notes").innerHTML = page.notes;
  }
  version = page.version;
  document.title = page.name + (page.name ? " · " : "") + "dynlab";
  $("name").textContent = page.name;
  $("question").hidden = !page.asking;
  showComplaints(page.complaints);
  showStates(page);
  hold(held);
}

/// One stream of news; the browser comes again by itself when it is cut, and gets everything then.
function connect() {
  if (source) source.close();
  version = -1;
  source = new EventSource("/events");
  source.addEventListener("page", (event) => show(JSON.parse(event.data)));
  source.addEventListener("over", () => {
    source.close();
    $("state").textContent = "dynlab has ended; this is the last page";
  });
  source.onerror = () => { $("state").textContent = "no answer from dynlab; waiting for it"; version = -1; };
}

/// Browsers open six connections to one server, whatever the number of tabs: those that nobody sees let theirs go.
document.addEventListener("visibilitychange", () => {
  if (!document.hidden) return connect();
  if (source) source.close();
  source = null;
});

const order = (path) => fetch(path, { method: "POST" });
$("stop").onclick = () => order("/stop");
$("anew").onclick = () => order("/anew");
$("allow").onclick = () => order("/allow");

$("document").addEventListener("click", (event) => {
  const piece = event.target.closest(".piece");
  for (const node of document.querySelectorAll(".chosen")) node.classList.remove("chosen");
  if (!piece) return;
  piece.classList.add("chosen");
  $("place").textContent = `${piece.dataset.file}:${piece.dataset.line}`;
});

if (!document.hidden) connect();
