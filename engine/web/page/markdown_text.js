// The text of a user's text cell in the form that a page can show without Pandoc: paragraphs, headings, lists,
// emphasis, code, values and figures of the run. Formulas are shown as source text.
const make = (name, text = "", kind = "") => Object.assign(document.createElement(name), { textContent: text, ...(kind && { className: kind }) });
const kInline = /`([^`]+)`\{\.value\}|`([^`]+)`|\*\*([^*]+)\*\*|\*([^*\s][^*]*)\*|(\$[^$]+\$)/g;

function inline(node, text) {
  let end = 0;
  for (const found of text.matchAll(kInline)) {
    const [all, value, code, strong, emphasis, formula] = found;
    node.append(text.slice(end, found.index));
    if (value) {
      node.append(make("span", "?", "value"));
      node.lastChild.dataset.name = value;
    }
    if (code ?? formula) node.append(make("code", code ?? formula));
    if (strong) node.append(make("strong", strong));
    if (emphasis) node.append(make("em", emphasis));
    end = found.index + all.length;
  }
  node.append(text.slice(end));
  return node;
}

function block(text) {
  const heading = /^(#{1,4})\s+(.*)$/.exec(text), figure = /^!\[([^\]]*)\]\(figure:([\w.-]+)\)/.exec(text);
  if (figure) {
    const node = make("figure");
    node.dataset.figure = figure[2];
    node.append(inline(make("figcaption"), figure[1]));
    return node;
  }
  if (heading) return inline(make(`h${heading[1].length}`), heading[2].replace(/\s*\{.*\}$/, ""));
  const lines = text.split("\n");
  if (lines.every((line) => /^\s*([-*]|\d+\.)\s/.test(line))) {
    const list = make(/^\s*\d/.test(text) ? "ol" : "ul");
    list.append(...lines.map((line) => inline(make("li"), line.replace(/^\s*([-*]|\d+\.)\s+/, ""))));
    return list;
  }
  return inline(make("p"), lines.join(" "));
}

const piecesOf = (markdown) => markdown.split(/\n\s*\n/).map((text) => text.trim()).filter(Boolean);
export const blocksOf = (markdown) => piecesOf(markdown).map(block);

/// The same if `before` was rendered as these nodes: unchanged blocks keep their nodes if each block has one.
export function changedBlocks(markdown, before, nodes) {
  const old = piecesOf(before), elements = nodes.filter((node) => node.nodeType === Node.ELEMENT_NODE), known = new Map();
  if (old.length === elements.length) old.forEach((text, i) => known.set(text, elements[i]));
  return piecesOf(markdown).map((text) => {
    const node = known.get(text);
    known.delete(text);
    return node ?? block(text);
  });
}
