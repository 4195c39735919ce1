// The parts of a data set for estimation and validation, as bars over its plot that mouse and arrow keys move.
import { element, hold } from "./bench_fields.js";
import { say } from "./bench_words.js";

const KINDS = ["estimation", "validation"];

/// `parts()` returns {estimation: [from, to], validation: [from, to]} in seconds, or nothing; the brushes call
/// `move(kind, [from, to], held)` with the place to which the user dragged a part.
export class Brushes {
  constructor(plot, parts, move) {
    Object.assign(this, { plot, parts, move, bars: {}, strip: element("div", { className: "strip" }) });
    plot.box.before(this.strip);
    for (const kind of KINDS) {
      const bar = element("div", { className: `brush ${kind}`, title: say(kind + "Part") });
      const edges = ["From", "To"].map((side, i) => {
        const edge = element("button", { type: "button", className: "edge", ariaLabel: say("labeled", say(kind + "Part"), say("edge" + side)) });
        edge.setAttribute("role", "slider");
        edge.onpointerdown = (event) => this.take(event, kind, i);
        edge.onkeydown = (event) => this.step(event, kind, i);
        return edge;
      });
      bar.append(edges[0], element("span", { textContent: say(kind + "Part") }), edges[1]);
      bar.onpointerdown = (event) => { if (event.target === bar || event.target.tagName === "SPAN") this.take(event, kind, 2); };
      this.bars[kind] = { bar, edges };
      this.strip.append(bar);
    }
    plot.box.addEventListener("drawn", () => { this.strip.style.width = plot.box.style.width; this.draw(); });
    this.draw();
  }
  get panel() { return this.plot.panels[0]; }
  /// The whole abscissa, and the one that is seen.
  get whole() { return this.panel.x.whole; }

  draw() {
    const [width] = this.plot.size, parts = this.parts(), { panel } = this;
    KINDS.forEach((kind, k) => {
      const { bar, edges } = this.bars[kind], part = parts?.[kind];
      bar.hidden = !part || !panel;
      if (bar.hidden) return;
      const place = (value) => panel.left + Math.min(Math.max(panel.x.position(value), 0), 1) * panel.width;
      const [from, to] = part.map(place);
      Object.assign(bar.style, { left: `${100 * from / width}%`, width: `${Math.max(0.4, 100 * (to - from) / width)}%`, top: `${0.05 + 1.1 * k}rem` });
      edges.forEach((edge, i) => {
        edge.setAttribute("aria-valuenow", String(Number(part[i].toPrecision(6))));
        edge.setAttribute("aria-valuemin", String(this.whole[0]));
        edge.setAttribute("aria-valuemax", String(this.whole[1]));
        edge.setAttribute("aria-valuetext", `${panel.x.text(part[i], this.plot.comma)}${panel.x.measure ? "" : " s"}`);
      });
    });
  }
  take(event, kind, side) {
    if (event.button !== 0) return;
    event.preventDefault();
    event.stopPropagation();
    const part = [...this.parts()[kind]], start = this.value(event);
    if (side < 2) event.target.focus({ preventScroll: true });
    const moved = (to) => {
      const by = to - start, next = [...part], span = part[1] - part[0], [low, high] = this.whole;
      if (side === 2) { next[0] = Math.min(Math.max(part[0] + by, low), high - span); next[1] = next[0] + span; }
      else next[side] = Math.min(Math.max(part[side] + by, low), high);
      if (next[0] > next[1]) next.reverse();
      return next;
    };
    const events = new AbortController(), taken = event.pointerId;
    let place = part;
    const listen = (name, act) => document.addEventListener(name, (event) => { if (event.pointerId === taken) act(event); }, { signal: events.signal });
    const follow = (event) => { place = moved(this.value(event)); };
    const end = () => {
      events.abort();
      this.move(kind, place, false);
      hold(false);
    };
    hold(true);
    listen("pointermove", (event) => { follow(event); this.move(kind, place, true); });
    listen("pointerup", (event) => { follow(event); end(); });
    listen("pointercancel", end);  // the system took the hand away: the part stays where it was put
  }
  value(event) {
    const [x] = this.plot.place(event);
    return this.panel.x.value((x - this.panel.left) / this.panel.width);
  }
  step(event, kind, side) {
    const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[event.key];
    if (!way) return;
    event.preventDefault();
    event.stopPropagation();
    const part = [...this.parts()[kind]], [low, high] = this.whole;
    part[side] = Math.min(Math.max(part[side] + way * (high - low) / 100, low), high);
    if (part[0] < part[1]) this.move(kind, part, false);
  }
}
