// A lesson's script as its page edits it: the text between the markers of its cells. The joined parts give the script
// again, byte for byte if nothing was changed.
const kMarker = /^\s*--\s*%%/, kText = /^\s*--\s*%%.*\[markdown\]/, kId = /\bid=([\w.-]+)/;

export const isMarker = (line) => kMarker.test(line);
const sameMarker = (a, b) => (kId.exec(a)?.[1] ?? a.trim()) === (kId.exec(b)?.[1] ?? b.trim());

/// The ids of the code cells of a text, as the engine gives them: that of the marker, else "cell-N".
export function cellIds(text) {
  const ids = [], seen = new Set();
  let number = 0;
  for (const line of text.split("\n").filter(isMarker)) {
    ++number;
    const own = kId.exec(line)?.[1], id = own && !seen.has(own) ? own : `cell-${number}`;
    seen.add(id);
    if (!kText.test(line)) ids.push(id);
  }
  return ids;
}

/// Lines that all are comments, without their signs; null for others.
export function withoutSigns(source) {
  const lines = source.split("\n");
  return lines.every((line) => /^--( |$)/.test(line) && !isMarker(line)) ? lines.map((line) => line.slice(3)).join("\n") : null;
}
export const withSigns = (text) => text.split("\n").map((line) => (line === "" ? "--" : `-- ${line}`)).join("\n");

/// `original`: the script of the lesson. A place is the text after one marker: {marker, text, isText}; the first has
/// none.
export class LessonScript {
  constructor(original) {
    this.original = original;
    this.places = LessonScript.split(original);
  }
  static split(text) {
    const places = [{ marker: null, lines: [] }];
    for (const line of text.split("\n")) {
      if (isMarker(line)) places.push({ marker: line, lines: [] });
      else places.at(-1).lines.push(line);
    }
    return places.map(({ marker, lines }) => {
      const blank = /(?:\n\s*)*$/.exec(lines.join("\n"))[0], whole = lines.join("\n");
      return { marker, isText: marker !== null && kText.test(marker), source: whole.slice(0, whole.length - blank.length), blank };
    });
  }
  /// The script with these texts of places, by number, instead of the lesson's own; {text, first: line of each place,
  /// from 1}.
  compose(texts = new Map()) {
    const pieces = [], first = [];
    let line = 1;
    for (const [i, { marker, source, blank }] of this.places.entries()) {
      const text = (texts.get(i) ?? source) + blank;
      if (marker !== null) { pieces.push(marker); ++line; }
      first.push(line);
      // What has a marker and nothing behind it takes no line.
      const lines = text === "" && this.isEmpty(i) && !texts.get(i) ? [] : text.split("\n");
      pieces.push(...lines);
      line += lines.length;
    }
    return { text: pieces.join("\n"), first };
  }
  isEmpty(i) { return this.places[i].source === "" && this.places[i].blank === "" && !this.hasLine(i); }
  hasLine(i) {
    this.withLine ??= LessonScript.lineCounts(this.original);
    return this.withLine[i] > 0;
  }
  static lineCounts(text) {
    const counts = [0];
    for (const line of text.split("\n")) {
      if (isMarker(line)) counts.push(0);
      else ++counts[counts.length - 1];
    }
    return counts;
  }
  /// The number of the place that a line (from 1) of the lesson's script is in.
  placeAt(line) {
    const { first } = this.compose();
    return first.findLastIndex((begin) => begin <= line);
  }
  /// The texts of the places in another version of the script, where it has all the markers in their order; else null.
  textsOf(other) {
    const wanted = this.places.slice(1).map(({ marker }) => marker), lines = other.split("\n"), parts = [[]];
    let next = 0;
    for (const line of lines) {
      if (next < wanted.length && isMarker(line) && sameMarker(line, wanted[next])) {
        parts.push([]);
        ++next;
      } else {
        parts.at(-1).push(line);
      }
    }
    if (next < wanted.length) return null;
    const texts = new Map();
    parts.forEach((part, i) => {
      const { source, blank } = this.places[i], whole = part.join("\n");
      if (whole === source + blank) return;
      texts.set(i, whole.endsWith(blank) ? whole.slice(0, whole.length - blank.length) : whole.trimEnd());
    });
    return texts;
  }
}
