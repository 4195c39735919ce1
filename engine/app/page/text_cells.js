// Text cells look in the editor as they do in the document, until the cursor goes into them: then they are written.
import { cellsOf } from "./script_mode.js";
import { say } from "./page_words.js";

const make = (name, kind = "") => Object.assign(document.createElement(name), { className: kind });
const kSoon = 60;  // ms

/// What the document shows of these pieces, without what lives in it.
function copyOf(pieces) {
  const box = make("div", "text-cell");
  for (const piece of pieces) {
    const copy = piece.cloneNode(true);
    for (const node of copy.querySelectorAll(".plot, .plot-data, .plot-data-tables, .tools, .copy")) node.remove();
    for (const node of [copy, ...copy.querySelectorAll("[id]")]) node.removeAttribute("id");
    for (const picture of copy.querySelectorAll("img.printed")) picture.classList.remove("printed");
    copy.className = "";
    box.append(copy);
  }
  return box;
}

/// `look()` gives {pieces(first, last): of the document, for lines from 1; run(line)}; null where the text is another than the
/// document's.
export function showTextCells(cm, look) {
  const ofDocs = new WeakMap();  // document -> [{mark, ids of its pieces}]
  let shown = [], timer = 0;

  const enter = (mark, line) => {
    mark.clear();
    cm.focus();
    cm.setCursor(line, 0);
  };
  function replace({ marker, end }, pieces, ids) {
    const node = copyOf(pieces);
    const mark = cm.markText({ line: marker, ch: 0 }, { line: end, ch: cm.getLine(end).length },
                             { replacedWith: node, clearOnEnter: true, inclusiveLeft: true, inclusiveRight: false, handleMouseEvents: false });
    node.title = say("editText");
    node.addEventListener("mousedown", (event) => {
      if (event.target.closest("a, button, summary")) return;
      event.preventDefault();
      const place = mark.find(), part = event.target.closest("[data-line]");
      if (place) enter(mark, Math.min(place.to.line, part ? place.from.line + Number(part.dataset.line) - Number(pieces[0].dataset.line) + 1 : place.from.line + 1));
    });
    for (const picture of node.querySelectorAll("img")) picture.addEventListener("load", () => mark.changed(), { once: true });
    shown.push({ mark, ids });
  }

  function refresh() {
    timer = 0;
    const { pieces: piecesOf, run } = look() ?? {}, cursor = cm.getCursor().line, focused = cm.hasFocus();
    if (!piecesOf) return;
    shown = ofDocs.get(cm.getDoc()) ?? [];
    cm.operation(() => {
      cm.clearGutter("cells");
      const cells = cellsOf(cm);
      cells.forEach((cell, i) => { cell.end = (cells[i + 1]?.marker ?? cm.lineCount()) - 1; });
      for (const cell of cells.filter(({ text }) => !text)) {
        const button = Object.assign(make("button", "run-cell"), { textContent: "▶", title: say("runCell"), tabIndex: -1 });
        button.onclick = () => run(cell.first);
        cm.setGutterMarker(cell.marker, "cells", button);
      }
      for (const cell of cells.filter(({ text }) => text)) {
        const pieces = piecesOf(cell.marker + 1, cell.end + 1), ids = pieces.map(({ id }) => id).join(" ");  // of what they hold
        const known = shown.find(({ mark }) => mark.find()?.from.line === cell.marker);
        const open = focused && cell.marker <= cursor && cursor <= cell.end;
        if (known?.ids === ids && !open) continue;
        known?.mark.clear();
        if (pieces.length > 0 && !open) replace(cell, pieces, ids);
      }
      shown = shown.filter((one) => one.mark.find());
      ofDocs.set(cm.getDoc(), shown);
    });
  }
  const soon = () => { timer ||= setTimeout(refresh, kSoon); };
  cm.on("cursorActivity", soon);
  cm.on("focus", soon);
  cm.on("blur", soon);
  cm.on("swapDoc", soon);
  cm.on("renderLine", (_, { text }, element) => { if (/^\s*--\s*%%/.test(text)) element.classList.add("cell-line"); });
  return soon;
}
