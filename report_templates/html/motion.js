// Rigs that move above their figure, as documents/html/plot_data.h tells them: lengths in cm from the lower left corner.
// Nothing starts by itself, and what nobody sees stops.
const dynlabMotion = (() => {
  "use strict";
  const { Painter, palette, clamp } = dynlabDrawing;
  const { tr, text } = dynlabWords;
  const WORDS = { play: tr("Play"), pause: tr("Pause"), time: tr("Instant"), speed: tr("Speed"), real: tr("real time"), slower: tr("{} times slower"),
                  measured: tr("measured"), simulated: tr("simulated"), stage: tr("The plant in motion. {}") };
  const say = (key, ...values) => text(WORDS[key], ...values);
  const RIM = 0.3, LARGER = 1.5, STEP = 0.02, SLOWER = [2, 5, 10];

  const moving = new Set();
  document.addEventListener("visibilitychange", () => { if (document.hidden) for (const motion of moving) motion.pause(); });

  class Motion {
    constructor(plot, data) {
      Object.assign(this, data, { plot, speed: 1 });
      this.size = [data.size[0] + 2 * RIM, data.size[1] + 2 * RIM];
      const kinds = ["measured", "simulated"].filter((kind) => data[kind]);
      this.signals = data.parts.map((_, k) => plot.panels[data.picture + 1 + k]);
      this.actors = kinds.map((kind, i) => ({ kind, curves: this.signals.map((panel) => panel.curves[i]) }));
      const x = this.actors[0].curves[0].x;
      [this.first, this.last] = [x[0], x[x.length - 1]];
      this.build();
      this.show(this.first);
    }

    build() {
      const make = (name, kind = "", parts = {}) => Object.assign(document.createElement(name), { className: kind }, parts);
      this.box = make("div", "motion");
      this.box.motion = this;
      this.stage = make("canvas", "stage");
      this.stage.style.aspectRatio = `${this.size[0]} / ${this.size[1]}`;
      this.stage.style.width = `${Math.round(LARGER * this.size[0] / 2.54 * 96)}px`;
      this.stage.setAttribute("role", "img");
      this.stage.onclick = () => this.toggle();
      const controls = make("div", "controls");
      this.button = make("button", "", { onclick: () => this.toggle() });
      this.scrubber = make("input", "", { type: "range", min: this.first, max: this.last, step: STEP });
      this.scrubber.setAttribute("aria-label", say("time"));
      this.scrubber.oninput = () => { this.pause(); this.show(Number(this.scrubber.value)); };
      this.scrubber.onkeydown = (event) => {
        if (event.key !== " ") return;
        event.preventDefault();
        this.toggle();
      };
      this.time = make("output", "time");
      this.select = make("select");
      this.select.setAttribute("aria-label", say("speed"));
      for (const slower of [1, ...SLOWER])
        this.select.append(make("option", "", { value: 1 / slower, textContent: slower === 1 ? say("real") : say("slower", slower) }));
      this.select.onchange = () => { this.speed = Number(this.select.value); };
      controls.append(this.button, this.scrubber, this.time, this.select);
      this.values = make("div", "values");
      this.box.append(this.stage, controls, this.values);
      this.plot.box.before(this.box);
      this.tellState();
      new ResizeObserver(() => this.draw()).observe(this.stage);
      new IntersectionObserver(([seen]) => { if (!seen.isIntersecting) this.pause(); }).observe(this.box);
    }

    get playing() { return moving.has(this); }
    tellState() { this.button.textContent = this.playing ? say("pause") : say("play"); }
    toggle() { if (this.playing) this.pause(); else this.play(); }
    pause() {
      if (!moving.delete(this)) return;
      this.tellState();
      this.tellValues();
    }
    play() {
      if (this.now >= this.last) this.show(this.first);
      moving.add(this);
      this.tellState();
      const run = this.run = {};  // an earlier one that waits for its frame goes on no longer
      let before = null;
      const go = (clock) => {
        if (!this.playing || this.run !== run) return;
        if (!this.box.isConnected) return this.pause();
        if (before !== null) this.show(this.now + this.speed * Math.min(clock - before, 250) / 1000);
        before = clock;
        if (this.now >= this.last) this.pause();
        else requestAnimationFrame(go);
      };
      requestAnimationFrame(go);
    }

    /// The rig as it stands at an instant, and the instant in the figure below.
    show(instant) {
      this.now = clamp(instant, this.first, this.last);
      this.scrubber.value = this.now;
      this.refresh();
      this.plot.showMoment(this.now);
    }
    refresh() {
      this.tellValues();
      this.draw();
    }
    tellValues() {
      const { comma } = this.plot;
      const named = this.plot.panels.find((panel) => panel.x.measure) ?? this.signals[0];
      this.time.textContent = named.x.text(this.now, comma);
      const colors = palette(), spoken = [this.time.textContent];
      this.values.replaceChildren(...this.signals.map((panel, k) => {
        const line = document.createElement("div"), words = this.actors.map(({ kind, curves }) =>
          `${say(kind)} ${panel.y.text(curves[k].at(this.now), comma)}`);
        spoken.push(`${panel.y.name}: ${words.join(", ")}`);
        line.append(`${panel.y.name}: `);
        this.actors.forEach(({ curves }, i) => {
          const mark = document.createElement("b");
          mark.textContent = "● ";
          mark.style.color = colors.of(curves[k].color);
          line.append(mark, words[i], i + 1 < words.length ? ", " : "");
        });
        return line;
      }));
      if (this.playing) return;  // nobody can listen so fast
      const told = spoken.join("; ");
      this.scrubber.setAttribute("aria-valuetext", told);
      this.stage.setAttribute("aria-label", say("stage", told));
    }

    /// Where a point of a part stands while the signals have these values.
    place([x, y, part], values) {
      for (let k = part; k >= 0; k = this.parts[k].on) {
        const { turns, x: ox, y: oy, by, at } = this.parts[k], moved = values[k] - at;
        if (turns) {
          const [c, s] = [Math.cos(by * moved), Math.sin(by * moved)];
          [x, y] = [ox + c * (x - ox) - s * (y - oy), oy + s * (x - ox) + c * (y - oy)];
        } else {
          [x, y] = [x + moved * ox, y + moved * oy];
        }
      }
      return [x + RIM, y + RIM];
    }

    draw() {
      const width = this.stage.clientWidth, dots = window.devicePixelRatio || 1, unit = width / this.size[0];
      if (width === 0) return;
      [this.stage.width, this.stage.height] = [Math.round(width * dots), Math.round(this.size[1] * unit * dots)];
      const context = this.stage.getContext("2d");
      context.scale(dots, dots);
      const painter = new Painter(context, this, unit), moves = ({ points }) => points.some(([, , part]) => part >= 0);
      for (const piece of this.pieces) if (!moves(piece)) this.piece(painter, piece, [], painter.colors.text, 1);
      for (const { kind, curves } of this.actors) {
        const values = curves.map((curve) => curve.at(this.now)), ghost = kind === "measured" && this.simulated;
        if (!values.every(Number.isFinite)) continue;
        for (const piece of this.pieces)
          if (moves(piece)) this.piece(painter, piece, values, painter.colors.of(curves[0].color), ghost ? 2.2 : 1);
      }
    }
    piece(painter, { points, shade, width }, values, color, wider) {
      const { context } = painter;
      context.beginPath();
      points.forEach((point, i) => {
        const [x, y] = this.place(point, values);
        context[i ? "lineTo" : "moveTo"](painter.X(x), painter.Y(y));
      });
      context.globalAlpha = shade ?? 1;
      if (shade === undefined) {
        painter.stroke(color, wider * width);
        context.lineJoin = context.lineCap = "round";
        context.stroke();
      } else {
        context.fillStyle = color;
        context.fill();
      }
      context.globalAlpha = 1;
    }
  }
  return { Motion };
})();
