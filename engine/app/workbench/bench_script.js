// The script beside the pictures: what is typed is the session, too.
import { beforeOrders, change, session, trouble } from "./bench_session.js";
import { merged } from "./bench_merge.js";
import { say } from "./bench_words.js";

const kRest = 400;  // ms after the last key
const kPause = 2000;  // ms without a key, behind which a new step of the history begins
const kMargin = 60;  // px between a line that is shown and the edge
let mirror = null, timer = 0, own = false, line = -1;
let shown = "";  // the session's text from which the editor's comes
let typing = false, unsent = false;  // the editor has text that the session does not have yet; that it did not take
let hand = {}, typedAt = { time: 0, line: -1 };  // what is typed in one go into one line is one step of the history

function loaded(file) {
  return new Promise((yes, no) => {
    const css = file.endsWith(".css");
    const node = Object.assign(document.createElement(css ? "link" : "script"), css ? { rel: "stylesheet", href: file } : { src: file, async: false });
    node.onload = yes;
    node.onerror = no;
    document.head.append(node);
  });
}

const textNow = () => (mirror ? mirror.getValue() : document.getElementById("field").value);

function typed() {
  const now = { time: Date.now(), line: mirror ? mirror.getCursor().line : 0 };
  if (now.line !== typedAt.line || now.time - typedAt.time > kPause) nextHand();
  typedAt = now;
  typing = true;
  unsent = false;
  clearTimeout(timer);
  timer = setTimeout(sendTyped, kRest);
}
/// What is not sent yet still belongs to the step before.
function nextHand() {
  sendTyped();
  hand = {};
}
/// What was typed since `shown` goes into the session as it has become meanwhile.
function sendTyped() {
  if (!timer) return;
  clearTimeout(timer);
  timer = 0;
  let mine = "", result = null;
  const make = () => {
    mine = textNow();
    result = merged(shown, mine, session.source);
    return result.text === session.source ? null : { text: result.text };
  };
  const done = () => {
    shown = mine;
    typing = textNow() !== mine;
    showScript();
    if (result.clashed) trouble(say("typedOver"));
  };
  change(make, { done, hand }).then(() => { unsent = typing && !timer; });
}
beforeOrders(sendTyped);
document.addEventListener("visibilitychange", () => { if (document.hidden) sendTyped(); });

export async function openScript() {
  const field = document.getElementById("field");
  try {
    await loaded("codemirror.js");
    await Promise.all([loaded("codemirror.css"), loaded("codemirror-lua.js")]);
    mirror = CodeMirror(document.getElementById("code"), { mode: "lua", lineNumbers: true, lineWrapping: true, value: session.source,
                                                          extraKeys: { Tab: false, "Shift-Tab": false, "Ctrl-Z": () => document.getElementById("undo").click(), "Ctrl-Y": () => document.getElementById("redo").click() } });
    mirror.getInputField().setAttribute("aria-label", say("script"));
    mirror.on("change", () => { if (!own) typed(); });
  } catch {
    field.hidden = false;
    field.ariaLabel = say("script");
    document.getElementById("code").hidden = true;
    field.oninput = typed;
  }
  showScript();
}

/// Shows the current text and marks the changes, unless the user is typing; sends text again that could not be sent.
export function showScript() {
  const field = document.getElementById("field");
  if (typing) { if (unsent) typed(); return; }
  const before = shown.split("\n"), after = session.source.split("\n");
  shown = session.source;
  if (!mirror) { if (field.value !== shown) field.value = shown; return; }
  if (mirror.getValue() !== shown) {
    let first = 0, last = 0;
    while (first < before.length && first < after.length && before[first] === after[first]) ++first;
    while (last < before.length - first && last < after.length - first && before[before.length - 1 - last] === after[after.length - 1 - last]) ++last;
    own = true;
    const old = mirror.getValue().split("\n");
    if (old.join("\n") === before.join("\n") && before.length > 1)
      mirror.replaceRange(after.slice(first, after.length - last).join("\n") + (last > 0 && after.length - last > first ? "\n" : ""), { line: first, ch: 0 },
                          last > 0 ? { line: before.length - last, ch: 0 } : { line: before.length, ch: 0 });
    if (mirror.getValue() !== shown) mirror.setValue(shown);
    own = false;
    if (before.length > 1) mark(first, after.length - last);
  }
  showMistake();
}

function mark(first, last) {
  for (let i = first; i < last; ++i) mirror.addLineClass(i, "wrap", "fresh-line");
  const { top } = mirror.charCoords({ line: Math.min(first, mirror.lineCount() - 1), ch: 0 }, "local"), { top: from, clientHeight: height } = mirror.getScrollInfo();
  if (top < from + kMargin || top > from + height - kMargin) mirror.scrollTo(null, top - kMargin);  // scrollIntoView() moves the page, too
  setTimeout(() => mirror.eachLine((handle) => mirror.removeLineClass(handle, "wrap", "fresh-line")), 1500);
}

/// The program has ended: nothing that is typed is heard.
export function closeScript() {
  mirror?.setOption("readOnly", true);
  document.getElementById("field").readOnly = true;
}

/// Puts the cursor into a line of the script, from 1 on.
export function showLine(number) {
  if (document.body.classList.contains("without-script")) document.getElementById("show-script").click();
  const field = document.getElementById("field");
  if (!mirror) return field.focus();
  mirror.setCursor({ line: number - 1, ch: 0 });
  mirror.focus();
}

export function showMistake() {
  if (!mirror) return;
  if (line >= 0 && line < mirror.lineCount()) mirror.removeLineClass(line, "wrap", "broken-line");
  line = session.error?.line > 0 ? session.error.line - 1 : -1;
  if (line >= 0 && line < mirror.lineCount()) mirror.addLineClass(line, "wrap", "broken-line");
}
