// The script as CodeMirror shows it: text cells as Markdown behind faint comment signs, code cells as Lua. And its cells.

const kMarker = /^\s*--\s*%%/, kText = /^\s*--\s*%%.*\[markdown\]/, kSign = /^\s*-- ?/;

export function defineScriptMode() {
  const { defineMode, getMode, copyState } = window.CodeMirror;
  defineMode("dynlab", (config) => {
    const lua = getMode(config, "lua"), markdown = getMode(config, "markdown");
    return {
      startState: () => ({ text: false, lua: lua.startState(), markdown: markdown.startState(), behindSign: false }),
      copyState: (state) => ({ ...state, lua: copyState(lua, state.lua), markdown: copyState(markdown, state.markdown) }),
      token(stream, state) {
        if (stream.sol()) {
          state.behindSign = false;
          if (kMarker.test(stream.string)) {
            state.text = kText.test(stream.string);
            if (state.text) state.markdown = markdown.startState();
            else state.lua = lua.startState();
            stream.skipToEnd();
            return "cell";
          }
        }
        if (!state.text) return lua.token(stream, state.lua);
        if (!state.behindSign) {
          state.behindSign = true;
          if (stream.match(kSign)) return "sign";
        }
        // Markdown looks for the beginning of lines, and at the next line: it reads both without their signs.
        const before = stream.lineStart;
        if (stream.string[0] === "-") stream.lineStart = Math.min(3, stream.string.length);
        const { lookAhead } = stream;
        stream.lookAhead = (n) => lookAhead.call(stream, n)?.replace(kSign, "");
        const style = markdown.token(stream, state.markdown);
        stream.lineStart = before;
        delete stream.lookAhead;
        return style;
      },
      blankLine(state) { if (state.text) markdown.blankLine?.(state.markdown); },
      indent: (state, after, line) => (state.text || !lua.indent ? 0 : lua.indent(state.lua, after, line)),
      electricInput: lua.electricInput,
      lineComment: "--",
      fold: "dynlab",
    };
  });
  window.CodeMirror.registerHelper("fold", "dynlab", (cm, start) => {
    const header = start.line === 0 ? endOfHeader(cm) : 0;
    if (header > 0) return { from: { line: 0, ch: cm.getLine(0).length }, to: { line: header, ch: cm.getLine(header).length } };
    const cell = cellsOf(cm).find(({ marker }) => marker === start.line);
    if (!cell || cell.last <= cell.marker) return undefined;
    return { from: { line: cell.marker, ch: cm.getLine(cell.marker).length }, to: { line: cell.last, ch: cm.getLine(cell.last).length } };
  });
}

/// The line with which the header ends; 0 where there is none.
function endOfHeader(cm) {
  const isRule = (line) => /^--\s*---\s*$/.test(cm.getLine(line) ?? "");
  for (let line = 1; isRule(0) && line < cm.lineCount() && cm.getLine(line).startsWith("--"); ++line) if (isRule(line)) return line;
  return 0;
}

/// The cells of a script: {marker, first, last, text}, lines from 0; `first` is the line behind the marker, `last` the last one
/// that is not empty.
export function cellsOf(cm) {
  const cells = [];
  cm.eachLine((handle) => {
    const line = handle.lineNo();
    if (kMarker.test(handle.text)) cells.push({ marker: line, first: line + 1, last: line, text: kText.test(handle.text) });
    else if (cells.length > 0 && handle.text.trim() !== "") cells[cells.length - 1].last = line;
  });
  return cells;
}
export const cellAt = (cm, line) => cellsOf(cm).findLast(({ marker }) => marker <= line);

/// Enter: in a line of a text cell, the next line is text, too.
export function newLine(cm) {
  const inText = ({ head: { line, ch } }) => cellAt(cm, line)?.text && ch >= 2 && cm.getLine(line).startsWith("--");
  if (!cm.listSelections().every(inText)) return window.CodeMirror.Pass;
  cm.replaceSelection("\n-- ");
  cm.scrollIntoView(null);
  return undefined;
}

/// Headings and questions of the text cells: {line, level, words}, lines from 0; questions have level 7.
export function outlineOf(cm) {
  const found = [];
  let inText = false;
  cm.eachLine((handle) => {
    const { text } = handle;
    if (kMarker.test(text)) inText = kText.test(text);
    const heading = inText && /^--\s+(#{1,6})\s+(.*?)\s*(\{.*\})?$/.exec(text);
    const question = inText && /^--\s+\*\*(Question [^*]*?)\.?\*\*\s*(.*)/.exec(text);
    if (heading) found.push({ line: handle.lineNo(), level: heading[1].length, words: heading[2] });
    if (question) found.push({ line: handle.lineNo(), level: 7, words: `${question[1]}: ${question[2]}` });
  });
  return found;
}
