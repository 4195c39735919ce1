// What the page of a live document says, and that of a prompt's figures.
import { addWords, tr, trIn, trPlural } from "./words.js";

addWords({
  // The bar and its messages about the run
  bar: tr("Document"), runAll: tr("Run all"), runAllAbout: tr("Run every cell again"), pdf: tr("PDF"),
  asPrinted: tr("The document as printed"), toMistake: tr("Go to error"), ofBefore: tr("results of the previous run"),
  ofBeforeRunning: tr("results of the previous run; running again"), cellOf: tr("cell {} of {}"),
  stoppedAfter: tr("stopped: {} of {} cells were run"), cells: trPlural("{} cell, {} s", "{} cells, {} s"),
  ended: tr("dynlab has exited; this is the last version of the page"),
  lost: tr("dynlab does not respond. Restart dynlab and open the new address; your text is still here"),
  asked: tr("This document runs programs. Run it?"),
  askedAbout: tr("The text of the document is shown below. Answer yes only if you trust its source."),
  askedAboutOwn: tr("dynlab new created the folder of this document on this computer. The text of the document is shown below."),
  notPrinted: tr("{}: code that is not printed"), asInScript: tr("Reset"),

  // The editor
  source: tr("Source"), field: tr("Text of the file"), save: tr("Save"), atOnce: tr("run as I type"),
  atOnceAbout: tr("Save as you type"), saveAbout: tr("Save (Ctrl-S); Esc leaves the editor"), notYet: tr("not saved yet (Ctrl-S)"),
  notSaved: tr("not saved: {}"),
  conflict: tr("was also changed by another program. Your version is in the editor; these lines differ in the file:"),
  takeTheirs: tr("Use the file's text"), keepMine: tr("Overwrite with my text"), draft: tr("A draft of {} was not saved."),
  takeDraft: tr("Restore"), dropDraft: tr("Discard"), notInIt: tr("(your lines are not in the file)"),
  outline: tr("Go to …"), runCell: tr("Run this cell (Ctrl-Enter; Shift-Enter: run and go to the next cell)"),
  runAbove: tr("Run the changed cells above this one"), find: tr("Find and replace (Ctrl-F, Shift-Ctrl-F)"),
  editText: tr("Click to edit"), variables: tr("Variables of the script"), noVariables: tr("The script has no variables yet."),
  // What CodeMirror's search says, in its own English
  search: tr("Search:"), asPattern: tr("(Use /re/ syntax for regexp search)"), replace: tr("Replace:"),
  replaceAll: tr("Replace all:"), replaceWith: tr("Replace with:"), replaceBy: tr("With:"), replaceIt: tr("Replace?"),
  yes: tr("Yes"), no: tr("No"), all: tr("All"),

  // Submission
  handIn: tr("Submit"), makeReport: tr("Create report.pdf"), makePack: tr("Pack the folder"),
  handInAbout: tr("dynlab creates the report from the saved script, then packs the folder with the report into one file."),
  makingReport: tr("creating the report …"), makingPack: tr("packing the folder …"),
  notMade: tr("not created: save the text in the editor first"),

  // What dynlab check finds
  found: tr("Issues found by dynlab check"), onPage: tr("page {}"), checked: tr("checked"), checking: tr("checking: {} %"),
  openAnswers: trPlural("{} answer missing", "{} answers missing"), brokenRules: trPlural("{} rule violated", "{} rules violated"),
  hints: trPlural("{} hint", "{} hints"), points: tr("{} of {} points"),
  older: tr("results from before the last change; checking again"),
  notGiven: tr("Missing answers"), toMend: tr("To fix"), remarks: tr("Hints"),
  checksOfLesson: tr("Checks of the lesson: {}"), nothingToMend: tr("dynlab check found no problems."),
  // The kinds of answers, as a script's header names them
  number: trIn("kind of answer", "number"), text: trIn("kind of answer", "text"), truth: trIn("kind of answer", "truth"),
  vector: trIn("kind of answer", "vector"), matrix: trIn("kind of answer", "matrix"), data: trIn("kind of answer", "data"),
  model: trIn("kind of answer", "model"), response: trIn("kind of answer", "response"), table: trIn("kind of answer", "table"),

  // The page of a prompt's figures
  figures: tr("Figures"), noFigures: tr("no figures yet; enter, for example, {}"),
  lastFigures: tr("dynlab has exited; this page shows the last figures"),
});
export { inEnglish, label, language, number, say, typeset, useLanguage } from "./words.js";
