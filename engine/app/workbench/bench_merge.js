// Two changes of one text, put together by lines.
const kMostPairs = 4e6;  // of lines that are compared; more counts as one change

/// How many lines `a` and `b` have in common at least, from each pair of lines on to their ends.
function lengths(a, b) {
  const table = Array.from({ length: a.length + 1 }, () => new Uint32Array(b.length + 1));
  for (let i = a.length - 1; i >= 0; --i)
    for (let k = b.length - 1; k >= 0; --k) table[i][k] = a[i] === b[k] ? table[i + 1][k + 1] + 1 : Math.max(table[i + 1][k], table[i][k + 1]);
  return table;
}

/// What became other, in order: the lines from `first` to before `end` of `before` became `lines`.
function changes(before, after) {
  let top = 0, tail = 0;
  while (top < before.length && top < after.length && before[top] === after[top]) ++top;
  while (tail < before.length - top && tail < after.length - top && before[before.length - 1 - tail] === after[after.length - 1 - tail]) ++tail;
  const a = before.slice(top, before.length - tail), b = after.slice(top, after.length - tail);
  if (a.length === 0 && b.length === 0) return [];
  if (a.length * b.length > kMostPairs) return [{ first: top, end: top + a.length, lines: b }];
  const common = lengths(a, b), found = [];
  let now = null;
  for (let i = 0, k = 0; i < a.length || k < b.length;) {
    if (i < a.length && k < b.length && a[i] === b[k]) { now = null; ++i; ++k; continue; }
    if (!now) found.push(now = { first: top + i, end: top + i, lines: [] });
    if (k >= b.length || (i < a.length && common[i + 1][k] >= common[i][k + 1])) { ++i; ++now.end; }
    else now.lines.push(b[k++]);
  }
  return found;
}

const isInsertion = ({ first, end }) => first === end;
/// Whether two changes affect the same lines. Two insertions at the same place do not clash: one follows the other.
const clash = (a, b) => (isInsertion(a) && isInsertion(b) ? false : a.first < b.end && b.first < a.end);
const isSame = (a, b) => a.first === b.first && a.end === b.end && a.lines.join("\n") === b.lines.join("\n");

/// `base` with the changes of both `mine` and `theirs`. If both change the same lines, mine are kept, and `clashed` is
/// true.
export function merged(base, mine, theirs) {
  if (theirs === base || mine === theirs) return { text: mine, clashed: false };
  const lines = base.split("\n"), ours = changes(lines, mine.split("\n"));
  const others = changes(lines, theirs.split("\n")).filter((one) => !ours.some((own) => isSame(own, one)));
  const fitting = others.filter((one) => !ours.some((own) => clash(own, one)));
  const result = [];
  let at = 0;
  for (const { first, end, lines: put } of [...ours, ...fitting].sort((a, b) => a.first - b.first || a.end - b.end)) {
    result.push(...lines.slice(at, first), ...put);
    at = end;
  }
  return { text: [...result, ...lines.slice(at)].join("\n"), clashed: fitting.length < others.length };
}
