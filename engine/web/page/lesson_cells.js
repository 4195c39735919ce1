// The cells of a lesson's page: code cells are editors with their results, text cells can be edited. They represent the
// places of the lesson's script (lesson_script.js).
import { cellEditor } from "./cell_editor.js";
import { nameFigures, showResults } from "./cell_results.js";
import { cellIds, withoutSigns, withSigns } from "./lesson_script.js";
import { changedBlocks } from "./markdown_text.js";
import { say } from "./site_words.js";

const make = (name, kind = "", text = "") => Object.assign(document.createElement(name), { className: kind, textContent: text });
const button = (key, act, kind = "") => {
  const node = make("button", kind, say(key));
  node.type = "button";
  node.onclick = act;
  return node;
};

/// A code cell: `node` is its section in the page, `place` its number in the script.
class CodeCell {
  constructor(page, node, place) {
    Object.assign(this, { page, node, place, id: node.dataset.cell, editor: null });
    this.results = node.querySelector(".results");
    this.code = node.querySelector("pre.code");
    this.begin();
  }
  get source() { return this.page.textOf(this.place); }
  begin() {
    const bar = make("div", "cell-bar"), holder = make("div", "cell-code"), hidden = this.code.hidden;
    this.isHidden = hidden;
    this.runButton = make("button", "run-cell", "▶");
    this.runButton.type = "button";
    this.runButton.title = say("runOne");
    this.runButton.setAttribute("aria-label", `${say("runOne")}: ${this.id}`);
    this.runButton.onclick = () => this.page.run(this);
    bar.append(this.runButton, make("span", "cell-name", this.id));
    if (hidden) {
      const more = make("details", "hidden-code");
      more.append(make("summary", "", say("hiddenCode")), holder);
      more.ontoggle = () => this.editor.refresh();
      this.code.after(bar, more);
    } else {
      this.code.after(bar, holder);
    }
    this.code.remove();
    this.editor = cellEditor(holder, this.source, {
      label: say("codeOf", this.id),
      change: (text) => { this.results.classList.add("stale"); this.page.change(this.place, text); },
      run: (moveOn) => this.page.run(this, moveOn),
      enter: () => this.page.enter(this),
      where: () => this.page.where(this.place),
    });
  }
  /// The text of the place is another now.
  renew() { this.editor.text = this.source; }
  set readOnly(on) { this.editor.readOnly = on; }
  get ids() { return [this.id, ...cellIds(this.source).filter((id) => id !== this.id)]; }
  setState(state, share = 0) {
    this.node.dataset.state = state;
    this.node.style.setProperty("--done", share || 1);
  }
  show(results, error) { showResults(this.results, this.shownIds ?? [this.id], results, error); }
}

/// A text cell: shown as the site has it until it is another text.
class TextCell {
  constructor(page, node, place) {
    Object.assign(this, { page, node, place, made: [...node.childNodes] });
    nameFigures(node, page.textOf(place));
    this.edit = button("changeText", () => this.open(), "edit-text");
    this.shown = null;
    this.renew();
  }
  get source() { return this.page.textOf(this.place); }
  renew() {
    if (this.field) this.close(false);
    if (this.shown === this.source) return;
    this.shown = this.source;
    const own = this.source !== this.page.ownText(this.place), text = withoutSigns(this.source);
    const before = withoutSigns(this.page.ownText(this.place)) ?? "";
    const nodes = !own ? this.made : text === null ? [make("pre", "code", this.source)] : changedBlocks(text, before, this.made);
    this.node.replaceChildren(...nodes, this.edit);
    this.node.classList.toggle("own", own);
    if (own) this.page.redraw(this.node);
  }
  set readOnly(on) { this.edit.hidden = on; }
  open() {
    const text = withoutSigns(this.source), field = make("textarea", "cell-field text-field");
    this.plain = text !== null || this.source === "";
    field.value = this.plain ? text ?? "" : this.source;
    field.rows = field.value.split("\n").length + 2;
    field.setAttribute("aria-label", say("textOf"));
    field.oninput = () => this.page.change(this.place, this.plain ? withSigns(field.value) : field.value);
    field.onkeydown = (event) => {
      if (event.key !== "Escape" && !(event.key === "Enter" && (event.shiftKey || event.ctrlKey))) return;
      event.preventDefault();
      this.close();
    };
    this.field = field;
    this.shown = null;
    this.node.replaceChildren(field, button("endText", () => this.close(), "end-text"));
    field.focus();
    const mark = field.value.search(/^\*[^*\n]+:\*$/m);
    if (mark >= 0) field.setSelectionRange(mark, mark + /^.*$/m.exec(field.value.slice(mark))[0].length);
  }
  close(focus = true) {
    this.field = null;
    this.renew();
    if (focus) this.edit.focus({ preventScroll: true });
  }
}

/// The cells below `main`, in their order. `page` holds the script: textOf(place), ownText(place), change(place, text), run(cell, moveOn),
/// enter(cell), where(place), redraw(node).
export function cellsOfPage(main, page) {
  const cells = [];
  for (const node of main.querySelectorAll(":scope > section.cell, :scope > div.text")) {
    const place = page.placeAt(Number(node.dataset.first));
    cells.push(node.matches("section.cell") ? new CodeCell(page, node, place) : new TextCell(page, node, place));
  }
  return { all: cells, code: cells.filter((cell) => cell instanceof CodeCell) };
}
