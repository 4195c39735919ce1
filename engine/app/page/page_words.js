// What the page of a live document says, and that of a prompt's figures, in English and French.
import { addWords } from "./words.js";

addWords({
  // The bar and what it tells of the run
  bar: ["Document", "Document"], runAll: ["Run all", "Tout exécuter"], runAllAbout: ["Run every cell again", "Exécuter de nouveau toutes les cellules"],
  pdf: ["PDF", "PDF"], asPrinted: ["The document as it is printed", "Le document tel qu'il est imprimé"], toMistake: ["to the mistake", "aller à l'erreur"],
  ofBefore: ["of the run before", "de l'exécution précédente"], ofBeforeRunning: ["of the run before; running again", "de l'exécution précédente ; nouvelle exécution en cours"],
  cellOf: ["cell %1 of %2", "cellule %1 sur %2"], stoppedAfter: ["stopped: %1 of %2 cells were run", "arrêté : %1 sur %2 cellules exécutées"],
  cellDone: ["%1 cell, %2 s", "%1 cellule, %2 s"], cellsDone: ["%1 cells, %2 s", "%1 cellules, %2 s"],
  ended: ["dynlab has ended; this is the last page", "dynlab est terminé ; voici la dernière page"],
  lost: ["dynlab does not answer: start it again and open its new address; your text is still here",
         "dynlab ne répond pas : relancez-le et ouvrez sa nouvelle adresse ; votre texte est toujours ici"],
  asked: ["This document runs programs. Run it?", "Ce document exécute des programmes. L'exécuter ?"],
  askedAbout: ["Its text is shown below. Say yes only if you know where it comes from.", "Son texte est montré ci-dessous. Dites oui seulement si vous savez d'où il vient."],
  notPrinted: ["%1: code that is not printed", "%1 : code qui n'est pas imprimé"], asInScript: ["as in the script", "comme dans le script"],

  // The editor
  source: ["Source", "Texte source"], field: ["Text of the file", "Texte du fichier"], save: ["Save", "Enregistrer"],
  atOnce: ["at once", "au fil de la saisie"], atOnceAbout: ["Save as you type", "Enregistrer à mesure que vous tapez"],
  wayOut: ["Esc leaves the text", "Échap quitte le texte"], notYet: ["not saved yet (Ctrl-S)", "pas encore enregistré (Ctrl-S)"],
  notSaved: ["not saved: %1", "non enregistré : %1"],
  conflict: ["was changed elsewhere as well. Yours stands in the editor; of the file these lines are others:",
             "a aussi été modifié ailleurs. Votre texte est dans l'éditeur ; ces lignes du fichier en diffèrent :"],
  takeTheirs: ["Take the file's text", "Prendre le texte du fichier"], keepMine: ["Save mine over it", "Enregistrer le mien par-dessus"],
  draft: ["A draft of %1 was not saved.", "Un brouillon (%1) n'a pas été enregistré."], takeDraft: ["Take it", "Le reprendre"], dropDraft: ["Throw it away", "Le jeter"],
  notInIt: ["(lines of yours are not in it)", "(des lignes de votre texte n'y sont pas)"],
  // What CodeMirror's search says, in its own English
  search: ["Search:", "Chercher :"], asPattern: ["(Use /re/ syntax for regexp search)", "(expression rationnelle : /exp/)"],
  replace: ["Replace:", "Remplacer :"], replaceAll: ["Replace all:", "Tout remplacer :"], replaceWith: ["Replace with:", "Remplacer par :"],
  replaceBy: ["With:", "Par :"], replaceIt: ["Replace?", "Remplacer ?"], yes: ["Yes", "Oui"], no: ["No", "Non"], all: ["All", "Tout"],

  // What is handed in
  handIn: ["Hand in", "Rendre"], makeReport: ["Make report.pdf", "Faire report.pdf"], makePack: ["Pack the folder", "Empaqueter le dossier"],
  handInAbout: ["The report is made as the script stands in its file; then the folder with it is packed into one file.",
                "Le rapport est fait à partir du script tel qu'il est dans son fichier ; puis le dossier qui le contient est empaqueté en un seul fichier."],
  makingReport: ["the report is being made …", "le rapport est en préparation …"], makingPack: ["the folder is being packed …", "le dossier est en cours d'empaquetage …"],
  notMade: ["not made: the text in the editor is not saved yet", "pas fait : le texte de l'éditeur n'est pas encore enregistré"],

  // What dynlab check finds
  found: ["What dynlab check finds", "Ce que trouve dynlab check"], onPage: ["page %1", "page %1"], checked: ["checked", "contrôlé"],
  answerOpen: ["%1 answer open", "%1 réponse à donner"], answersOpen: ["%1 answers open", "%1 réponses à donner"],
  ruleBroken: ["%1 rule broken", "%1 règle enfreinte"], rulesBroken: ["%1 rules broken", "%1 règles enfreintes"],
  hint: ["%1 hint", "%1 remarque"], hints: ["%1 hints", "%1 remarques"], points: ["%1 of %2 points", "%1 sur %2 points"],
  older: ["of the files before the last change; they are being checked again", "des fichiers d'avant la dernière modification ; ils sont contrôlés de nouveau"],
  notGiven: ["Answers that are not given yet", "Réponses qui ne sont pas encore données"], toMend: ["To be mended", "À corriger"], remarks: ["Hints", "Remarques"],
  checksOfLesson: ["Checks of the lesson: %1", "Contrôles de la leçon : %1"], nothingToMend: ["dynlab check finds nothing to mend.", "dynlab check ne trouve rien à corriger."],
  // The kinds of answers, as a script's header names them
  number: ["number", "nombre"], text: ["text", "texte"], truth: ["truth", "vrai ou faux"], vector: ["vector", "vecteur"], matrix: ["matrix", "matrice"],
  data: ["data", "données"], model: ["model", "modèle"], response: ["response", "réponse"], table: ["table", "table"],

  // The page of a prompt's figures
  figures: ["Figures", "Figures"], noFigures: ["none yet: type, say, step(tf({1}, {1, 1}))", "aucune encore : tapez, par exemple, step(tf({1}, {1, 1}))"],
  lastFigures: ["dynlab has ended; these are its last figures", "dynlab est terminé ; voici ses dernières figures"],
});
export { inEnglish, isFrench, label, say, useLanguage, withComma } from "./words.js";
