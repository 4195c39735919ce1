// The bar of a site: search in all pages, by words and their beginnings. The index (search.js) is loaded with the first use.
// Pages of a site with a service worker register it.
(() => {
  "use strict";
  const bar = document.querySelector("nav.site"), field = document.getElementById("search"), list = document.getElementById("found");
  const { tr, text } = dynlabWords;
  const { root, offline } = document.documentElement.dataset, language = dynlabWords.language();
  const MOST = 12;
  const KINDS = { lesson: tr("Lesson"), demonstration: tr("Demonstration"), guide: tr("Guide"), function: tr("Function"), overview: tr("Overview") };
  if (offline !== undefined && location.protocol.startsWith("http")) navigator.serviceWorker?.register(root + "sw.js").catch(() => {});
  const theme = document.querySelector(".tools .theme"), tools = document.querySelector(".tools");
  if (theme) bar.append(theme);
  if (tools) bar.after(tools);
  bar.querySelector(".here")?.setAttribute("aria-current", "true");

  const wordsOf = (text) => text.toLowerCase().split(/[^\p{L}\p{N}]+/u).filter(Boolean);
  let pages = null;
  function prepare() {
    const readable = window.dynlabPages.filter((page) => page.language === language || !page.translated);
    pages = readable.map((page) => ({
      ...page,
      titleWords: wordsOf(page.title),
      aboutWords: wordsOf(page.about),
      parts: page.headings.map(([text, id]) => ({ text, id, words: wordsOf(text) })),
    }));
  }
  const load = new Promise((resolve) => {
    const begin = () => {
      if (window.dynlabPages) return resolve();
      const script = document.createElement("script");
      script.src = root + "page/search.js";
      script.onload = () => resolve();
      document.head.append(script);
    };
    field.addEventListener("focus", begin, { once: true });
    window.dynlabLoadSearch = () => { begin(); return load; };
  });

  const begins = (words, asked) => words.some((word) => word.startsWith(asked));
  /// How well the page answers: every word asked for must begin one of its words; its title counts most.
  function rank(page, asked) {
    let total = page.titleWords.join(" ") === asked.join(" ") ? 1000 : 0;
    for (const word of asked) {
      const points = page.titleWords.includes(word) ? 100 : begins(page.titleWords, word) ? 50
        : begins(page.aboutWords, word) ? 20 : page.parts.some((part) => begins(part.words, word)) ? 10
        : page.words.includes(` ${word} `) ? 3 : page.words.includes(` ${word}`) ? 1 : 0;
      if (!points) return 0;
      total += points;
    }
    return total;
  }
  function search(text) {
    if (!pages) prepare();
    const asked = wordsOf(text);
    if (!asked.length) return [];
    return pages.map((page) => ({ page, points: rank(page, asked) })).filter((found) => found.points > 0)
      .sort((a, b) => b.points - a.points).slice(0, MOST)
      .map(({ page, points }) => {
        // A page that is found by its text leads to the part whose heading says it.
        const part = points < 50 && page.parts.find(({ words }) => asked.every((word) => begins(words, word)));
        return { page, part, href: root + page.file + (part ? "#" + part.id : "") };
      });
  }
  window.dynlabSearch = search;

  function item({ page, part, href }) {
    const entry = document.createElement("li"), link = document.createElement("a");
    const title = document.createElement("strong"), about = document.createElement("small");
    title.textContent = page.title + (part ? ": " + part.text : "");
    about.textContent = [text(KINDS[page.kind]), page.about].filter(Boolean).join(" – ");
    link.href = href;
    link.append(title, about);
    entry.append(link);
    return entry;
  }
  async function show() {
    await window.dynlabLoadSearch();
    const found = search(field.value);
    list.replaceChildren(...found.map(item));
    if (!found.length) {
      const none = document.createElement("li");
      none.textContent = text(tr("No page contains all of these words."));
      list.append(none);
    }
    list.hidden = !wordsOf(field.value).length;
  }
  field.addEventListener("input", show);
  field.form.addEventListener("submit", async (event) => {
    event.preventDefault();
    await show();
    list.querySelector("a")?.click();
  });
  const links = () => [...list.querySelectorAll("a")];
  field.form.addEventListener("keydown", (event) => {
    const all = [field, ...links()], at = all.indexOf(document.activeElement);
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      event.preventDefault();
      all[(at + (event.key === "ArrowDown" ? 1 : all.length - 1)) % all.length].focus();
    } else if (event.key === "Escape") {
      list.hidden = true;
      field.focus();
    }
  });
  document.addEventListener("click", (event) => { if (!field.form.contains(event.target)) list.hidden = true; });
  document.addEventListener("keydown", (event) => {
    if (event.key !== "/" || event.ctrlKey || event.metaKey || event.target.closest?.("input, textarea, select")) return;
    event.preventDefault();
    field.focus();
  });
})();
