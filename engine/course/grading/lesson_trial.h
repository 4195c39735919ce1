#pragma once
#include <string>
#include <vector>

#include "course/grading/check_trial.h"

namespace dynlab::inline course {

/// A fault in a lesson that must be fixed before the lesson is used in class, with its file in the lesson's folder.
struct LessonFault {
    std::string file;
    int line = 0;  ///< 0: the whole file
    Message what;
};
using LessonFaults = std::vector<LessonFault>;

/// Checks the lesson's files without running them: headers, cells, marks of solutions, Lua that cannot be read, unknown
/// names and options, hints, tasks and reports in other languages that do not fit, tasks without a declared language,
/// untranslated sentences of the checks, an answer that is never submitted.
LessonFaults faults_of_texts(const Lesson& lesson);

/// Tests the lesson's checks. The reference solution must get full marks and the untouched starter none. Each
/// wrong_*.lua must fail exactly the checks that its lines "-- expects: CHECK: part of the message" name, with these
/// words; right_*.lua must fail none. `warnings` gets the results of giveaways_of. Throws as try_checks_of does.
LessonFaults faults_of_checks(const GradingSetup& setup, LessonFaults* warnings = nullptr);
LessonFaults faults_of_checks(const Lesson& lesson, const CheckTrial& trial);  ///< of checks that were tried

/// Checks that students can read and that a number from them passes, typed in as the answer.
LessonFaults giveaways_of(const CheckTrial& trial);

/// Tests the lesson's documents, in each of its languages: the report of the reference solution must have no gaps, ??,
/// marks of solutions or more pages than its template allows; the student's copy must run, submit no answer, report no
/// value, and have a report.
LessonFaults faults_of_documents(const Lesson& lesson);

}  // namespace dynlab::inline course
