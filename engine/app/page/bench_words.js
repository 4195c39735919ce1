// What the workbench says, in English and French.
const WORDS = {
  undo: ["Undo", "Annuler"], redo: ["Redo", "Rétablir"], stop: ["Stop", "Arrêter"], pdf: ["Report (PDF)", "Rapport (PDF)"],
  script: ["Script", "Script"], close: ["Close", "Fermer"], views: ["Views", "Vues"], why: ["why?", "pourquoi ?"],
  record: ["Record", "Enregistrement"], preparation: ["Preparation", "Préparation"], parts: ["Estimation and validation", "Estimation et validation"],
  estimate: ["Estimate", "Estimer"], models: ["Models", "Modèles"], known: ["Known system", "Système connu"], reading: ["Read by hand", "Lecture à la main"],
  open: ["Open a record", "Ouvrir un enregistrement"], drop: ["Drop a data file anywhere on this page, or choose one:", "Déposez un fichier de données n'importe où sur cette page, ou choisissez-en un :"],
  file: ["Choose a file", "Choisir un fichier"], course: ["course data and files here", "données du cours et fichiers d'ici"],
  column: ["column", "colonne"], role: ["role", "rôle"], unit: ["unit", "unité"], input: ["input", "entrée"], output: ["output", "sortie"], time: ["time", "temps"],
  unused: ["not used", "non utilisée"], sampling: ["sampling time (s)", "période d'échantillonnage (s)"], asFile: ["as the file says", "celle du fichier"],
  take: ["Take this record", "Prendre cet enregistrement"], second: ["Use it for validation only", "Pour la validation seulement"],
  experiment: ["Experiment", "Expérience"],
  advice: ["What advice says", "Ce que dit advice"], clean: ["Nothing speaks against fitting a model.", "Rien ne s'oppose à l'estimation d'un modèle."],
  show: ["show", "montrer"], add: ["Add", "Ajouter"], remove: ["Delete", "Supprimer"], off: ["on", "actif"], up: ["Earlier", "Plus tôt"], down: ["Later", "Plus tard"],
  divide: ["Divide 60 : 40", "Diviser 60 : 40"], whole: ["Whole record for both", "Tout pour les deux"],
  sameParts: ["The model is judged on the samples it was fitted to: a model with too many parameters looks good there.",
              "Le modèle est jugé sur les échantillons de son estimation : un modèle à trop de paramètres y paraît bon."],
  method: ["Method", "Méthode"], newModel: ["New model", "Nouveau modèle"], options: ["Options", "Options"], notGiven: ["not given", "non précisé"],
  yes: ["true", "true"], no: ["false", "false"], delay: ["Delay", "Retard"], free: ["estimated", "estimé"], fixed: ["fixed (s)", "fixé (s)"], noDelay: ["none", "aucun"],
  search: ["Search orders", "Chercher les ordres"], name: ["name", "nom"], fitEstimation: ["fit est. %", "fit est. %"],
  fitValidation: ["fit val. %", "fit val. %"], condition: ["cond.", "cond."], white: ["white", "blanc"],
  independent: ["u explains rest", "u explique le reste"], yesWord: ["yes", "oui"], noWord: ["no", "non"], shown: ["shown", "montré"],
  copy: ["Copy", "Copier"], rename: ["Rename", "Renommer"], intoScript: ["+ report", "+ rapport"], failed: ["failed", "échec"],
  older: ["of the script before the mistake", "du script avant l'erreur"], ended: ["dynlab has ended; this is its last state", "dynlab est terminé ; voici son dernier état"],
  noAnswer: ["no answer from dynlab; waiting for it", "pas de réponse de dynlab ; en attente"], running: ["computing", "calcul"],
  ready: ["up to date", "à jour"], stopped: ["stopped; what stands before is shown", "arrêté ; ce qui précède est montré"], again: ["Run again", "Relancer"], mistake: ["stopped at a mistake", "arrêté par une erreur"], line: ["line", "ligne"],
  system: ["system", "système"], inputSignal: ["input", "entrée"], noise: ["noise, sigma", "bruit, sigma"], runs: ["runs", "répétitions"],
  begin: ["Begin a study", "Commencer une étude"], parameter: ["parameter", "paramètre"], truth: ["truth", "vrai"], meanOf: ["mean", "moyenne"],
  scatter: ["std", "écart type"], bound: ["Cramér–Rao", "Cramér–Rao"], reported: ["reported std", "écart type annoncé"], value: ["estimate", "estimation"], error: ["std. error", "erreur type"],
  model: ["model", "modèle"], poles: ["poles", "pôles"], zeros: ["zeros", "zéros"], takeOrders: ["estimate this structure", "estimer cette structure"],
  estimationPart: ["estimation", "estimation"], validationPart: ["validation", "validation"], edgeFrom: ["begins", "début"], edgeTo: ["ends", "fin"],
  saveAs: ["Save as", "Enregistrer"], bands: ["bands", "bandes"], help: ["Help page of", "Page d'aide de"], step: ["step", "pas"],
  readHere: ["Read it off this record", "Lire sur cet enregistrement"], estimateHere: ["Estimate from here", "Estimer à partir d'ici"],
  tooFew: ["There are no two signals in this file.", "Ce fichier n'a pas deux signaux."], loading: ["reading", "lecture"],
  asked: ["This script runs programs. Run it? Say yes only if you know where it comes from.", "Ce script exécute des programmes. L'exécuter ? Dites oui seulement si vous savez d'où il vient."],
  allow: ["Run it", "L'exécuter"], shapeFirst: ["First order", "Premier ordre"], shapeSecond: ["Second order", "Second ordre"], shapeDelayed: ["First order with dead time", "Premier ordre avec retard pur"],
  noStep: ["The input of this record is no single step, or the response has not settled.", "L'entrée n'est pas un échelon unique, ou la réponse n'est pas établie."],
  exports: ["Exports", "Exportations"], exportModels: ["Models", "Modèles"], exportData: ["Prepared record", "Enregistrement préparé"], exportScript: ["Script", "Script"],
};
const VIEWS = {
  record: ["Record", "Enregistrement"], spectrum: ["Spectrum", "Spectre"], compare: ["Simulation and record", "Simulation et mesure"],
  residuals: ["Simulation residuals", "Résidus de simulation"], step: ["Step response", "Réponse indicielle"], impulse: ["Impulse response", "Réponse impulsionnelle"],
  bode: ["Bode", "Bode"], nyquist: ["Nyquist", "Nyquist"], poles: ["Poles and zeros", "Pôles et zéros"], parameters: ["Parameters", "Paramètres"],
  correlation: ["Impulse response by correlation", "Réponse par corrélation"], delay: ["Loss over the delay", "Critère selon le retard"],
  reading: ["Read by hand", "Lecture à la main"], orders: ["Orders", "Ordres"], study: ["Monte Carlo study", "Étude de Monte Carlo"],
};
let place = navigator.language?.startsWith("fr") ? 1 : 0;

export const useLanguage = (code) => { place = code === "fr" ? 1 : 0; document.documentElement.lang = code; };
export const isFrench = () => place === 1;
export const say = (key) => WORDS[key]?.[place] ?? key;
export const viewName = (key) => VIEWS[key]?.[place] ?? key;
export const viewNames = () => Object.keys(VIEWS);
/// A number as a table shows it.
export function shortNumber(value, digits = 4) {
  if (value === null || value === undefined || typeof value !== "number") return "";
  const text = String(Number(value.toPrecision(digits))).replace("-", "−");
  return place === 1 ? text.replace(".", ",") : text;
}
