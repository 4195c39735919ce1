// Figures as documents/html/plot_data.h tells them, and how they are drawn on a canvas. Lengths are cm on the printed
// page, from its lower left corner; `unit` is what one of them is in pixels.
const dynlabDrawing = (() => {
  "use strict";
  const FONT = '"Latin Modern Roman", "LM Roman 10", "Latin Modern Math", "CMU Serif", "STIX Two Text", serif';
  const TICK = 0.1, SAMPLE = 0.8, GAP = 0.12, NUMBER_SIZE = 8, TEXT_SIZE = 9, TICK_LINE = 0.36;
  const SMALLEST_TYPE = 8;  // pixels, on narrow screens
  const plainText = (pieces) => typeof pieces === "string" ? pieces : pieces.map((piece) => piece.slice(1)).join("");
  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

  /// One axis: what it shows now, and where a value lies on its length (0 to 1).
  class Axis {
    constructor(data) {
      Object.assign(this, data);
      this.whole = [this.low, this.high];
      const label = plainText(data.label);
      const unit = label.match(/^(.*?)\s*\(([^()]*)\)$/);
      [this.name, this.measure] = unit ? [unit[1], unit[2]] : [label, ""];
    }
    flat(value) { return this.log ? (value > 0 ? Math.log(value) : NaN) : value; }
    round(flat) { return this.log ? Math.exp(flat) : flat; }
    position(value) { return (this.flat(value) - this.flat(this.low)) / (this.flat(this.high) - this.flat(this.low)); }
    value(position) {
      const low = this.flat(this.low);
      return this.round(low + position * (this.flat(this.high) - low));
    }
    get moved() { return this.low !== this.whole[0] || this.high !== this.whole[1]; }
    show(low, high) {
      const [first, last] = this.whole.map((value) => this.flat(value));
      const share = (this.flat(high) - this.flat(low)) / (last - first);
      const fine = Math.abs(this.flat(low)) + Math.abs(this.flat(high));
      if (!(share > 1e-7 && share < 100) || !(this.flat(high) - this.flat(low) > 1e-12 * fine)) return;
      [this.low, this.high] = [low, high];
    }
    reset() { [this.low, this.high] = this.whole; }
    /// The part from position a to position b becomes the whole.
    zoom(a, b) { this.show(this.value(Math.min(a, b)), this.value(Math.max(a, b))); }
    decimals(step) { return clamp(Math.ceil(-Math.log10(step) - 1e-9), 0, 12); }
    /// Numbered ticks, short ones and the power of ten taken out: those of the printed figure as long as it is whole.
    marks(count) {
      if (!this.moved) return { ticks: this.ticks, minor: this.minor, exponent: this.exponent };
      const decades = this.log ? Math.log10(this.high / this.low) : 0;
      return decades > 0.7 ? this.decadeMarks(decades, count) : this.evenMarks(count);
    }
    evenMarks(count) {
      const span = this.high - this.low, rough = span / count, decade = 10 ** Math.floor(Math.log10(rough));
      const step = decade * [1, 2, 5, 10].find((factor) => factor * decade >= rough * 0.999);
      const magnitude = Math.floor(Math.log10(Math.max(Math.abs(this.low), Math.abs(this.high))));
      const exponent = magnitude >= 5 || magnitude < 0 && Math.log10(step) < -3.5 ? magnitude : 0;
      const ticks = [];
      for (let k = Math.ceil(this.low / step - 1e-9); k * step <= this.high + 1e-9 * span && ticks.length < 50; ++k)
        ticks.push([k * step, (k * step / 10 ** exponent).toFixed(this.decimals(step / 10 ** exponent))]);
      return { ticks, minor: [], exponent };
    }
    decadeMarks(decades, count) {
      const ticks = [], minor = [], every = Math.ceil(decades / count), numbered = decades < 1.5 ? [1, 2, 5] : [1];
      const plain = this.low > 1e-3 && this.high < 1e4 && decades < 2.1;
      for (let k = Math.floor(Math.log10(this.low)); k <= Math.log10(this.high); ++k)
        for (let digit = 1; digit < 10; ++digit) {
          const value = digit * 10 ** k;
          if (value < this.low || value > this.high) continue;
          if (!numbered.includes(digit) || k % every !== 0) minor.push(value);
          else ticks.push([value, plain ? value.toFixed(Math.max(0, -k)) : digit === 1 ? ["=10", "^" + k] : [`=${digit}·10`, "^" + k]]);
        }
      return { ticks, minor, exponent: 0 };
    }
    /// A value with as many digits as one sees, a whole one without any where `whole` is true.
    text(value, comma, whole = false) {
      const span = this.log ? Math.abs(value) : this.high - this.low;
      const large = Math.abs(value) >= 1e6 || span < 1e-6;
      let text = large ? value.toExponential(3) : value.toFixed(this.decimals(span / 2000));
      if (whole && !large && Number.isInteger(value)) text = String(value);
      text = text.replace(/-/g, "−");
      return (comma ? text.replace(".", ",") : text) + (this.measure ? " " + this.measure : "");
    }
  }

  class Curve {
    constructor(data, all) {
      Object.assign(this, data);
      if (typeof this.x === "number") this.x = all[this.x].x;
      else if (!Array.isArray(this.x)) {
        const { from, step, count } = this.x;
        this.x = Array.from({ length: count }, (_, i) => from + i * step);
      }
      this.shown = true;
      this.label = plainText(this.name);
      this.isFunction = this.style !== "points" && this.x.every((x, i) => i === 0 || !(x < this.x[i - 1]));
    }
    /// The sample nearest to x, or, for curves that hold their value, the one before.
    nearest(x, holds = this.style === "stairs") {
      let low = 0, high = this.x.length - 1;
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (this.x[middle] <= x) low = middle;
        else high = middle;
      }
      if (this.x[high] <= x) return high;
      return holds || x - this.x[low] < this.x[high] - x ? low : high;
    }
    /// Years, numbers of samples.
    get countsWhole() { return this.whole ??= this.x.every((x) => x === null || Number.isInteger(x)); }
    covers(x) { return this.x.length > 0 && x >= this.x[0] && x <= this.x[this.x.length - 1]; }
    at(x, values = this.y) {
      const i = this.nearest(x), k = this.x[i] < x ? i + 1 : i - 1;
      const between = ["line", "line_points", "band"].includes(this.style) && this.x[i] !== x && k >= 0 && k < this.x.length;
      if (!between || values[i] === null || values[k] === null || this.x[k] === this.x[i]) return values[i];
      return values[i] + (values[k] - values[i]) * (x - this.x[i]) / (this.x[k] - this.x[i]);
    }
  }

  class Panel {
    constructor(data) {
      Object.assign(this, data);
      [this.left, this.bottom, this.right, this.top] = this.box;
      this.x = new Axis(data.x);
      this.y = new Axis(data.y);
      this.curves = [];
      for (const curve of data.curves) this.curves.push(new Curve(curve, this.curves));
    }
    get width() { return this.right - this.left; }
    get height() { return this.top - this.bottom; }
    place(x, y) { return [this.left + this.x.position(x) * this.width, this.bottom + this.y.position(y) * this.height]; }
    holds(x, y) { return x >= this.left && x <= this.right && y >= this.bottom && y <= this.top; }
    /// Same column, same abscissas: read and zoomed together.
    goesWith(other) {
      return this.left === other.left && this.x.log === other.x.log && this.x.whole[0] === other.x.whole[0] &&
        this.x.whole[1] === other.x.whole[1] && !this.equal && !other.equal;
    }
  }

  /// Colors of the printed figure, and what stands for them on dark paper.
  function palette(dark = isDark()) {
    if (!dark) return { text: "#202020", frame: "#404040", grid: "#dddddd", minor: "#eeeeee", line: "#606060",
                        paper: "#ffffff", of: (color) => color };
    const lighter = (color) => {
      const parts = [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16));
      const high = Math.max(...parts), low = Math.min(...parts);
      if (high - low < 12) return `rgb(${parts.map((part) => 255 - part).join(",")})`;
      const share = clamp((165 - (high + low) / 2) / (255 - (high + low) / 2), 0, 1);
      return `rgb(${parts.map((part) => Math.round(part + share * (255 - part))).join(",")})`;
    };
    return { text: "#dde3e9", frame: "#9aa6b2", grid: "#2e3841", minor: "#232b33", line: "#9aa6b2", paper: "#12171d",
             of: lighter };
  }

  function isDark() {
    const parts = getComputedStyle(document.body).backgroundColor.match(/[\d.]+/g) || [255, 255, 255];
    return (parts.length < 4 || Number(parts[3]) > 0) && Number(parts[0]) + Number(parts[1]) + Number(parts[2]) < 300;
  }

  /// Draws a figure on a canvas whose pixels are CSS pixels.
  class Painter {
    constructor(context, figure, unit) {
      Object.assign(this, { context, figure, unit, colors: palette() });
    }
    X(x) { return clamp(x * this.unit, -1e5, 1e5); }
    Y(y) { return clamp((this.figure.size[1] - y) * this.unit, -1e5, 1e5); }
    width(points) { return points / 72 * 2.54 * this.unit; }
    type(points) { return Math.max(this.width(points), SMALLEST_TYPE); }

    stroke(color, points, dash = []) {
      const context = this.context;
      context.strokeStyle = color;
      context.lineWidth = this.width(points);
      context.setLineDash(dash.map((length) => length * context.lineWidth));
    }
    segment(x0, y0, x1, y1) {
      this.context.beginPath();
      this.context.moveTo(this.X(x0), this.Y(y0));
      this.context.lineTo(this.X(x1), this.Y(y1));
      this.context.stroke();
    }
    measure(pieces, points) {
      const size = this.type(points);
      return (typeof pieces === "string" ? ["=" + pieces] : pieces).reduce((sum, piece) => {
        this.context.font = `${piece[0] === "=" ? size : 0.8 * size}px ${FONT}`;
        return sum + this.context.measureText(piece.slice(1)).width;
      }, 0);
    }
    text(pieces, x, y, points, align, color, upright = false) {
      const context = this.context, size = this.type(points), width = this.measure(pieces, points);
      context.save();
      context.translate(this.X(x), this.Y(y));
      if (upright) context.rotate(-Math.PI / 2);
      context.fillStyle = color;
      context.textAlign = "left";
      context.textBaseline = "alphabetic";
      let at = align === "center" ? -width / 2 : align === "right" ? -width : 0;
      for (const piece of typeof pieces === "string" ? ["=" + pieces] : pieces) {
        const level = piece[0];
        context.font = `${level === "=" ? size : 0.8 * size}px ${FONT}`;
        context.fillText(piece.slice(1), at, (level === "_" ? 0.52 : level === "^" ? -0.05 : 0.32) * size);
        at += context.measureText(piece.slice(1)).width;
      }
      context.restore();
    }

    /// gnuplot's point types, of which the even ones are open: plus, cross, star, square, circle, two triangles, diamond.
    marker(x, y, type, size, points, color) {
      const context = this.context, r = 7.8 * size / 96 * this.unit, X = this.X(x), Y = this.Y(y);
      const shape = (corners) => {
        context.beginPath();
        corners.forEach(([dx, dy], i) => context[i ? "lineTo" : "moveTo"](X + r * dx, Y + r * dy));
        context.closePath();
      };
      this.stroke(color, points);
      context.fillStyle = color;
      if (type <= 3) {
        context.beginPath();
        const arms = type === 1 ? [[1, 0], [0, 1]] : type === 2 ? [[1, 1], [1, -1]] : [[1, 0], [0, 1], [1, 1], [1, -1]];
        for (const [dx, dy] of arms) {
          context.moveTo(X - r * dx, Y - r * dy);
          context.lineTo(X + r * dx, Y + r * dy);
        }
        return context.stroke();
      }
      if (type <= 5) shape([[-1, -1], [1, -1], [1, 1], [-1, 1]]);
      else if (type <= 7) { context.beginPath(); context.arc(X, Y, r, 0, 2 * Math.PI); }
      else if (type <= 9) shape([[0, -1.33], [-1.33, 0.67], [1.33, 0.67]]);
      else if (type <= 11) shape([[0, 1.33], [-1.33, -0.67], [1.33, -0.67]]);
      else shape([[0, -1.41], [1.41, 0], [0, 1.41], [-1.41, 0]]);
      if (type % 2) context.fill();
      context.stroke();
    }

    draw() {
      for (const panel of this.figure.panels) this.panel(panel);
      for (const { text, x, y, size, upright } of this.figure.texts)
        this.text(text, x, y, size, "center", this.colors.text, upright);
    }
    panel(panel) {
      const context = this.context;
      this.axes(panel);
      context.save();
      context.beginPath();
      context.rect(this.X(panel.left), this.Y(panel.top), panel.width * this.unit, panel.height * this.unit);
      context.clip();
      this.references(panel);
      for (const bands of [true, false])
        for (const curve of panel.curves)
          if (curve.shown && (curve.style === "band") === bands) this.curve(panel, curve);
      this.notes(panel);
      context.restore();
      this.stroke(this.colors.frame, 0.45);
      context.strokeRect(this.X(panel.left), this.Y(panel.top), panel.width * this.unit, panel.height * this.unit);
      for (const entry of panel.legend) this.entry(panel, entry);
    }

    axes(panel) {
      this.axis(panel.x.marks(Math.max(2, panel.width / 1.4)), panel, true);
      this.axis(panel.y.marks(Math.max(2, panel.height / 0.75)), panel, false);
    }
    axis({ ticks, minor, exponent }, panel, lying) {
      const axis = lying ? panel.x : panel.y, { colors } = this;
      const place = (value) => lying ? panel.left + axis.position(value) * panel.width
        : panel.bottom + axis.position(value) * panel.height;
      const line = (value, color, points, long) => {
        this.stroke(color, 0.3 * points);
        if (lying) this.segment(place(value), panel.bottom, place(value), panel.top);
        else this.segment(panel.left, place(value), panel.right, place(value));
        this.stroke(colors.frame, 0.45);
        if (lying) this.segment(place(value), panel.bottom, place(value), panel.bottom - long);
        else this.segment(panel.left, place(value), panel.left - long, place(value));
      };
      for (const value of minor) line(value, colors.minor, 0.75, 0.55 * TICK);
      let end = -Infinity;
      for (const [value, label] of ticks) {
        line(value, colors.grid, 1, TICK);
        if (!axis.numbers) continue;
        const text = typeof label !== "string" || !axis.moved ? label : this.number(label);
        const middle = place(value) * this.unit;
        const half = lying ? this.measure(text, NUMBER_SIZE) / 2 : this.type(NUMBER_SIZE) / 2;
        if (middle - half < end) continue;
        end = middle + half + (lying ? 4 : 0);
        if (lying) this.text(text, place(value), panel.bottom - TICK - 0.5 * TICK_LINE, NUMBER_SIZE, "center", colors.frame);
        else this.text(text, panel.left - TICK - 0.08, place(value), NUMBER_SIZE, "right", colors.frame);
      }
      if (exponent === 0 || !axis.numbers) return;
      const power = ["=×10", "^" + String(exponent).replace("-", "−")];
      if (lying) this.text(power, panel.right, axis.power, NUMBER_SIZE, "right", colors.frame);
      else this.text(power, panel.left, axis.power, NUMBER_SIZE, "left", colors.frame);
    }
    number(label) {
      const text = label.replace("-", "−");
      return this.figure.comma ? text.replace(".", ",") : text;
    }

    references(panel) {
      for (const { horizontal, at, dash } of panel.lines) {
        this.stroke(this.colors.line, 0.55, dash);
        const [x, y] = panel.place(horizontal ? panel.x.low : at, horizontal ? at : panel.y.low);
        if (horizontal) this.segment(panel.left, y, panel.right, y);
        else this.segment(x, panel.bottom, x, panel.top);
      }
    }

    curve(panel, curve) {
      const context = this.context, color = this.colors.of(curve.color);
      if (curve.style === "band") return this.band(panel, curve, color);
      if (curve.style === "bars") return this.bars(panel, curve, color);
      const places = curve.x.map((x, i) => curve.y[i] === null || x === null ? null : panel.place(x, curve.y[i]));
      const valid = (place) => place !== null && Number.isFinite(place[0]) && Number.isFinite(place[1]);
      const base = panel.y.log ? panel.bottom : panel.bottom + clamp(panel.y.position(0), 0, 1) * panel.height;
      if (curve.style !== "points") {
        this.stroke(color, curve.style === "stems" ? 0.8 * curve.width : curve.width, curve.dash);
        context.lineJoin = "round";
        context.beginPath();
        let pen = null;
        for (const place of places) {
          const next = valid(place) ? place : null;
          if (next && curve.style === "stems") {
            context.moveTo(this.X(next[0]), this.Y(base));
            context.lineTo(this.X(next[0]), this.Y(next[1]));
          } else if (next) {
            if (pen && curve.style === "stairs") context.lineTo(this.X(next[0]), this.Y(pen[1]));
            context[pen ? "lineTo" : "moveTo"](this.X(next[0]), this.Y(next[1]));
          }
          pen = next;
        }
        context.stroke();
      }
      const marked = ["points", "line_points", "stems"].includes(curve.style);
      places.forEach((place, i) => {
        if (!valid(place) || !panel.holds(place[0], place[1])) return;
        if (marked) this.marker(place[0], place[1], curve.point, curve.size, curve.edge, color);
        else if (!(i > 0 && valid(places[i - 1])) && !(i + 1 < places.length && valid(places[i + 1])))
          this.marker(place[0], place[1], 7, 0.25, curve.edge, color);
      });
    }
    band(panel, curve, color) {
      const context = this.context;
      context.fillStyle = color;
      context.globalAlpha = 0.22;
      for (let first = 0, end; first < curve.x.length; first = end) {
        end = first;
        while (end < curve.x.length && curve.y[end] !== null && curve.upper[end] !== null) ++end;
        if (end === first) { ++end; continue; }
        const corners = [];
        for (let i = first; i < end; ++i) corners.push(panel.place(curve.x[i], curve.y[i]));
        for (let i = end - 1; i >= first; --i) corners.push(panel.place(curve.x[i], curve.upper[i]));
        context.beginPath();
        corners.filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y))
          .forEach(([x, y], i) => context[i ? "lineTo" : "moveTo"](this.X(x), this.Y(y)));
        context.fill();
        if (panel.curves.filter((other) => other.style === "band").length < 2) continue;
        context.globalAlpha = 1;
        const half = corners.length / 2;
        this.stroke(color, 0.4, curve.dash);
        for (const edge of [corners.slice(0, half), corners.slice(half)]) {
          context.beginPath();
          edge.filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y))
            .forEach(([x, y], i) => context[i ? "lineTo" : "moveTo"](this.X(x), this.Y(y)));
          context.stroke();
        }
        context.globalAlpha = 0.22;
        context.fillStyle = color;
      }
      context.globalAlpha = 1;
    }
    bars(panel, curve, color) {
      const context = this.context, last = curve.x.length - 1;
      const distance = (i) => last < 1 ? 1 : Math.abs(curve.x[clamp(i + 1, 1, last)] - curve.x[clamp(i, 0, last - 1)]);
      const base = panel.y.log ? panel.bottom : panel.bottom + clamp(panel.y.position(0), 0, 1) * panel.height;
      this.stroke(this.colors.paper, 0.3);
      curve.x.forEach((center, i) => {
        if (curve.y[i] === null) return;
        const [left, y] = panel.place(center - distance(i - 1) / 2, curve.y[i]);
        const right = panel.place(center + distance(i) / 2, curve.y[i])[0];
        const box = [this.X(left), this.Y(Math.max(y, base)), (right - left) * this.unit, Math.abs(y - base) * this.unit];
        context.fillStyle = color;
        context.globalAlpha = 0.6;
        context.fillRect(...box);
        context.globalAlpha = 1;
        context.strokeRect(...box);
      });
    }

    notes(panel) {
      const { context, colors } = this;
      for (const { from, to, both } of panel.arrows) {
        const [x0, y0] = panel.place(...from), [x1, y1] = panel.place(...to);
        this.stroke(colors.text, 0.5);
        this.segment(x0, y0, x1, y1);
        const head = Math.min(0.2, 0.4 * Math.hypot(x1 - x0, y1 - y0));
        for (const [x, y, turn] of both ? [[x1, y1, 0], [x0, y0, Math.PI]] : [[x1, y1, 0]]) {
          const angle = Math.atan2(y1 - y0, x1 - x0) + turn;
          context.beginPath();
          context.moveTo(this.X(x), this.Y(y));
          for (const side of [-0.31, 0.31])
            context.lineTo(this.X(x - head * Math.cos(angle + side)), this.Y(y - head * Math.sin(angle + side)));
          context.fillStyle = colors.text;
          context.fill();
        }
      }
      for (const [x, y] of panel.marks) this.marker(...panel.place(x, y), 7, 0.45, 0.5, colors.text);
      for (const { text, at, leader } of panel.labels) {
        this.stroke(colors.line, 0.3);
        if (leader) this.segment(...panel.place(...leader[0]), ...panel.place(...leader[1]));
        this.text(text, ...panel.place(...at), TEXT_SIZE, "center", colors.text);
      }
    }

    entry(panel, { curve: index, x, y, size, text }) {
      const { context } = this, curve = panel.curves[index], color = this.colors.of(curve.color);
      context.globalAlpha = curve.shown ? 1 : 0.3;
      if (curve.style === "band" || curve.style === "bars") {
        context.fillStyle = color;
        context.globalAlpha *= curve.style === "band" ? 0.22 : 0.6;
        context.fillRect(this.X(x), this.Y(y + 0.11), SAMPLE * this.unit, 0.22 * this.unit);
        context.globalAlpha = curve.shown ? 1 : 0.3;
      } else if (curve.style !== "points") {
        this.stroke(color, curve.width, curve.dash);
        this.segment(x, y, x + SAMPLE, y);
      }
      if (["points", "line_points", "stems"].includes(curve.style))
        this.marker(x + SAMPLE / 2, y, curve.point, curve.size, curve.edge, color);
      this.text(text, x + SAMPLE + GAP, y, size, "left", this.colors.text);
      context.globalAlpha = 1;
    }
  }
  return { Panel, Painter, palette, clamp };
})();
