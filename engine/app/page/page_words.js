// What the page of a live document says, and that of a prompt's figures.
import { addWords, tr, trIn, trPlural } from "./words.js";

addWords({
  // The bar and what it tells of the run
  bar: tr("Document"), runAll: tr("Run all"), runAllAbout: tr("Run every cell again"), pdf: tr("PDF"),
  asPrinted: tr("The document as it is printed"), toMistake: tr("to the mistake"), ofBefore: tr("of the run before"),
  ofBeforeRunning: tr("of the run before; running again"), cellOf: tr("cell {} of {}"),
  stoppedAfter: tr("stopped: {} of {} cells were run"), cells: trPlural("{} cell, {} s", "{} cells, {} s"),
  ended: tr("dynlab has ended; this is the last page"),
  lost: tr("dynlab does not answer: start it again and open its new address; your text is still here"),
  asked: tr("This document runs programs. Run it?"),
  askedAbout: tr("Its text is shown below. Say yes only if you know where it comes from."),
  askedAboutOwn: tr("dynlab new made its folder on this computer. Its text is shown below."),
  notPrinted: tr("{}: code that is not printed"), asInScript: tr("as in the script"),

  // The editor
  source: tr("Source"), field: tr("Text of the file"), save: tr("Save"), atOnce: tr("at once"),
  atOnceAbout: tr("Save as you type"), saveAbout: tr("Save (Ctrl-S); Esc leaves the text"), notYet: tr("not saved yet (Ctrl-S)"),
  notSaved: tr("not saved: {}"),
  conflict: tr("was changed elsewhere as well. Yours stands in the editor; of the file these lines are others:"),
  takeTheirs: tr("Take the file's text"), keepMine: tr("Save mine over it"), draft: tr("A draft of {} was not saved."),
  takeDraft: tr("Take it"), dropDraft: tr("Throw it away"), notInIt: tr("(lines of yours are not in it)"),
  outline: tr("Go to …"), runCell: tr("Run this cell (Ctrl-Enter; Shift-Enter: and go to the next)"),
  runAbove: tr("Run the cells above this one that have changed"), find: tr("Find and replace (Ctrl-F, Shift-Ctrl-F)"),
  editText: tr("Click to edit"), variables: tr("Variables of the script"), noVariables: tr("The script has no variables yet."),
  // What CodeMirror's search says, in its own English
  search: tr("Search:"), asPattern: tr("(Use /re/ syntax for regexp search)"), replace: tr("Replace:"),
  replaceAll: tr("Replace all:"), replaceWith: tr("Replace with:"), replaceBy: tr("With:"), replaceIt: tr("Replace?"),
  yes: tr("Yes"), no: tr("No"), all: tr("All"),

  // What is handed in
  handIn: tr("Hand in"), makeReport: tr("Make report.pdf"), makePack: tr("Pack the folder"),
  handInAbout: tr("The report is made as the script stands in its file; then the folder with it is packed into one file."),
  makingReport: tr("the report is being made …"), makingPack: tr("the folder is being packed …"),
  notMade: tr("not made: the text in the editor is not saved yet"),

  // What dynlab check finds
  found: tr("What dynlab check finds"), onPage: tr("page {}"), checked: tr("checked"), checking: tr("checking: {} %"),
  openAnswers: trPlural("{} answer open", "{} answers open"), brokenRules: trPlural("{} rule broken", "{} rules broken"),
  hints: trPlural("{} hint", "{} hints"), points: tr("{} of {} points"),
  older: tr("of the files before the last change; they are being checked again"),
  notGiven: tr("Answers that are not given yet"), toMend: tr("To be mended"), remarks: tr("Hints"),
  checksOfLesson: tr("Checks of the lesson: {}"), nothingToMend: tr("dynlab check finds nothing to mend."),
  // The kinds of answers, as a script's header names them
  number: trIn("kind of answer", "number"), text: trIn("kind of answer", "text"), truth: trIn("kind of answer", "truth"),
  vector: trIn("kind of answer", "vector"), matrix: trIn("kind of answer", "matrix"), data: trIn("kind of answer", "data"),
  model: trIn("kind of answer", "model"), response: trIn("kind of answer", "response"), table: trIn("kind of answer", "table"),

  // The page of a prompt's figures
  figures: tr("Figures"), noFigures: tr("none yet: type, say, {}"),
  lastFigures: tr("dynlab has ended; these are its last figures"),
});
export { inEnglish, label, language, number, say, typeset, useLanguage } from "./words.js";
