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
  independent: ["u in rest", "u dans reste"], yesWord: ["yes", "oui"], noWord: ["no", "non"], shown: ["shown", "montré"],
  copy: ["Copy", "Copier"], rename: ["Rename", "Renommer"], intoScript: ["+ report", "+ rapport"], failed: ["failed", "échec"],
  older: ["of the script before the mistake", "du script avant l'erreur"], ended: ["dynlab has ended; this is its last state", "dynlab est terminé ; voici son dernier état"],
  noAnswer: ["no answer from dynlab; waiting for it", "pas de réponse de dynlab ; en attente"], running: ["computing", "calcul"],
  ready: ["up to date", "à jour"], stopped: ["stopped; what stands before is shown", "arrêté ; ce qui précède est montré"], again: ["Run again", "Relancer"], mistake: ["stopped at a mistake", "arrêté par une erreur"], line: ["line", "ligne"],
  system: ["system", "système"], inputSignal: ["input", "entrée"], noise: ["noise, sigma", "bruit, sigma"], runs: ["runs", "répétitions"],
  begin: ["Begin a study", "Commencer une étude"], parameter: ["parameter", "paramètre"], truth: ["truth", "vrai"], meanOf: ["mean", "moyenne"],
  scatter: ["std", "écart type"], bound: ["Cramér–Rao", "Cramér–Rao"], reported: ["reported std", "écart type annoncé"], value: ["estimate", "estimation"], error: ["std. error", "erreur type"],
  model: ["model", "modèle"], poles: ["poles", "pôles"], zeros: ["zeros", "zéros"], takeOrders: ["estimate this structure", "estimer cette structure"],
  estimationPart: ["estimation", "estimation"], validationPart: ["validation", "validation"], edgeFrom: ["begins", "début"], edgeTo: ["ends", "fin"],
  saveAs: ["Save as", "Enregistrer"], help: ["Help page of", "Page d'aide de"], step: ["step", "pas"],
  estimateHere: ["Estimate from here", "Estimer à partir d'ici"],
  tooFew: ["There are no two signals in this file.", "Ce fichier n'a pas deux signaux."],
  asked: ["This script runs programs. Run it? Say yes only if you know where it comes from.", "Ce script exécute des programmes. L'exécuter ? Dites oui seulement si vous savez d'où il vient."],
  allow: ["Run it", "L'exécuter"], shapeFirst: ["First order", "Premier ordre"], shapeSecond: ["Second order", "Second ordre"], shapeDelayed: ["First order with dead time", "Premier ordre avec retard pur"],
  argument: ["argument", "argument"], slider: ["slider", "curseur"], methodOf: ["Method of", "Méthode de"], colon: [":", "\u202f:"],
  controls: ["Controls", "Commandes"], bar: ["Session", "Session"], language: ["Language", "Langue"], giveUp: ["Cancel", "Annuler"], newName: ["new name", "nouveau nom"],
  invitation: ["Open a record at the left, or begin a study of a known system there: pictures and models stand here then.",
               "Ouvrez un enregistrement à gauche, ou commencez-y l'étude d'un système connu : figures et modèles se placent ici."],
  noName: ["a name is letters, digits and _, begins with no digit, and is no word of Lua.", "un nom est fait de lettres, de chiffres et de _, ne commence pas par un chiffre et n'est pas un mot de Lua."],
  nameTaken: ["this name stands in the script already.", "ce nom est déjà dans le script."], nameOfFunction: ["a function is called so.", "une fonction s'appelle ainsi."],
  isUsed: ["is used further on; change that first. Line", "sert encore plus loin ; changez d'abord cela. Ligne"],
  changedMeanwhile: ["Not done: the script is being changed elsewhere all the time; try again.", "Pas fait : le script ne cesse d'être modifié ailleurs ; réessayez."],
  typedOver: ["Lines that you typed were changed elsewhere meanwhile: yours stand here; Undo brings the others back.",
              "Des lignes que vous avez tapées ont été modifiées ailleurs entre-temps : les vôtres restent ; Annuler rétablit les autres."],
  notClosed: ["Not taken over, as it is not closed:", "Non repris, car non fermé :"],
  fewDrawn: ["The pictures show the last %1 of %2 ticked models.", "Les figures montrent les %1 derniers des %2 modèles cochés."],
  columns: ["What the columns say", "Ce que disent les colonnes"],
  nameAbout: ["the variable of the script; a click shows its controls", "la variable du script ; un clic montre ses commandes"], methodAbout: ["the function that estimated it", "la fonction qui l'a estimé"],
  polesAbout: ["how many poles", "nombre de pôles"], zerosAbout: ["how many zeros", "nombre de zéros"], delayAbout: ["pure delay in s, and its standard error", "retard pur en s, et son erreur type"],
  fitEstimationAbout: ["how much of the output the simulation explains, on the samples of the estimation; 100 % is all", "part de la sortie expliquée par la simulation, sur les échantillons de l'estimation ; 100 % est tout"],
  fitValidationAbout: ["the same on the samples of the validation", "la même sur les échantillons de la validation"],
  "R_T²About": ["1 − variance of the simulation error over variance of the output", "1 − variance de l'erreur de simulation sur variance de la sortie"],
  YICAbout: ["Young's criterion: small errors and certain parameters; the lower, the better", "critère de Young : petites erreurs et paramètres sûrs ; le plus bas est le meilleur"],
  conditionAbout: ["condition number of the equations; very large: the data do not tell the parameters apart", "conditionnement des équations ; très grand : les données ne distinguent pas les paramètres"],
  whiteAbout: ["whether the residuals are white: nothing in them is predictable", "si les résidus sont blancs : rien n'y est prévisible"],
  independentAbout: ["whether the input still explains a part of the residuals; then the model lacks something", "si l'entrée explique encore une partie des résidus ; il manque alors quelque chose au modèle"],
  no_raw: ["There is no record yet: open one at the left.", "Il n'y a pas encore d'enregistrement : ouvrez-en un à gauche."],
  no_models: ["There is no model yet: press New model.", "Il n'y a pas encore de modèle : pressez Nouveau modèle."],
  no_orders: ["There is no order search yet: press Search orders.", "Il n'y a pas encore de recherche d'ordres : pressez Chercher les ordres."],
  no_study: ["There is no study yet: open Known system and begin one.", "Il n'y a pas encore d'étude : ouvrez Système connu et commencez-en une."],
  no_reading: ["Nothing is read by hand yet: open Read by hand and choose a shape. The record must be a step response.", "Rien n'est encore lu à la main : ouvrez Lecture à la main et choisissez une forme. L'enregistrement doit être une réponse indicielle."],
  no_second: ["There is no second record: open one and use it for validation only.", "Il n'y a pas de second enregistrement : ouvrez-en un, pour la validation seulement."],
  no_delays: ["The last ticked model was not estimated over a grid of delays.", "Le dernier modèle coché n'a pas été estimé sur une grille de retards."],
  ofRecord: ["of the record", "de l'enregistrement"], without: ["without", "sans"],
  notAlike: ["The second record is not prepared as the first is.", "Le second enregistrement n'est pas préparé comme le premier."], prepareAlike: ["Prepare it alike", "Le préparer de même"],
  levelStep: ["Level", "Niveau"], trendStep: ["Trend", "Tendance"], filterStep: ["Filter", "Filtrer"], resampleStep: ["Resample", "Rééchantillonner"],
  outliersStep: ["Outliers", "Valeurs aberrantes"], missingStep: ["Missing samples", "Échantillons manquants"], rangeStep: ["Range", "Étendue"],
  noStep: ["The input of this record is no single step, or the response has not settled.", "L'entrée n'est pas un échelon unique, ou la réponse n'est pas établie."],
  exports: ["Exports", "Exportations"], exportModels: ["Models", "Modèles"], exportData: ["Prepared record", "Enregistrement préparé"], exportScript: ["Script", "Script"],
};
const VIEWS = {
  record: ["Record", "Enregistrement"], second: ["Second record", "Second enregistrement"], spectrum: ["Spectrum", "Spectre"], compare: ["Simulation and record", "Simulation et mesure"],
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
