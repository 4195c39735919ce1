// The words of our pages, in the page's language. Each page adds a separate table, {key: tr("English")}; its scripts
// and its HTML look up their texts by key. Translations: report_templates/html/words.js.
export const { tr, trIn, trPlural, typeset, number, language, languages, languageOf, text, textIn } = dynlabWords;
const words = {};

export const addWords = (table) => Object.assign(words, table);
export const useLanguage = (code) => { document.documentElement.lang = code; };
export const browserLanguage = () => languageOf(navigator.language);
/// The values replace {} in their order; the first one is the number of a message that has a plural.
export const say = (key, ...values) => (Object.hasOwn(words, key) ? text(words[key], ...values) : key);
export const inEnglish = (key) => textIn("en", words[key]);

useLanguage(browserLanguage());  // until a page knows what it shows

/// Fills the texts that the HTML names by key: the text of an element (data-say), its hint (data-say-title) and its
/// label for screen readers (data-say-label).
export function label() {
  for (const node of document.querySelectorAll("[data-say]")) node.textContent = say(node.dataset.say);
  for (const node of document.querySelectorAll("[data-say-title]")) node.title = say(node.dataset.sayTitle);
  for (const node of document.querySelectorAll("[data-say-label]")) node.setAttribute("aria-label", say(node.dataset.sayLabel));
}

addWords({
  stop: tr("Stop"), allow: tr("Run it"), mistake: tr("stopped at an error"),
  noAnswer: tr("no response from dynlab; waiting"),
});
