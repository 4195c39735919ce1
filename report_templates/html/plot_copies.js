// What can be copied of a figure besides its samples: pictures of what it shows now, and Lua code that draws it.
const dynlabCopies = (() => {
  "use strict";
  const { Painter, palette } = dynlabDrawing;
  const kScale = 3;  // pixels of a copied picture for one of a page
  const escaped = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/"/g, "&quot;");
  const short = (value) => String(Number(value.toFixed(2)));

  /// The part of a canvas' context that Painter uses, as elements of SVG.
  class SvgContext {
    constructor() {
      Object.assign(this, { parts: [], path: "", stack: [], turn: "", clips: 0, clipped: "", globalAlpha: 1, lineJoin: "miter", dash: [],
                            strokeStyle: "#000", fillStyle: "#000", lineWidth: 1, font: "", ruler: document.createElement("canvas").getContext("2d") });
    }
    save() { this.stack.push({ turn: this.turn, clipped: this.clipped, globalAlpha: this.globalAlpha }); }
    restore() { Object.assign(this, this.stack.pop()); }
    translate(x, y) { this.turn += `translate(${short(x)} ${short(y)}) `; }
    rotate(angle) { this.turn += `rotate(${short(angle * 180 / Math.PI)}) `; }
    setLineDash(dash) { this.dash = dash; }
    beginPath() { this.path = ""; }
    moveTo(x, y) { this.path += `M${short(x)} ${short(y)}`; }
    lineTo(x, y) { this.path += `L${short(x)} ${short(y)}`; }
    closePath() { this.path += "Z"; }
    arc(x, y, r) { this.path += `M${short(x - r)} ${short(y)}a${short(r)} ${short(r)} 0 1 0 ${short(2 * r)} 0a${short(r)} ${short(r)} 0 1 0 ${short(-2 * r)} 0Z`; }
    rect(x, y, width, height) { this.path += `M${short(x)} ${short(y)}h${short(width)}v${short(height)}h${short(-width)}Z`; }
    clip() {
      this.parts.push(`<clipPath id="clip${++this.clips}"><path d="${this.path}"/></clipPath>`);
      this.clipped = ` clip-path="url(#clip${this.clips})"`;
    }
    put(element, looks) {
      const alpha = this.globalAlpha < 1 ? ` opacity="${short(this.globalAlpha)}"` : "";
      this.parts.push(`<${element} ${looks}${this.clipped}${alpha}${this.turn ? ` transform="${this.turn.trim()}"` : ""}`);
    }
    get line() {
      const dash = this.dash.length > 0 ? ` stroke-dasharray="${this.dash.map(short).join(" ")}"` : "";
      return `fill="none" stroke="${this.strokeStyle}" stroke-width="${short(this.lineWidth)}" stroke-linejoin="${this.lineJoin}"${dash}`;
    }
    add(element, looks) { this.put(element, looks); this.parts.push("/>"); }
    stroke() { this.add("path", `d="${this.path}" ${this.line}`); }
    fill() { this.add("path", `d="${this.path}" fill="${this.fillStyle}"`); }
    strokeRect(x, y, width, height) { this.path = ""; this.rect(x, y, width, height); this.stroke(); }
    fillRect(x, y, width, height) { this.path = ""; this.rect(x, y, width, height); this.fill(); }
    measureText(text) { this.ruler.font = this.font; return this.ruler.measureText(text); }
    fillText(text, x, y) {
      const [, size, family] = /^([\d.]+)px (.*)$/.exec(this.font);
      this.put("text", `x="${short(x)}" y="${short(y)}" font-size="${short(Number(size))}" font-family="${escaped(family)}" fill="${this.fillStyle}"`);
      this.parts.push(`>${escaped(text)}</text>`);
    }
  }

  /// What the figure shows now, on white paper.
  function paint(plot, context, unit) {
    const painter = new Painter(context, plot, unit);
    painter.colors = palette(false);
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, plot.size[0] * unit, plot.size[1] * unit);
    painter.draw();
  }
  function svg(plot) {
    const unit = 96 / 2.54, context = new SvgContext(), [width, height] = plot.size.map((length) => short(length * unit));
    paint(plot, context, unit);
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}">\n${context.parts.join("").replace(/></g, ">\n<")}\n</svg>\n`;
  }
  function png(plot) {
    const unit = kScale * 96 / 2.54, canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = plot.size.map((length) => Math.round(length * unit));
    paint(plot, canvas.getContext("2d"), unit);
    return new Promise((yes) => { canvas.toBlob(yes, "image/png"); });
  }

  // ----- Lua
  const number = (value) => (value === null || !Number.isFinite(value) ? "0/0" : String(Number(value.toPrecision(7))));
  const quoted = (text) => `"${text.replace(/\\/g, "\\\\").replace(/"/g, '\\"').replace(/\n/g, " ")}"`;
  const marked = (pieces) => (typeof pieces === "string" ? pieces
    : pieces.map(([level, ...text]) => (level === "=" ? text.join("") : `${level}{${text.join("")}}`)).join(""));
  /// Evenly spaced abscissas are a range, others a list.
  function list(values) {
    const last = values.length - 1, step = last > 0 ? (values[last] - values[0]) / last : 0;
    const even = last > 1 && values.every((value, i) => value !== null && Math.abs(value - values[0] - i * step) < 1e-6 * Math.abs(step));
    return even ? `linspace(${number(values[0])}, ${number(values[last])}, ${values.length})` : `vector{${values.map(number).join(", ")}}`;
  }
  function curvesOf(panel) {
    return panel.curves.filter(({ shown, x }) => shown && x.length > 0).flatMap((curve) => {
      const { style, label, x, y, upper } = curve, name = curve.name === "" ? "" : marked(curve.name);
      if (style !== "band") return [{ x, y, style, name }];
      return [{ x, y, style: "line", name: name || label }, { x, y: upper, style: "line", name: "" }];
    });
  }
  function panelCode(panel, name) {
    const options = [["xlabel", marked(panel.x.label)], ["ylabel", marked(panel.y.label)]].filter(([, text]) => text !== "").map(([key, text]) => `${key} = ${quoted(text)}`);
    for (const axis of ["x", "y"]) {
      if (panel[axis].log) options.push(`${axis}_log = true`);
      if (panel[axis].moved) options.push(`${axis}_range = {${number(panel[axis].low)}, ${number(panel[axis].high)}}`);
    }
    const [first, ...others] = curvesOf(panel);
    if (!first) return "";
    const looks = ({ style, name: label }) => [...(label ? [`label = ${quoted(label)}`] : []), ...(style === "line" ? [] : [`style = ${quoted(style)}`])];
    const lines = [`local ${name} = plot(${list(first.x)}, ${list(first.y)}, {${[...looks(first), ...options].join(", ")}})`];
    for (const curve of others) lines.push(`${name}:add(${list(curve.x)}, ${list(curve.y)}, {${looks(curve).join(", ")}})`);
    return lines.join("\n") + "\n";
  }
  function lua(plot) {
    const panels = plot.readable.map((panel, i) => ({ name: `panel${i + 1}`, code: panelCode(panel, `panel${i + 1}`), left: panel.left })).filter(({ code }) => code);
    const columns = new Set(panels.map(({ left }) => left)).size, rows = Math.ceil(panels.length / columns);
    const whole = panels.length > 1 ? `subplot(${rows}, ${columns}, {${panels.map(({ name }) => name).join(", ")}})\n` : "";
    return panels.map(({ code }) => code).join("") + whole;
  }
  return { svg, png, lua };
})();
