// What a run leaves in a lesson's page: printed text, figures and errors behind their cells, values and named figures in the text.
const make = (name, kind = "", text = "") => Object.assign(document.createElement(name), { className: kind, textContent: text });
const plots = new Map();    // name -> what plot.js draws it from, of this run
const captions = new Map();

/// Replaces all content of `figure` except its caption with the drawing; an existing drawing is updated.
function drawFigure(figure, name) {
  const drawing = plots.get(name);
  if (!drawing) return;
  const words = captions.get(name) ?? "", data = JSON.parse(drawing);
  if (figure.drawn && figure.shown === drawing) return;
  figure.shown = drawing;
  if (figure.drawn) return figure.drawn.renew(data);
  for (const old of figure.querySelectorAll("img, .plot, .plot-data, .plot-data-tables, .motion")) old.remove();
  const holder = make("div", "drawing");
  figure.prepend(holder);
  const begin = () => { figure.drawn = dynlabPlots.show(holder, data, words); };
  if (figure.isConnected) begin();
  else requestAnimationFrame(begin);
}

/// News of a run: what is new of its figures.
export function takeFigures(figures) {
  for (const [name, { plot, caption }] of Object.entries(figures)) {
    plots.set(name, plot);
    captions.set(name, caption);
  }
}
export function forgetFigures() {
  plots.clear();
  captions.clear();
}

function output({ printed, figure: name }, kept) {
  const nodes = [];
  const text = (printed ?? "").replace(/\n+$/, "");
  if (text.trim() !== "") nodes.push(make("pre", "output", text));
  if (name) {
    const figure = kept.get(name) ?? make("figure");
    figure.dataset.figure = name;
    if (!figure.querySelector("figcaption") && captions.get(name)) figure.append(make("figcaption", "", captions.get(name)));
    drawFigure(figure, name);
    nodes.push(figure);
  }
  return nodes;
}

/// Shows the results of these cells in `box`, from `results` of the run; `error`: the text of the error that stopped
/// the run.
export function showResults(box, cells, results, error) {
  const kept = new Map([...box.querySelectorAll("figure[data-figure]")].map((figure) => [figure.dataset.figure, figure]));
  const nodes = cells.flatMap((cell) => (results?.outputs[cell] ?? []).flatMap((piece) => output(piece, kept)));
  if (error) nodes.push(make("pre", "error", error));
  box.replaceChildren(...nodes);
  box.classList.remove("stale");
}

function table({ header, rows }) {
  const node = make("table"), head = make("tr"), body = make("tbody");
  head.append(...header.map((text) => make("th", "", text)));
  body.append(...rows.map((cells) => {
    const row = make("tr");
    row.append(...cells.map((text) => make("td", "", text)));
    return row;
  }));
  node.append(make("thead"), body);
  node.firstChild.append(head);
  return node;
}

/// Fills values, figures and tables in the text below `root`.
export function showInText(root, results) {
  for (const node of root.querySelectorAll("span.value[data-name]")) {
    const value = results.values[node.dataset.name];
    if (value && node.textContent !== value.text) {
      node.textContent = value.text;
      node.classList.add("fresh");
    }
  }
  for (const figure of root.querySelectorAll(".text figure[data-figure]")) drawFigure(figure, figure.dataset.figure);
  for (const place of root.querySelectorAll(".text [data-table]")) {
    const known = results.tables[place.dataset.table];
    if (known) place.replaceChildren(table(known));
  }
}

/// The sliders of a run, as sliders.js takes them.
export const slidersOf = (results) => Object.entries(results?.sliders ?? {}).map(([name, slider]) => ({ name, ...slider }))
  .sort((a, b) => a.order - b.order);

/// Figures of a text get the names that its Markdown gives them, in the same order.
export function nameFigures(text, markdown) {
  const names = [...markdown.matchAll(/\(figure:([\w.-]+)\)/g)].map(([, name]) => name), figures = text.querySelectorAll("figure");
  if (names.length === figures.length) figures.forEach((figure, i) => { figure.dataset.figure = names[i]; });
}
