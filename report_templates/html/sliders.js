// Sliders of a page that nobody serves: what the document shows at each of their places lies in the page, told by
// documents/html/slider_page.h. One slider is moved at a time; the others go back to where the page was made.
const dynlabSliders = (() => {
  "use strict";
  const french = document.documentElement.lang.startsWith("fr");
  const BACK = french ? "comme dans le script" : "as in the script";

  function number(value, unit) {
    const text = String(value).replace("-", "−");
    return (french ? text.replace(".", ",") : text) + (unit ? "\u202f" + unit : "");
  }

  /// The pieces of the page as the slider's place has them; those that do not differ as they were made.
  function show(pieces, place) {
    for (const [name, htmls] of Object.entries(pieces)) {
      const piece = document.getElementById("piece-" + name), html = htmls[place];
      piece.made ??= [...piece.childNodes];
      piece.classList.toggle("moved", html !== null);
      if (html === null) piece.replaceChildren(...piece.made);
      else {
        piece.innerHTML = html;
        dynlabPlots.enlivenNow(piece);
        dynlabChoices.enliven(piece);
      }
    }
  }

  function control(box, slider, others) {
    const make = (name) => document.createElement(name);
    const label = make("label"), input = make("input"), output = make("output"), back = make("button");
    input.type = "range";
    input.id = "slider-" + slider.name;
    label.htmlFor = input.id;
    label.textContent = slider.label;
    back.textContent = BACK;
    Object.assign(input, { min: 0, max: slider.values.length - 1, step: 1 });
    const tell = (place) => {
      input.value = place;
      output.textContent = number(slider.values[place], slider.unit);
      input.setAttribute("aria-valuetext", output.textContent);
      back.hidden = place === slider.shown;
    };
    const move = (place) => {
      for (const other of others()) if (other !== slider) other.rest();
      tell(place);
      show(slider.pieces, place);
    };
    slider.rest = () => {
      if (Number(input.value) === slider.shown) return;
      tell(slider.shown);
      show(slider.pieces, slider.shown);
    };
    input.oninput = () => move(Number(input.value));
    back.onclick = () => { move(slider.shown); input.focus(); };
    tell(slider.shown);
    box.append(label, input, output, back);
  }

  function begin() {
    const data = document.querySelector("script.slider-places");
    if (!data) return;
    const sliders = JSON.parse(data.textContent);
    for (const box of document.querySelectorAll(".slider")) control(box, sliders[box.dataset.number], () => sliders);
  }
  return { begin };
})();
