// What the scripts of a page say, in the page's language: the attribute lang of its <html>, which a page may change. The
// scripts hold English, and tr, trIn and trPlural mark it for xgettext. The translations are those of engine/po;
// documents/html/script_catalogs.h puts them before this script as dynlabCatalogs.
const dynlabWords = (() => {
  "use strict";
  const CONTEXT_END = "\u0004";  // as gettext's own files have it
  const tr = (english) => english;
  /// Of words that have another translation elsewhere.
  const trIn = (context, english) => context + CONTEXT_END + english;
  /// The first {} stands for the number.
  const trPlural = (one, many) => [one, many];

  const languages = ["en", ...Object.keys(dynlabCatalogs)];
  /// The language of a code that may name a region, "fr-CA"; English where there is no catalog.
  const languageOf = (code) => [code, code?.split("-")[0]].find((one) => languages.includes(one)) ?? "en";
  const language = () => languageOf(document.documentElement.lang);

  /// The values stand for {} in their order, or for {1}, {2}, ...
  function filled(format, values) {
    let next = 0;
    return format.replace(/\{(\d*)\}/g, (slot, number) => String(values[number ? number - 1 : next++] ?? slot));
  }
  /// Of a message with a plural the first value is the number.
  function textIn(code, message, ...values) {
    const catalog = dynlabCatalogs[languageOf(code)], [id, many] = [message].flat(), n = Math.abs(values[0]);
    if (many === undefined) return filled(catalog?.texts[id] ?? id.slice(id.indexOf(CONTEXT_END) + 1), values);
    const form = catalog?.forms[n < catalog.forms.length ? n : 100 + n % 100];  // rules go by the last two digits
    return filled(catalog?.texts[id]?.[form] ?? (n === 1 ? id : many), values);
  }
  const text = (message, ...values) => textIn(language(), message, ...values);
  /// A number that is written with a point, as the language writes it.
  const number = (written) => written.replace(".", dynlabCatalogs[language()]?.decimalSign ?? ".");

  /// A text into an element, "T_s" and "s^{2}" with what is lowered and raised.
  function typeset(node, written) {
    node.replaceChildren();
    let end = 0;
    for (const found of written.matchAll(/(?<![\p{L}\d_])(\p{L})([_^])(?:\{([^}]*)\}|([\p{L}\d]+))/gu)) {
      const [all, base, way, inBraces, plain] = found;
      const part = document.createElement(way === "_" ? "sub" : "sup");
      part.textContent = inBraces ?? plain;
      node.append(written.slice(end, found.index) + base, part);
      end = found.index + all.length;
    }
    node.append(written.slice(end));
  }

  return { typeset, tr, trIn, trPlural, languages, languageOf, language, text, textIn, number };
})();
