// Sliders of a page that nobody serves: what the document shows at each of their places lies in the page, told by
// documents/html/slider_page.h. Sliders of one cell are moved together; the others go back to where the page was made.
const dynlabSliders = (() => {
  "use strict";
  const { tr, text, number } = dynlabWords;

  const written = (value, unit) => number(String(value).replace("-", "−")) + (unit ? "\u202f" + unit : "");

  /// A figure's data with the members that differ (slider_page.cpp).
  function changed(data, difference) {
    if (Array.isArray(difference)) return difference[0];
    const copy = Array.isArray(data) ? [...data] : { ...data };
    for (const [key, value] of Object.entries(difference)) copy[key] = changed(data[key], value);
    return copy;
  }

  /// The pieces of the page as a combination of places has them: another text, or the same with figures drawn otherwise.
  function show(pieces, combination) {
    for (const [name, kept] of Object.entries(pieces)) {
      const piece = document.getElementById("piece-" + name), there = kept[combination];
      piece.made ??= [...piece.childNodes];
      piece.classList.toggle("moved", there !== null);
      if (typeof there === "string") piece.innerHTML = there;
      else if (piece.other) piece.replaceChildren(...piece.made);
      piece.other = typeof there === "string";
      dynlabPlots.enlivenNow(piece);
      dynlabChoices.enliven(piece);
      if (piece.other) continue;
      [...piece.querySelectorAll("div.plot")].forEach(({ plot }, i) =>
        plot.renew(there?.[i] ? changed(plot.made, there[i]) : plot.made));
    }
  }

  class Group {
    constructor({ sliders, pieces }, all) {
      Object.assign(this, { sliders, pieces, all, places: sliders.map((slider) => slider.shown) });
      this.controls = [];
    }
    get combination() {
      return this.sliders.reduce((sum, { values }, i) => sum * values.length + this.places[i], 0);
    }
    move(places) {
      for (const other of this.all) if (other !== this) other.rest();
      if (places.every((place, i) => place === this.places[i])) return;
      this.places = places;
      this.controls.forEach((control) => control.tell());
      show(this.pieces, this.combination);
    }
    rest() {
      const places = this.sliders.map((slider) => slider.shown);
      if (places.every((place, i) => place === this.places[i])) return;
      this.places = places;
      this.controls.forEach((control) => control.tell());
      show(this.pieces, this.combination);
    }
    with(i, place) {
      const last = this.sliders[i].values.length - 1;
      return this.places.map((one, k) => k === i ? Math.min(Math.max(place, 0), last) : one);
    }

    control(box, i) {
      const slider = this.sliders[i], make = (name) => document.createElement(name);
      const label = make("label"), input = make("input"), output = make("output"), back = make("button");
      input.type = "range";
      input.id = "slider-" + slider.name;
      label.htmlFor = input.id;
      dynlabWords.typeset(label, slider.label);
      back.textContent = text(tr("Reset"));
      Object.assign(input, { min: 0, max: slider.values.length - 1, step: 1 });
      const tell = () => {
        input.value = this.places[i];
        output.textContent = written(slider.values[this.places[i]], slider.unit);
        input.setAttribute("aria-valuetext", output.textContent);
        back.hidden = this.places[i] === slider.shown;
      };
      input.oninput = () => this.move(this.with(i, Number(input.value)));
      back.onclick = () => { this.move(this.with(i, slider.shown)); input.focus(); };
      this.controls.push({ tell });
      tell();
      box.append(label, input, output, back);
    }
    /// Numbers by the sliders' names: each goes to its nearest place.
    follow(numbers) {
      const nearest = ({ name, values }, place) => {
        if (!(name in numbers)) return place;
        const away = values.map((value) => Math.abs(value - numbers[name]));
        return away.indexOf(Math.min(...away));
      };
      if (this.sliders.some(({ name }) => name in numbers))
        this.move(this.sliders.map((slider, i) => nearest(slider, this.places[i])));
    }
    step({ name, by }) {
      const i = this.sliders.findIndex((slider) => slider.name === name);
      if (i >= 0) this.move(this.with(i, this.places[i] + by));
    }
  }

  function begin() {
    const data = document.querySelector("script.slider-places");
    if (!data) return;
    const groups = [];
    for (const group of JSON.parse(data.textContent)) groups.push(new Group(group, groups));
    for (const box of document.querySelectorAll(".slider"))
      groups[box.dataset.group].control(box, Number(box.dataset.number));
    document.addEventListener("slidermove", ({ detail }) => groups.forEach((group) => group.follow(detail)));
    document.addEventListener("sliderstep", ({ detail }) => groups.forEach((group) => group.step(detail)));
  }
  return { begin };
})();
