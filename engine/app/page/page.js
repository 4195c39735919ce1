// A live document: puts the server's news into the page, and keeps the reader's scroll position.
import { controlsByCell } from "./sliders.js";
import * as editor from "./editor.js";
import { showFindings } from "./findings.js";
import { label, number, say, useLanguage } from "./page_words.js";
import { session } from "./session.js";
import "./hand_in.js";

const $ = (id) => document.getElementById(id);
const nodes = new Map();  // id of a piece -> its element
let version = -1;
let sliders = [];
let findings = null;
let language = null;

/// The page speaks as its document does.
function speak(code) {
  if (code === language) return;
  language = code;
  useLanguage(code);
  label();
  editor.speak();
}

/// The piece at the top of the window, and how far from there: what must not move.
function anchor() {
  const top = $("top").getBoundingClientRect().bottom;
  for (const node of $("document").children) {
    const box = node.getBoundingClientRect();
    if (box.bottom > top) return { node, index: [...node.parentNode.children].indexOf(node), top: box.top };
  }
  return null;
}

/// The anchor itself, or the element now at its place.
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
  if (html === "") {  // code that is not printed; shown where it can be changed
    node.classList.add("unseen");
    const button = document.createElement("button");
    button.onclick = () => goTo(node.dataset.file, Number(node.dataset.line));
    node.append(button);
  }
  return node;
}

function place(pieces, html) {
  const main = $("document");
  const first = nodes.size === 0, added = [];
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
      if (!first) added.push(node);
      nodes.set(id, node);
    }
    node.dataset.cell = cell;
    node.dataset.line = line;
    node.dataset.file = file;
    if (node.classList.contains("unseen")) node.firstChild.textContent = say("notPrinted", cell);
    if (node === before) before = before.nextElementSibling;
    else main.insertBefore(node, before);
    while (before?.classList.contains("slider")) before = before.nextElementSibling;
  }
  for (const node of added) dynlabPlots.enlivenNow(node);  // at once: a hand may be at a handle
  dynlabPlots.enliven(main);
  dynlabChoices.enliven(main);
  return true;
}

/// The content above and below the pieces: notes, literature, and what follows it.
const filled = new Map();  // element -> its HTML
function fill(element, html) {
  if (filled.get(element) === html) return;
  filled.set(element, html);
  element.innerHTML = html;
  dynlabChoices.enliven(element);
}

/// Behind the code of the cell that asks for them.
function placeSliders(running) {
  for (const [cell, controls] of controlsByCell(sliders, running)) {
    let behind = document.querySelector(`.piece[data-cell="${CSS.escape(cell)}"]`);
    if (!behind) continue;
    for (const control of controls) {
      if (behind.nextElementSibling !== control) behind.after(control);
      behind = control;
    }
  }
}

function showStates(page) {
  let done = 0, failed = 0, total = 0, seconds = 0, running = "", share = 0;
  for (const [cell, { state, seconds: took, progress }] of Object.entries(page.states)) {
    ++total;
    seconds += took;
    if (state === "done" || state === "recalled") ++done;
    if (state === "failed") ++failed;
    if (state === "running") [running, share] = [cell, progress];
  }
  for (const node of nodes.values()) {
    const state = page.states[node.dataset.cell]?.state;
    if (state) node.dataset.state = state;
    else delete node.dataset.state;
    node.style.setProperty("--done", page.states[node.dataset.cell]?.progress || 1);
    node.classList.toggle("older", failed > 0 && state === "waiting");
  }
  $("state").textContent = page.recalled ? say(page.running ? "ofBeforeRunning" : "ofBefore")
    : page.running ? [say("cellOf", Math.min(done + 1, total), total), running, share > 0 ? `${Math.floor(100 * share)} %` : ""].filter(Boolean).join(", ")
    : failed > 0 ? say("mistake") : done < total ? say("stoppedAfter", done, total)
    : total > 0 ? say("cells", total, number(seconds.toFixed(1))) : "";
  $("stop").hidden = !page.running;
  $("to-mistake").hidden = failed === 0;
}

