// The samples of a figure as tables, for those who do not see its curves and for other programs: one table for curves
// over the same abscissas. A page shows some two hundred rows; a copy holds all samples that the page has, and says
// where these are fewer than the figure was made from.
const dynlabTables = (() => {
  "use strict";
  const ROWS = 200;
  const { tr, trPlural, text } = dynlabWords;
  const WORDS = { data: tr("Data"), table: tr("Data of the figure: {}"), copy: tr("Copy as CSV"), copied: tr("Copied"), lower: tr("{}, lower"),
                  upper: tr("{}, upper"), all: trPlural("{} sample", "{} samples"), some: tr("{} of {} samples"),
                  thinned: tr("reduced to {} of {} samples"), thinnedMore: tr("reduced to {} of {} samples, {} of them shown") };
  const say = (key, ...values) => text(WORDS[key], ...values);
  const make = (name, kind = "", text = "") => Object.assign(document.createElement(name), { className: kind, textContent: text });

  async function copy(text) {
    try {
      await navigator.clipboard.writeText(text);
    } catch {  // not allowed from a file: the way of older browsers
      const field = make("textarea");
      field.value = text;
      document.body.append(field);
      field.select();
      document.execCommand("copy");
      field.remove();
    }
  }
  function copyButton(kind, word, content) {
    const button = make("button", kind, word);
    button.type = "button";
    button.onclick = async () => {
      await copy(content());
      button.textContent = say("copied");
      setTimeout(() => { button.textContent = word; }, 1500);
    };
    return button;
  }

  const heading = (axis, name = "") => {
    const words = [name, axis.name].filter(Boolean).join(": ");
    return words + (axis.measure ? ` (${axis.measure})` : "");
  };
  const equal = (a, b) => a === b || a.length === b.length && a.every((value, i) => value === b[i]);

  /// { x, samples, columns: [{ heading, values }] } for each set of abscissas, which stand for so many samples.
  function tables(panels) {
    const found = [];
    for (const panel of panels)
      for (const curve of panel.curves) {
        const linked = (table) => table.panel === panel || table.panel.goesWith(panel);
        const samples = curve.samples ?? curve.x.length;
        let table = found.find((one) => linked(one) && one.samples === samples && equal(one.x, curve.x));
        if (!table) {
          const axis = panels.find((other) => other.x.name && (other === panel || other.goesWith(panel)))?.x ?? panel.x;
          table = { panel, x: curve.x, samples, columns: [{ heading: heading(axis) || "x", values: curve.x }] };
          found.push(table);
        }
        const band = curve.style === "band";
        const name = heading(panel.y, curve.label) || "y";
        table.columns.push({ heading: band ? say("lower", name) : name, values: curve.y });
        if (band) table.columns.push({ heading: say("upper", name), values: curve.upper });
      }
    return found;
  }

  const csvText = (text) => /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  const plain = (value) => value === null || !Number.isFinite(value) ? "" : String(Number(value.toPrecision(7)));
  function csv({ x, samples, columns }) {
    const lines = samples > x.length ? [`# ${say("thinned", x.length, samples)}`] : [];
    lines.push(columns.map((column) => csvText(column.heading)).join(","));
    x.forEach((_, i) => lines.push(columns.map((column) => plain(column.values[i])).join(",")));
    return lines.join("\n") + "\n";
  }

  function element(table, comma) {
    const { x, samples, columns } = table, every = Math.max(1, Math.ceil((x.length - 1) / (ROWS - 1)));
    const box = make("div", "samples"), shown = make("table"), head = make("tr"), body = make("tbody");
    const kept = [...x.keys()].filter((i) => i % every === 0 || i === x.length - 1);
    for (const column of columns) head.append(Object.assign(make("th", "", column.heading), { scope: "col" }));
    for (const i of kept) {
      const row = make("tr");
      columns.forEach((column, k) => {
        const text = plain(column.values[i]).replace("-", "−"), cell = make(k ? "td" : "th", "", comma ? text.replace(".", ",") : text);
        if (k === 0) cell.scope = "row";
        row.append(cell);
      });
      body.append(row);
    }
    const complete = kept.length === x.length;
    const words = samples > x.length ? say(complete ? "thinned" : "thinnedMore", x.length, samples, kept.length)
      : complete ? say("all", x.length) : say("some", kept.length, x.length);
    const caption = make("caption", "", words), top = make("thead");
    top.append(head);
    shown.append(caption, top, body);
    const scroll = make("div", "rows");
    scroll.tabIndex = 0;
    scroll.setAttribute("role", "region");
    scroll.setAttribute("aria-label", say("table", columns.map((column) => column.heading).join(", ")));
    scroll.append(shown);
    box.append(copyButton("csv", say("copy"), () => csv(table)), scroll);
    return box;
  }

  /// The button that opens and closes the tables of a figure, of the panels as they are then; they stand behind `box`.
  /// `renew` of it is called when the panels are others.
  function button(box, panels, comma) {
    const button = make("button", "data", say("data"));
    let shown = null;
    const fill = () => shown.replaceChildren(...tables(panels()).map((table) => element(table, comma)));
    button.type = "button";
    button.setAttribute("aria-expanded", "false");
    button.onclick = () => {
      if (shown) shown.remove();
      shown = shown ? null : make("div", "plot-data-tables");
      button.setAttribute("aria-expanded", String(shown !== null));
      if (!shown) return;
      fill();
      box.after(shown);
    };
    button.renew = () => {
      if (!shown) return;
      const places = () => [...shown.querySelectorAll(".rows")], scrolled = places().map((rows) => rows.scrollTop);
      fill();
      places().forEach((rows, i) => { rows.scrollTop = scrolled[i] ?? 0; });
    };
    return button;
  }
  const allAsCsv = (panels) => tables(panels).map(csv).join("\n");
  return { button, copyButton, copy, allAsCsv };
})();
