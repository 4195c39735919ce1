// What the instructor's page says.
import { addWords, tr, trIn, trPlural } from "./words.js";

addWords({
  views: tr("Views"), language: tr("Language"), commands: tr("Commands"), keys: tr("Keyboard shortcuts"), close: tr("Close"), cancel: tr("Cancel"),
  ended: tr("dynlab has exited. Run dynlab course page again."), reason: tr("Reason"), unitDay: trIn("unit of time", "d"),
  time: tr("Time"), group: tr("Group"), assignment: tr("Assignment"), 
  download: tr("Download {}"), name: tr("Name"), unsaved: trPlural("{} mark is not stored yet", "{} marks are not stored yet"),

  // Marking
  marking: tr("Marking"), question: tr("Question"), check: tr("Check"), markedOf: tr("{} of {} marked"), solution: tr("Reference solution"),
  noLab: tr("The course has no lab. Only the questions of a lab are marked here."), noQuestion: tr("This lesson has no questions."),
  noCheck: tr("No check receives the marks of this question. Choose a check, or add a check with by_hand = true."),
  noWork: tr("This lab has no submissions yet."), beingRead: trPlural("{} submission is being read", "{} submissions are being read"),
  noAnswer_: tr("no answer"), unreadable_: tr("cannot be read: {}"), sameAs: trPlural("the same text in {} other submission", "the same text in {} other submissions"),
  whole: tr("Show all ({} kB)"), comment: tr("Comment"), commentAbout: tr("Comment for the student"), otherPoints: tr("Other number of points"),
  pointsOf: tr("{} of {}"), noMark: tr("not marked"), changed: tr("the mark was changed outside this window"), undo: tr("Undo"), showKeys: tr("Press ? to show the keyboard shortcuts"),
  rubric: tr("Points"), notGradedYet: tr("The lab is not graded yet, so the maximum number of points for this check is unknown. Run dynlab course grade."),
  keyDigits: tr("award these points and go to the next answer"), keyEnter: tr("award all points and go to the next answer"),
  keyMove: tr("go to the next or previous answer"), keyComment: tr("write a comment"), keyLetters: tr("add or remove a comment that was used before"),
  keyPoints: tr("enter another number of points"), keyUndo: tr("undo the last mark entered in this window"), keyWhole: tr("show all of a long answer"),
  keyHelp: tr("show these keyboard shortcuts"), nothingToUndo: tr("Nothing to undo."), enter: tr("Enter"),

  // Today
  today: tr("Today"), nothingToDo: tr("Nothing to do."), noAssignments: tr("The course has no assignments yet."),
  submitted: tr("{} of {} submitted"), countLate: tr("{} late"), countUnreadable: tr("{} unreadable"), countMissing: tr("{} missing"),
  dueFirst: trIn("deadline", "due {}"), dueReview: tr("reviews due {}"), dueFinal: tr("final version due {}"), next: tr("Next: {}"),
  remind: tr("Remind"), remindAll: tr("Remind all"), extend: tr("Extend"), accept: tr("Accept"), askAgain: tr("Ask again"),
  takeFile: tr("Accept this file"), drop: tr("Mark as dropped out"), release: tr("Release"), assign: tr("Assign"), send: tr("Send"),
  acceptTime: tr("Apply the penalty"), extendTo: tr("New deadline"), notTaken: tr("Files that were not accepted"), show: tr("Show"),
  missingFirst: tr("Missing"), missingFinal: tr("Final version missing"), missingReview: tr("Reviews missing"), missingScript: tr("Script missing"),
  unreadable: tr("Unreadable"), noPdf: tr("No PDF in the pack"), late: tr("Late"), lateWaits: tr("Late: a large penalty needs your confirmation"),
  sameFile: tr("The same file"), kin: tr("Reviews a report by a current or former group member"), held: tr("Withheld"),
  stopped: tr("Blocked: a name was found"), newerReport: tr("A version newer than the version that was sent"), newerReview: tr("A review newer than the released review"),
  unsent: tr("Report not sent to the reviewers yet"), unreleased: tr("Review not released yet"),
  unassigned: tr("Arrived after the allocation"), dropped: tr("Dropped out"), costs: tr("{} % deducted"),

  // Student
  student: tr("Student"), search: tr("Name, id, address or group"), searchAbout: tr("Type a name and press Enter."),
  until: tr("until {}"), before: tr("before: {}"), received: tr("Received"), file: tr("File"), state: tr("State"), receipt: tr("Receipt"),
  inTime: tr("on time"), lateBy: tr("late by {}"), withdrawn: tr("withdrawn"), withdraw: tr("Withdraw"), restore: tr("Restore"),
  correctTime: tr("Correct the time"), dueAs: tr("{} is due {} ({})"), asForAll: tr("as for the class"), mark: tr("Mark"), history: tr("History"),
  nothingMissing: tr("0 %: nothing was submitted"), notMarked: tr("not marked yet"), nothingSubmitted: tr("Nothing was submitted."),

  // Reviews
  reviews: tr("Reviews"), noReports: tr("The course has no reports with reviews."), noPairs: tr("The reviews are not assigned yet."),
  report: tr("Report"), author: tr("Author"), work: trIn("mark", "Work"), ownReviews: tr("Reviews by this group"), reviewer: tr("Reviewer"),
  all: trIn("rows", "All"), outliers: trIn("rows", "Outliers"), once: trIn("rows", "One review"), unreviewed: trIn("rows", "No review"),
  hold: tr("Withhold"), free: tr("Stop withholding"), dropScore: tr("Withdraw the scores"), outlier: tr("far below the others"),
  retaliation: tr("may be a reaction to a low score"), chosen: tr("Review of {} by {}"), releaseAll: tr("Release the reviews"),
  sendAll: tr("Send the reports"), assignAll: tr("Assign the reviews"),
  withdrawnState: tr("withdrawn"), releasedState: trIn("review", "released"), voluntaryState: trIn("review", "voluntary"),
  writtenState: trIn("review", "written"), endedState: trIn("review", "revoked"), sentState: trIn("review", "sent"),
  allottedState: trIn("review", "assigned"), heldState: tr("withheld"), stoppedState: tr("blocked"),

  // Marks
  marks: tr("Marks"), total: tr("Total"), weight: tr("weight {}"), changes: trPlural("{} change since the export of {}", "{} changes since the export of {}"),
  neverExported: tr("The marks have not been exported yet."), noChanges: tr("No changes since the export of {}."), exportMarks: tr("Export the marks"),
  platform: tr("Moodle or Canvas"), worksheet: tr("Moodle's grading worksheet or Canvas's gradebook, as downloaded"), fillIn: tr("Fill in the marks"),
  column: tr("Column in Canvas"), column_: tr("Column"), was: trIn("cell", "before"), is: trIn("cell", "now"), wholeCourse: tr("course total"),
  missingMark: tr("missing"), openMark: tr("not marked"),
});
export { browserLanguage, label, language, languages, number, say, useLanguage } from "./words.js";
