// The words of our pages in English and French. Each page adds a table of its own, {key: [English, French]}; its scripts and
// its HTML look up by key what they show.
const words = {};
let place = navigator.language?.startsWith("fr") ? 1 : 0;

/// With the spaces that French has before signs and within quotation marks, at which no line breaks.
const typeset = (french) => french.replace(/ ([;:?!]|%(?!\d))/g, "\u202f$1").replace(/« /g, "«\u00a0").replace(/ »/g, "\u00a0»");

export function addWords(table) {
  for (const [key, [english, french]] of Object.entries(table)) words[key] = [english, typeset(french)];
}
export function useLanguage(code) {
  place = code === "fr" ? 1 : 0;
  document.documentElement.lang = code;
}
export const isFrench = () => place === 1;
export const inEnglish = (key) => words[key][0];
/// The values stand for %1, %2, ...
export const say = (key, ...values) => (words[key]?.[place] ?? key).replace(/%(\d)/g, (_, number) => values[number - 1]);
/// A number that is written with a point, as the language writes it.
export const withComma = (number) => (isFrench() ? number.replace(".", ",") : number);

/// What the HTML names by key: the text of an element (data-say), its hint (data-say-title) and what is told of it to those who
/// do not see it (data-say-label).
export function label() {
  for (const node of document.querySelectorAll("[data-say]")) node.textContent = say(node.dataset.say);
  for (const node of document.querySelectorAll("[data-say-title]")) node.title = say(node.dataset.sayTitle);
  for (const node of document.querySelectorAll("[data-say-label]")) node.setAttribute("aria-label", say(node.dataset.sayLabel));
}

addWords({
  stop: ["Stop", "Arrêter"], allow: ["Run it", "L'exécuter"], mistake: ["stopped at a mistake", "arrêté par une erreur"],
  noAnswer: ["no answer from dynlab; waiting for it", "pas de réponse de dynlab ; en attente"],
});
