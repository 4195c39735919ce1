// What a document offers on a screen besides its text: contents, light or dark, code to copy, figures to zoom.
(() => {
  "use strict";
  const { tr, text } = dynlabWords;
  const main = document.querySelector("main");
  const make = (name, kind, text = "") => Object.assign(document.createElement(name), { className: kind, textContent: text });

  /// The page's own rules for dark screens, whatever the system asks for. A page opened as a file must not read linked sheets.
  const darkRules = [...document.querySelectorAll("style")].flatMap(({ sheet }) => [...sheet.cssRules])
    .find((rule) => rule.media?.mediaText.includes("prefers-color-scheme"));
  const system = matchMedia("(prefers-color-scheme: dark)");
  const KEY = "dynlab-theme";
  const remembered = () => { try { return localStorage.getItem(KEY); } catch { return null; } };
  let dark = (remembered() ?? (system.matches ? "dark" : "light")) === "dark";
  const theme = make("button", "theme");
  function applyTheme() {
    if (darkRules) darkRules.media.mediaText = dark ? "screen" : "not all";
    theme.textContent = text(dark ? tr("Light") : tr("Dark"));
    document.dispatchEvent(new Event("themechange"));
  }
  theme.onclick = () => {
    dark = !dark;
    try { localStorage.setItem(KEY, dark ? "dark" : "light"); } catch { /* a browser that keeps nothing */ }
    applyTheme();
  };
  system.addEventListener("change", () => {
    if (remembered() === null) dark = system.matches;
    applyTheme();
  });

  /// The sections, beside the text where there is room, else folded above it.
  function contents() {
    const level = (title) => Number(title.tagName[1]);
    const all = [...main.querySelectorAll("h1, h2, h3")], top = Math.min(...all.map(level));
    const titles = all.filter((title) => level(title) < top + 2);
    if (titles.length < 3 || main.querySelector("nav")) return null;
    const details = make("details", "contents"), nav = make("nav", ""), list = make("ul", "");
    nav.setAttribute("aria-label", text(tr("Contents")));
    for (const [number, title] of titles.entries()) {
      title.id ||= `section-${number + 1}`;
      const item = make("li", level(title) > top ? "inner" : ""), link = make("a", "");
      link.href = "#" + title.id;
      link.append(...[...title.childNodes].map((node) => node.cloneNode(true)));
      item.append(link);
      list.append(item);
    }
    nav.append(list);
    details.append(make("summary", "", text(tr("Contents"))), nav);
    const wide = matchMedia("(min-width: 82rem)");
    details.open = wide.matches;
    wide.addEventListener("change", () => { details.open = wide.matches; });
    return details;
  }

  function addCopyButton(code) {
    const box = make("div", "copied-from");
    const button = dynlabTables.copyButton("copy", text(tr("Copy")), () => code.textContent.replace(/\n$/, ""));
    button.setAttribute("aria-label", text(tr("Copy this code")));
    code.before(box);
    box.append(code, button);
  }

  const tools = make("div", "tools");
  const list = contents();
  if (list) tools.append(list);
  tools.append(theme);
  document.body.prepend(tools);
  for (const code of main.querySelectorAll("pre:not(.output, .error, .code, [data-run])")) addCopyButton(code);
  applyTheme();
  dynlabPlots.enliven(document);
  dynlabChoices.enliven(document);
  dynlabSliders.begin();
})();
