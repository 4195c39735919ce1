// Figures that can be zoomed and read off. A picture is followed by an element "plot-data" with what
// documents/html/plot_data.h says; on a screen a canvas takes the picture's place. On paper the picture stays.
const dynlabPlots = (() => {
  "use strict";
  const { Panel, Painter, clamp } = dynlabDrawing;
  const { tr, text } = dynlabWords;
  const WORDS = { whole: tr("Whole figure"), kind: tr("interactive figure"), curve: tr("Show or hide: {}"), handle: tr("handle; move it with the arrow keys"),
                  copy: tr("Copy"), copied: tr("Copied"), stored: tr("Saved"),
                  help: tr("Arrow keys: read values; + and −: zoom; Shift and arrow keys: pan; 0: whole figure; Esc: exit") };
  const say = (key, ...values) => text(WORDS[key], ...values);

  const plots = new Set();  // those in the page
  const drawAll = () => { for (const plot of plots) plot.draw(); };
  for (const query of ["(prefers-color-scheme: dark)", "(resolution: 1dppx)"])
    matchMedia(query).addEventListener("change", drawAll);
  document.addEventListener("themechange", drawAll);
  document.fonts?.ready.then(drawAll);

  /// The number of a slider that puts a mark to a place.
  function numberAt({ values, places }, place) {
    const last = places.length - 1, rising = places[last] > places[0];
    const reached = (i) => rising ? places[i] <= place : places[i] >= place;
    if (!reached(0)) return values[0];
    let i = 0;
    while (i < last && reached(i + 1)) ++i;
    if (i === last) return values[last];
    return values[i] + (values[i + 1] - values[i]) * (place - places[i]) / (places[i + 1] - places[i]);
  }

  /// A mark that moves sliders: whoever has these hears "slidermove" with their numbers, or "sliderstep" with the name of
  /// one and the way it goes. The figure may be exchanged meanwhile: the mark of the same name goes on with the hand.
  class Handle {
    static held = null;  // { name, key, plot, pointer, aside, upwards }: cm from the mark
    static stepped = { key: "", at: -Infinity };

    constructor(plot, button) {
      Object.assign(this, { plot, button });
      button.addEventListener("pointerdown", (event) => this.down(event));
      button.addEventListener("keydown", (event) => this.step(event));
      button.setAttribute("aria-roledescription", say("handle"));
    }
    take(panel, mark, earlier) {
      Object.assign(this, { panel, mark });
      const names = mark.scales.map((scale) => `${scale.slider} = ${Number(scale.value.toPrecision(4))}`);
      const name = typeof mark.name === "string" ? mark.name : mark.name.map((piece) => piece.slice(1)).join("");
      this.name = mark.scales.map((scale) => scale.slider).join(" ") + " " + name;
      this.number = earlier.filter((handle) => handle.name === this.name).length;
      this.button.setAttribute("aria-label", [name, ...names].filter(Boolean).join(", "));
      this.button.classList.toggle("held", Handle.held?.key === this.key);
    }
    get place() { return this.panel.place(this.mark.x, this.mark.y); }
    /// Names the mark in the page, whatever run its figure is of: which figure, which of its marks of one name.
    get key() {
      const figures = [...document.querySelectorAll("script.plot-data")];
      return `${figures.indexOf(this.plot.picture.nextElementSibling)} ${this.number} ${this.name}`;
    }
    draw() {
      const [x, y] = this.place, [width, height] = this.plot.size;
      this.button.hidden = !this.panel.holds(x, y);
      Object.assign(this.button.style, { left: `${100 * x / width}%`, top: `${100 * (height - y) / height}%` });
      if (performance.now() - Handle.stepped.at > 3000 || Handle.stepped.key !== this.key) return;
      if (document.activeElement === document.body) this.button.focus({ preventScroll: true });
    }
    down(event) {
      if (event.button !== 0) return;
      event.preventDefault();
      event.stopPropagation();
      this.button.focus({ preventScroll: true });
      const [x, y] = this.plot.place(event), at = this.place;
      const { name, key, plot } = this;
      Handle.held = { name, key, plot, pointer: event.pointerId, aside: x - at[0], upwards: y - at[1] };
      this.button.classList.add("held");
      document.documentElement.setPointerCapture(event.pointerId);  // the button may be exchanged
    }
    /// The mark that is held, in the figure as it is now.
    static now() {
      const { name, key, plot } = Handle.held, boxes = [plot.box, ...document.querySelectorAll("div.plot")];
      const marks = boxes.filter((box) => box.isConnected).flatMap((box) => box.plot.handles);
      const same = marks.filter((handle) => handle.name === name);
      return same.find((handle) => handle.key === key) ?? same[0];  // figures may have come before it
    }
    static move(event) {
      if (Handle.held?.pointer !== event.pointerId) return;
      const handle = Handle.now();
      if (!handle) return;
      const [x, y] = handle.plot.place(event), { panel } = handle, numbers = {};
      const [across, up] = handle.plot.within(panel, [x - Handle.held.aside, y - Handle.held.upwards]);
      for (const scale of handle.mark.scales)
        numbers[scale.slider] = numberAt(scale, scale.horizontal ? panel.x.value(across) : panel.y.value(up));
      document.dispatchEvent(new CustomEvent("slidermove", { detail: numbers }));
    }
    static end(event) {
      if (Handle.held?.pointer !== event.pointerId) return;
      Handle.held = null;
      for (const button of document.querySelectorAll(".handle.held")) button.classList.remove("held");
    }
    step(event) {
      const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      const lying = event.key === "ArrowLeft" || event.key === "ArrowRight";
      const scale = this.mark.scales.find((one) => one.horizontal === lying);
      if (!way || !scale || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      event.stopPropagation();
      Handle.stepped = { key: this.key, at: performance.now() };
      const by = scale.places[scale.places.length - 1] > scale.places[0] ? way : -way;
      document.dispatchEvent(new CustomEvent("sliderstep", { detail: { name: scale.slider, by } }));
    }
  }
  document.addEventListener("pointermove", Handle.move);
  for (const name of ["pointerup", "pointercancel"]) document.addEventListener(name, Handle.end);

  /// A figure in the page: its canvas, what is read off, and what hands do.
  class Plot {
    constructor(picture, figure) {
      Object.assign(this, { picture, made: figure, entries: [], handles: [] });
      this.take(figure);
      this.pointers = new Map();
      this.cursor = null;  // { panel, x, y }: cm
      this.build();
      this.listen();
      if (figure.motion) this.motion = new dynlabMotion.Motion(this, figure.motion);
      new ResizeObserver(() => {  // told when it leaves the page, and when it comes back
        if (!this.box.isConnected) return plots.delete(this);
        plots.add(this);
        this.draw();
      }).observe(this.box);
    }

    take(figure) {
      Object.assign(this, { size: figure.size, comma: figure.comma, texts: figure.texts });
      this.panels = figure.panels.map((panel) => new Panel(panel));
      if (figure.motion) this.panels[figure.motion.picture].picture = true;
    }
    /// The same figure of another run: what was zoomed or hidden stays so. `whole`: by panel, what its abscissa is as a
    /// whole, where the figure is a part of it.
    renew(figure, whole = null) {
      const before = this.panels;
      this.take(figure);
      this.panels.forEach((panel, i) => {
        const was = before[i];
        if (!was) return;
        for (const axis of ["x", "y"])
          if (was[axis].moved) [panel[axis].low, panel[axis].high] = [was[axis].low, was[axis].high];
        if (whole?.[i]) panel.x.whole = whole[i];
        panel.curves.forEach((curve, k) => { curve.shown = was.curves[k]?.shown ?? true; });
      });
      this.cursor = null;
      this.shape();
      this.furnish();
      this.data.renew();
      if (this.motion) {
        this.motion.pause();
        this.motion.box.remove();
        this.motion = figure.motion && new dynlabMotion.Motion(this, figure.motion);
      }
      this.draw();
    }

    build() {
      const element = (name, kind) => Object.assign(document.createElement(name), { className: kind });
      this.box = element("div", "plot");
      this.box.plot = this;
      this.box.tabIndex = 0;
      this.shape();
      this.box.setAttribute("role", "application");
      this.box.setAttribute("aria-roledescription", say("kind"));
      this.box.setAttribute("aria-label", [this.picture.alt, say("help")].filter(Boolean).join(". "));
      this.picture.before(this.box);
      this.canvas = element("canvas", "");
      this.over = element("canvas", "over");
      this.reading = element("output", "reading");
      this.whole = element("button", "whole");
      this.whole.textContent = say("whole");
      this.whole.hidden = this.reading.hidden = true;
      this.whole.onclick = () => { this.reset(); this.box.focus({ preventScroll: true }); };
      this.data = dynlabTables.button(this.box, () => this.readable, this.comma);
      const tools = element("div", "plot-tools");
      tools.append(this.data, this.copies());
      this.box.append(this.canvas, this.over, this.reading, this.whole, tools);
      this.furnish();
    }
    /// What can be copied of the figure as it is shown now.
    copies() {
      const box = Object.assign(document.createElement("details"), { className: "copies" }), head = document.createElement("summary");
      head.textContent = say("copy");
      const button = (word, act) => {
        const made = Object.assign(document.createElement("button"), { type: "button", textContent: word });
        made.onclick = async () => {
          made.textContent = say(await act());
          setTimeout(() => { made.textContent = word; box.open = false; }, 1200);
        };
        return made;
      };
      const text = (content) => async () => { await dynlabTables.copy(content()); return "copied"; };
      box.append(head, button("SVG", text(() => dynlabCopies.svg(this))), button("PNG", () => this.copyPicture()),
                 button("CSV", text(() => dynlabTables.allAsCsv(this.readable))), button("Lua", text(() => dynlabCopies.lua(this))));
      box.addEventListener("keydown", (event) => {
        if (event.key !== "Escape" || !box.open) return;
        box.open = false;
        head.focus();
        event.stopPropagation();
      });
      return box;
    }
    /// Where no picture may be put on the clipboard, it is saved as a file.
    async copyPicture() {
      const picture = dynlabCopies.png(this);
      try {
        await navigator.clipboard.write([new ClipboardItem({ "image/png": picture })]);
        return "copied";
      } catch {
        const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(await picture), download: "figure.png" });
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 1000);
        return "stored";
      }
    }
    /// The room that the figure takes, as the picture's own.
    shape() {
      const [width, height] = this.size.map((length) => Math.round(length / 2.54 * 96));
      this.box.style.aspectRatio = `${width} / ${height}`;
      this.box.style.width = this.picture.style.width || `${width}px`;
    }
    /// Buttons over the canvas: the legend's entries, and marks that sliders move.
    furnish() {
      const button = (kind) => {
        const made = Object.assign(document.createElement("button"), { className: kind, type: "button" });
        this.box.append(made);
        return made;
      };
      const entries = this.panels.flatMap((panel) => panel.legend.map((entry) => ({ panel, entry })));
      for (const old of this.entries.splice(entries.length)) old.remove();
      entries.forEach(({ panel, entry }, i) => this.furnishEntry(this.entries[i] ??= button("entry"), panel, entry));
      const marks = this.panels.flatMap((panel) => (panel.handles ?? []).map((mark) => ({ panel, mark })));
      for (const { button } of this.handles.splice(marks.length)) button.remove();
      marks.forEach(({ panel, mark }, i) => {
        this.handles[i] ??= new Handle(this, button("handle"));
        this.handles[i].take(panel, mark, this.handles.slice(0, i));
      });
    }
    furnishEntry(button, panel, { curve: index, x, y, width: length }) {
      const [width, height] = this.size, curve = panel.curves[index];
      Object.assign(button.style, { left: `${100 * x / width}%`, top: `${100 * (height - y - 0.21) / height}%`,
                                    width: `${100 * length / width}%`, height: `${100 * 0.42 / height}%` });
      button.setAttribute("aria-label", say("curve", curve.label));
      button.setAttribute("aria-pressed", String(curve.shown));
      button.onclick = () => {
        curve.shown = !curve.shown;
        button.setAttribute("aria-pressed", String(curve.shown));
        this.draw();
      };
    }

    draw() {
      const width = this.box.clientWidth, height = this.box.clientHeight, dots = window.devicePixelRatio || 1;
      if (width === 0) return;
      this.unit = width / this.size[0];
      for (const canvas of [this.canvas, this.over]) {
        [canvas.width, canvas.height] = [Math.round(width * dots), Math.round(height * dots)];
        canvas.getContext("2d").scale(dots, dots);
      }
      new Painter(this.canvas.getContext("2d"), this, this.unit).draw();
      this.whole.hidden = !this.panels.some((panel) => panel.x.moved || panel.y.moved);
      for (const handle of this.handles) handle.draw();
      this.drawCursor();
      this.motion?.refresh();
      this.box.dispatchEvent(new Event("drawn"));
    }
    /// What the abscissa of a panel is; the name stands below the last panel of a column alone.
    abscissa(panel) { return (this.partners(panel).find((part) => part.x.name) ?? panel).x; }
    /// The other figures of the page over the same quantity show the same place: `at` is {name, measure, value} or null.
    link(at) {
      for (const other of plots) if (other !== this) other.follow(at);
    }
    follow(at) {
      if (this.linked === at || !this.linked && !at) return;
      this.linked = at;
      if (this.unit && !this.cursor) this.drawCursor();
    }
    drawLinked(painter) {
      const { name, measure, value } = this.linked;
      painter.stroke(painter.colors.line, 0.5);
      for (const panel of this.readable) {
        const axis = this.abscissa(panel), [at] = panel.place(value, panel.y.low);
        if (!name || axis.name !== name || axis.measure !== measure || !(at >= panel.left && at <= panel.right)) continue;
        painter.segment(at, panel.bottom, at, panel.top);
        for (const curve of panel.curves) {
          if (!curve.shown || !curve.isFunction || !curve.covers(value)) continue;
          const read = curve.at(value), [x, y] = read === null ? [NaN, NaN] : panel.place(value, read);
          if (panel.holds(x, y)) painter.marker(x, y, 7, 0.4, 0.6, painter.colors.of(curve.color));
        }
      }
    }
    /// An instant that is shown elsewhere, as a line through the panels over time.
    showMoment(instant) {
      this.moment = instant;
      if (this.unit) this.drawCursor();
    }

    /// Those that show values, not pictures.
    get readable() { return this.panels.filter((panel) => !panel.picture); }
    partners(panel) { return this.panels.filter((other) => other === panel || other.goesWith(panel)); }
    reset() {
      for (const panel of this.panels) { panel.x.reset(); panel.y.reset(); }
      this.draw();
      this.box.dispatchEvent(new Event("zoomed"));
    }
    /// Positions on the panel's axes (0 to 1) become its corners; null leaves an axis as it is.
    zoom(panel, x, y) {
      if (x) {
        panel.x.zoom(...x);
        for (const other of this.partners(panel)) [other.x.low, other.x.high] = [panel.x.low, panel.x.high];
      }
      if (y) panel.y.zoom(...y);
      this.draw();
      this.box.dispatchEvent(new Event("zoomed"));
    }
    zoomAround(panel, [x, y], factor, only = "") {
      const part = (position) => [position - position * factor, position + (1 - position) * factor];
      this.zoom(panel, only === "y" ? null : part(x), only === "x" ? null : part(y));
    }
    move(panel, x, y) { this.zoom(panel, [x, 1 + x], y === 0 ? null : [y, 1 + y]); }

    place(event) {
      const box = this.box.getBoundingClientRect();
      return [(event.clientX - box.left) / this.unit, this.size[1] - (event.clientY - box.top) / this.unit];
    }
    within(panel, [x, y]) { return [(x - panel.left) / panel.width, (y - panel.bottom) / panel.height]; }
    /// The panel of a place, and which axis alone is meant where it lies beside the numbers.
    panelAt([x, y]) {
      for (const panel of this.readable) if (panel.holds(x, y)) return [panel, ""];
      for (const panel of this.readable) {
        if (x > panel.left - 1.2 && x < panel.left && y > panel.bottom && y < panel.top) return [panel, "y"];
        if (y > panel.bottom - 1 && y < panel.bottom && x > panel.left && x < panel.right) return [panel, "x"];
      }
      return [null, ""];
    }

    listen() {
      const on = (name, act) => this.box.addEventListener(name, act, { passive: false });
      on("pointerdown", (event) => this.down(event));
      on("pointermove", (event) => this.moved(event));
      on("pointerup", (event) => this.up(event));
      on("pointercancel", (event) => { this.pointers.delete(event.pointerId); this.pulled = null; this.drawCursor(); });
      on("pointerleave", (event) => {  // what a finger showed stays until another place is touched
        if (event.pointerType !== "touch" && this.pointers.size === 0 && !this.byKeys) this.setCursor(null);
      });
      on("dblclick", (event) => { if (!event.target.closest("button")) this.reset(); });
      on("wheel", (event) => this.wheel(event));
      on("keydown", (event) => this.key(event));
      on("focusout", (event) => { if (!this.box.contains(event.relatedTarget)) this.setCursor(null); });
    }
    down(event) {
      if (event.target.closest("button, details") || event.button !== 0) return;
      const at = this.place(event), [panel, only] = this.panelAt(at);
      if (!panel) return;
      this.box.focus({ preventScroll: true });
      this.box.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, at);
      this.pulled = { panel, only, from: at, to: at, touch: event.pointerType === "touch", move: event.shiftKey };
      if (this.pulled.touch) this.setCursor({ panel, x: at[0], y: at[1] });
      else event.preventDefault();
    }
    moved(event) {
      const at = this.place(event), before = this.pointers.get(event.pointerId);
      if (before && this.pointers.size === 2) this.pinch(event.pointerId, at);
      if (before) this.pointers.set(event.pointerId, at);
      if (this.pulled && !this.pulled.touch) {
        this.pulled.to = at;
        if (this.pulled.move) {
          const { panel } = this.pulled;
          this.move(panel, (before[0] - at[0]) / panel.width, (before[1] - at[1]) / panel.height);
        }
        this.drawCursor();
      } else if (this.pointers.size < 2) {
        const [panel, only] = this.panelAt(at);
        this.setCursor(panel && !only ? { panel, x: at[0], y: at[1] } : null);
      }
    }
    /// Two fingers: what lay under them stays under them.
    pinch(id, to) {
      const [other] = [...this.pointers].filter(([pointer]) => pointer !== id).map(([, at]) => at);
      const from = this.pointers.get(id), { panel } = this.pulled;
      const old = Math.hypot(from[0] - other[0], from[1] - other[1]), now = Math.hypot(to[0] - other[0], to[1] - other[1]);
      if (old > 0.1 && now > 0.1) this.zoomAround(panel, this.within(panel, other), old / now);
    }
    up(event) {
      const pulled = this.pulled;
      this.pointers.delete(event.pointerId);
      if (this.pointers.size === 0) this.pulled = null;
      if (pulled && !pulled.touch && !pulled.move) this.zoomToBox(pulled);
    }
    /// A flat box means one axis, a small one nothing.
    zoomToBox({ panel, only, from, to }) {
      const [wide, high] = [0, 1].map((i) => Math.abs(to[i] - from[i]) * this.unit);
      const [x0, y0] = this.within(panel, from).map((part) => clamp(part, 0, 1));
      const [x1, y1] = this.within(panel, to).map((part) => clamp(part, 0, 1));
      if (Math.max(wide, high) < 8) return this.drawCursor();
      if (panel.equal) {
        const half = Math.max(Math.abs(x1 - x0), Math.abs(y1 - y0)) / 2, [x, y] = [(x0 + x1) / 2, (y0 + y1) / 2];
        return this.zoom(panel, [x - half, x + half], [y - half, y + half]);
      }
      this.zoom(panel, wide < 8 || only === "y" ? null : [x0, x1], high < 8 || only === "x" ? null : [y0, y1]);
    }
    /// The wheel scrolls the page unless the figure was chosen, by a click or the keyboard.
    wheel(event) {
      const at = this.place(event), [panel, only] = this.panelAt(at);
      if (!panel || !(event.ctrlKey || this.box.contains(document.activeElement))) return;
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 30 : 1;
      this.zoomAround(panel, this.within(panel, at), Math.exp(clamp(event.deltaY * lines, -200, 200) * 0.0015), panel.equal ? "" : only);
    }

    key(event) {
      if (event.target !== this.box || event.ctrlKey || event.altKey || event.metaKey) return;
      const panel = this.cursor?.panel ?? this.readable[0];
      const middle = this.cursor ? this.within(panel, [this.cursor.x, this.cursor.y]) : [0.5, 0.5];
      const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (arrow && event.shiftKey) this.move(panel, 0.1 * arrow[0], 0.1 * arrow[1]);
      else if (arrow) this.step(panel, ...arrow);
      else if (event.key === "+" || event.key === "=") this.zoomAround(panel, middle, 0.7);
      else if (event.key === "-") this.zoomAround(panel, middle, 1 / 0.7);
      else if (event.key === "0") this.reset();
      else if (event.key === "Escape") this.setCursor(null);
      else return;
      event.preventDefault();
    }
    /// The cursor goes from sample to sample, at least a pixel, and up and down among panels.
    step(panel, aside, upwards) {
      const panels = this.readable, index = panels.indexOf(panel);
      if (upwards) panel = panels[clamp(index - upwards, 0, panels.length - 1)];
      const guide = panel.curves.find((curve) => curve.shown && curve.isFunction);
      let x = this.cursor ? this.cursor.x + aside / this.unit : panel.left + panel.width / 2;
      if (this.cursor && aside && guide) {
        const value = (place) => panel.x.value((place - panel.left) / panel.width);
        let i = guide.nearest(value(this.cursor.x), false);
        while (guide.x[i + aside] !== undefined && panel.place(guide.x[i], 0)[0] * aside < x * aside - 1e-9) i += aside;
        x = panel.place(guide.x[i], 0)[0];
      }
      this.setCursor({ panel, x: clamp(x, panel.left, panel.right), y: panel.bottom + panel.height / 2 }, true);
    }

    setCursor(cursor, byKeys = false) {
      this.cursor = cursor;
      this.byKeys = byKeys && cursor !== null;
      if (!cursor) this.link(null);
      this.reading.setAttribute("aria-live", byKeys ? "polite" : "off");
      this.drawCursor();
    }

    /// What there is to read at the cursor: lines of text, and the places that are marked.
    readings() {
      const { panel, x, y } = this.cursor, lines = [], places = [];
      const guide = panel.curves.find((curve) => curve.shown && curve.isFunction && curve.x.length > 1);
      if (!guide) return this.nearestPoint();
      let value = panel.x.value((x - panel.left) / panel.width);
      if (guide.covers(value)) value = guide.x[guide.nearest(value, false)];
      const axis = this.abscissa(panel);
      lines.push({ name: axis.name || "x", text: axis.text(value, this.comma, guide.countsWhole) });
      for (const part of this.partners(panel).filter((one) => !one.picture))
        for (const curve of part.curves) {
          if (!curve.shown || !curve.isFunction || !curve.covers(value)) continue;
          const read = curve.at(value);
          if (read === null || !Number.isFinite(read)) continue;
          const upper = curve.style === "band" ? curve.at(value, curve.upper) : null;
          const text = part.y.text(read, this.comma);
          lines.push({ name: curve.label || part.y.name, color: curve.color,
                       text: upper === null ? text : `${text} … ${part.y.text(upper, this.comma)}` });
          places.push({ panel: part, x: value, y: read, color: curve.color });
        }
      return { lines, places, value };
    }
    nearestPoint() {
      const { panel, x, y } = this.cursor;
      let best = null, least = this.byKeys ? Infinity : 0.6;
      for (const curve of panel.curves.filter((one) => one.shown))
        curve.x.forEach((value, i) => {
          if (value === null || curve.y[i] === null) return;
          const [px, py] = panel.place(value, curve.y[i]), distance = Math.hypot(px - x, py - y);
          if (distance < least) [best, least] = [{ panel, x: value, y: curve.y[i], color: curve.color, curve }, distance];
        });
      const [a, b] = best ? [best.x, best.y]
        : [panel.x.value((x - panel.left) / panel.width), panel.y.value((y - panel.bottom) / panel.height)];
      const lines = [{ name: panel.x.name || "x", text: panel.x.text(a, this.comma, best?.curve.countsWhole) },
                     { name: panel.y.name || "y", text: panel.y.text(b, this.comma) }];
      if (best?.curve.label) lines.unshift({ name: best.curve.label, text: "", color: best.color });
      return { lines, places: best ? [best] : [], value: null };
    }

    drawMoment(painter) {
      painter.stroke(painter.colors.text, 0.9);
      for (const panel of this.panels) {
        const [at] = panel.place(this.moment, panel.y.low);
        if (at >= panel.left && at <= panel.right) painter.segment(at, panel.bottom, at, panel.top);
      }
    }
    drawCursor() {
      const context = this.over.getContext("2d");
      context.clearRect(0, 0, this.over.width, this.over.height);
      const painter = new Painter(context, this, this.unit);
      if (this.moment !== undefined) this.drawMoment(painter);
      const boxed = this.pulled && !this.pulled.touch && !this.pulled.move && this.pulled.to !== this.pulled.from;
      if (boxed) {
        const { from, to } = this.pulled;
        painter.stroke(painter.colors.line, 0.75, [3, 3]);
        context.strokeRect(painter.X(Math.min(from[0], to[0])), painter.Y(Math.max(from[1], to[1])),
                           Math.abs(to[0] - from[0]) * this.unit, Math.abs(to[1] - from[1]) * this.unit);
      }
      this.reading.hidden = !this.cursor || boxed;
      if (!this.cursor && this.linked && !boxed) this.drawLinked(painter);
      if (!this.cursor || boxed) return;
      const { panel, x, y } = this.cursor, { lines, places, value } = this.readings();
      if (value !== null) this.link({ name: this.abscissa(panel).name, measure: this.abscissa(panel).measure, value });
      painter.stroke(painter.colors.line, 0.5);
      for (const part of value === null ? [panel] : this.partners(panel)) {
        const at = value === null ? x : clamp(part.place(value, part.y.low)[0], part.left, part.right);
        painter.segment(at, part.bottom, at, part.top);
        if (part === panel && !this.byKeys) painter.segment(part.left, y, part.right, y);
      }
      for (const place of places) {
        const [px, py] = place.panel.place(place.x, place.y);
        if (place.panel.holds(px, py)) painter.marker(px, py, 7, 0.4, 0.6, painter.colors.of(place.color));
      }
      this.reading.replaceChildren(...lines.map(({ name, text, color }) => {
        const line = document.createElement("span"), mark = document.createElement("b");
        if (color) mark.style.color = painter.colors.of(color);
        mark.textContent = color ? "● " : "";
        line.append(mark, text ? `${name}: ${text}` : name);
        return line;
      }));
      const beside = x < this.size[0] / 2;
      Object.assign(this.reading.style, { left: beside ? `${(x + 0.35) * this.unit}px` : "", top: `${(this.size[1] - panel.top + 0.15) * this.unit}px`,
                                          right: beside ? "" : `${(this.size[0] - x + 0.35) * this.unit}px` });
    }
  }

  function begin(data) {
    const picture = data.previousElementSibling;
    if (picture?.tagName !== "IMG" || picture.classList.contains("printed")) return;
    picture.classList.add("printed");
    new Plot(picture, JSON.parse(data.textContent)).draw();
  }

  /// Makes the figures below `root` live as they come near the window.
  function enliven(root) {
    const near = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) {
        if (!isIntersecting) continue;
        near.unobserve(target);
        begin(target.nextElementSibling);
      }
    }, { rootMargin: "400px" });
    for (const data of root.querySelectorAll("img:not(.printed) + script.plot-data")) near.observe(data.previousElementSibling);
  }
  function enlivenNow(root) {
    root.querySelectorAll("script.plot-data").forEach(begin);
  }
  /// A figure without a picture, in `holder`: gives the plot, whose `renew` shows the next one.
  function show(holder, figure, words) {
    const picture = Object.assign(document.createElement("img"), { className: "printed", alt: words });
    holder.append(picture);
    const plot = new Plot(picture, figure);
    plot.draw();
    return plot;
  }
  return { enliven, enlivenNow, show };
})();