$("to-mistake").onclick = () => {
  const piece = document.querySelector("#document .piece[data-state=failed]");
  const said = document.querySelector("#document pre.error") ?? piece;
  said?.scrollIntoView({ block: "center" });
  const place = placeIn(said?.textContent) ?? (piece && [piece.dataset.file, Number(piece.dataset.line)]);
  if (place) editor.goTo(...place);
};

/// The first "analysis.lua:12" of a text: file and line.
function placeIn(text) {
  const found = /([^\s\/:"]+\.(?:lua|md)):(\d+)/.exec(text ?? "");
  return found && [found[1], Number(found[2])];
}

function showComplaints(complaints) {
  $("complaints").hidden = complaints.length === 0;
  $("complaints").replaceChildren(...complaints.map((text) => {
    const line = document.createElement("p"), place = placeIn(text);
    if (place) {
      const button = document.createElement("button");
      button.textContent = text;
      button.onclick = () => goTo(...place);
      line.append(button);
    } else {
      line.textContent = text;
    }
    return line;
  }));
}

function show(page) {
  if (!page.all && version < 0) return;
  if (page.version < version) return;
  speak(page.language);
  const held = anchor();
  if (page.pieces) {
    if (!page.all && page.version > version + 1 || !place(page.pieces, page.html)) return connect();
    fill($("head"), page.head);
    fill($("page:notes"), page.notes);
    sliders = page.sliders;
  }
  version = page.version;
  document.title = page.name + (page.name ? " · " : "") + "dynlab";
  $("name").textContent = page.name;
  if (page.asking && $("question").hidden && document.activeElement === document.body) setTimeout(() => $("question").focus());
  $("question").hidden = !page.asking;
  $("asked-about").textContent = say(page.made_here ? "askedAboutOwn" : "askedAbout");
  showComplaints(page.complaints);
  showStates(page);
  placeSliders(page.running);
  if ("findings" in page) findings = page.findings;
  showFindings(findings, page.open_answers, !page.pdf_is_ready, { goTo, goToPage, goToName }, page.checking);
  showPdf(page.pdf_is_ready);
  $("show-hand-in").hidden = !page.hands_in || page.asking;
  editor.follow(page.sources, { showLine, piecesOf });
  editor.tell(page.error ?? null);
  if (marked) mark(pieceAt(...marked));
  hold(held);
  restorePlace();
}

/// A page that is loaded again begins where it was left.
let left = sessionStorage.getItem("dynlab-place");
function restorePlace() {
  if (left === null || nodes.size === 0) return;
  window.scrollTo(0, Number(left));
  left = null;
}
window.addEventListener("pagehide", () => sessionStorage.setItem("dynlab-place", String(window.scrollY)));

/// The last piece of a file that begins at a line or before it.
function pieceAt(file, line) {
  let found = null;
  const editing = document.body.classList.contains("editing");
  for (const node of $("document").children) {
    if (node.classList.contains("unseen") && !editing) continue;
    if (node.dataset.file === file && Number(node.dataset.line) <= line) found = node;
  }
  return found;
}

/// Those of the pieces that come from these lines of a file.
function piecesOf(file, first, last) {
  const lineOf = ({ dataset }) => Number(dataset.line);
  return [...nodes.values()].filter((node) => node.dataset.file === file && lineOf(node) >= first && lineOf(node) <= last && !node.dataset.cell)
    .sort((a, b) => lineOf(a) - lineOf(b));
}

let marked = null;  // file and line of what is marked
function mark(piece) {
  marked = piece && [piece.dataset.file, Number(piece.dataset.line)];
  for (const node of document.querySelectorAll(".chosen")) node.classList.remove("chosen");
  piece?.classList.add("chosen");
  $("place").textContent = piece ? `${piece.dataset.file}:${piece.dataset.line}` : "";
}

/// Where the page ends to the eye: on narrow screens the editor lies over its lower part.
function bottomOfView() {
  const editing = $("editor").getBoundingClientRect();
  return editing.height > 0 && editing.top > 0 ? editing.top : window.innerHeight;
}

/// The page follows the cursor of the source: it scrolls the matching piece into view.
function showLine(file, line) {
  const piece = pieceAt(file, line);
  mark(piece);
  if (!piece) return;
  const box = piece.getBoundingClientRect(), top = $("top").getBoundingClientRect().bottom;
  if (box.top < top || box.bottom > bottomOfView()) piece.scrollIntoView({ block: "center" });
}

function goTo(file, line) {
  if (pdfShown) $("view").click();
  if (!editor.goTo(file, line)) showLine(file, line);
}

/// Where the document speaks of an answer, or hands it in.
function goToName(name) {
  const isOf = ({ textContent }) => textContent === name || textContent.includes(`answer("${name}"`);
  const code = [...$("document").querySelectorAll("code")].find(isOf);
  const piece = code?.closest(".piece");
  if (piece) goTo(piece.dataset.file, Number(piece.dataset.line));
}

/// A page of the printed document.
function goToPage(number) {
  if (!pdfShown) $("view").click();
  showPdf(pdfReady, number);
}

/// The printed document replaces the page; a new PDF is loaded when one is ready.
let pdfShown = false, pdfReady = false;
function showPdf(ready, page = 0) {
  const first = ready && !pdfReady;
  pdfReady = ready;
  $("view").classList.toggle("ready", ready);
  if (!pdfShown) return $("page:pdf").replaceChildren();
  if (!first && !page && $("page:pdf").firstChild) return;
  const frame = document.createElement("iframe");
  frame.title = say("asPrinted");
  frame.src = `${session.pdfAddress(version)}#${page ? `page=${page}&` : ""}navpanes=0&view=FitH`;
  $("page:pdf").replaceChildren(frame);
}

let scrolled = 0;  // the page, while the PDF is in its place
$("view").onclick = () => {
  pdfShown = !pdfShown;
  if (pdfShown) scrolled = window.scrollY;
  $("view").setAttribute("aria-pressed", String(pdfShown));
  $("page:pdf").hidden = !pdfShown;
  for (const id of ["head", "document", "page:notes"]) $(id).hidden = pdfShown;
  showPdf(pdfReady);
  window.scrollTo(0, pdfShown ? 0 : scrolled);
};

/// One stream of news; the browser reconnects automatically when the stream is cut, and then receives everything.
function connect() {
  version = -1;
  session.open({ page: show,
                 over: () => { $("state").textContent = say("ended"); },
                 away: () => { $("state").textContent = say("noAnswer"); version = -1; } });
}

/// Browsers open six connections to one server, whatever the number of tabs: hidden tabs close theirs.
document.addEventListener("visibilitychange", () => {
  if (!document.hidden) return connect();
  session.close();
});

async function ask(act) {
  await act().catch(() => { $("state").textContent = say("lost"); });
  $("document").focus({ preventScroll: true });
}
$("stop").onclick = () => ask(session.stop);
$("run-all").onclick = () => ask(session.runAll);
$("allow").onclick = () => ask(session.allow);

$("document").addEventListener("click", (event) => {
  if (event.target.closest(".slider, .plot, .motion, .option, a, button, summary, input")) return;
  const piece = event.target.closest(".piece");
  mark(piece);
  const place = placeIn(event.target.closest("pre.error")?.textContent);
  if (place && window.getSelection().isCollapsed) return editor.goTo(...place);
  if (piece && window.getSelection().isCollapsed) editor.goTo(piece.dataset.file, Number(piece.dataset.line));
});

if (!document.hidden) connect();
