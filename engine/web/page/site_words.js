// What the pages of a site say that run scripts in the browser.
import { addWords, tr, trPlural } from "./words.js";

addWords({
  lessonBar: tr("Script"), runOne: tr("Run (Shift-Enter)"), runEverything: tr("Run all"), stopRun: tr("Stop"), checkWork: tr("Check"), submitWork: tr("Submit"),
  workMenu: tr("My work"), exportWork: tr("Export the script"), importWork: tr("Import a script"), shareWork: tr("Copy a link to this script"),
  resetWork: tr("Start again from the lesson's script"), otherFiles: tr("Other files in the folder"),
  engineLoads: tr("Loading the engine …"), engineReady: tr("Ready"), runningCell: tr("Running {}"), runningPart: tr("Running {}: {} %"),
  ranCells: trPlural("{} cell has run, {} s", "{} cells have run, {} s"), runStopped: tr("Stopped"), runFailed: tr("An error stopped the run."),
  engineLost: tr("The engine could not be loaded: check the connection and load the page again."),
  cannotRun: tr("This browser cannot run the cells, because it does not support WebAssembly exceptions. The page shows the results of an earlier run. To run the cells, update the browser, or install dynlab."),
  notKept: tr("This browser does not save your work: export the script before you close the page."),
  otherTab: tr("This lesson is open in another tab, which saves your work. Here you can read and run it."), editHere: tr("Edit here"),
  newerLesson: tr("The lesson has changed since you worked on it. The page contains your work. You can also export the earlier version of your work."), exportOlder: tr("Export the earlier version"),
  lostPlaces: tr("The lesson has changed since you worked on it, and it no longer has some of your cells. You can export your earlier work."),
  sharedScript: tr("This link contains a script from another person. The page shows the script below and has not run it. Use the script only if you trust its source."),
  useShared: tr("Use this script"), keepOwn: tr("Keep my script"), badLink: tr("The script in this link cannot be read. Check that the link is complete."), linkCopied: tr("The link is copied."),
  linkShown: tr("Link to this script:"),
  imported: tr("The page now contains the script."), otherScript: tr("This script is not from this lesson: its cells differ from the cells of the lesson. Open the script with dynlab preview."),
  tooLarge: tr("This file is too large: the size limit of a script is {} MB."), resetSure: tr("Your changes will be deleted. Continue?"),
  changeText: tr("Edit the text"), endText: tr("Done"), codeOf: tr("Code of cell {}"), textOf: tr("Text in Markdown"), hiddenCode: tr("Code that the report does not show"),
  checksRun: tr("Running the script for the checks …"), pointsOf: tr("{} of {} points"), hintOf: tr("Hint"), moreHint: tr("Next hint"),
  checkedLater: tr("dynlab checks this during grading."), scriptStopped: tr("The script stopped: {}"), noChecks: tr("This lesson has no checks that can run here."),
  questionHints: tr("Hints for question {}"), packReady: tr("{} is in your downloads: submit this file."), packSays: tr("SHA-256 {}"),
  packMissing: tr("The file contains no PDF of the report; dynlab creates the PDF from the same files."), runExample: tr("Run"),
});
export * from "./words.js";
