#pragma once
#include <string>
#include <vector>

#include "course/grading/check_trial.h"

namespace dynlab::inline course {

/// Something in a lesson that must not stand before a class, with its file in the lesson's folder.
struct LessonFault {
    std::string file;
    int line = 0;  ///< 0: the whole file
    Message what;
};
using LessonFaults = std::vector<LessonFault>;

/// What its files say: headers, cells, marks of solutions, Lua that cannot be read, names and options that nobody
/// knows, hints, tasks and reports in other languages that do not fit, tasks that do not say their language, sentences
/// of the checks that are not translated, an answer that is never handed in. Nothing is run.
LessonFaults faults_of_texts(const Lesson& lesson);

/// What its checks give: the worked solution wants full marks, the untouched starter none; each wrong_*.lua has to fail
/// those checks that its lines "-- expects: CHECK: part of the message" name, with these words, and no other;
/// right_*.lua none. `warnings` gets those of giveaways_of. Throws as try_checks_of.
LessonFaults faults_of_checks(const GradingSetup& setup, LessonFaults* warnings = nullptr);
LessonFaults faults_of_checks(const Lesson& lesson, const CheckTrial& trial);  ///< of checks that were tried

/// Checks that students can read and that a number from them passes, typed in as the answer.
LessonFaults giveaways_of(const CheckTrial& trial);

/// What its documents look like, in each language it has: the report of the worked solution without gaps, ??, marks of
/// solutions or more pages than its template allows; the student's copy, which runs, hands no answer in, reports no
/// value, and has a report.
LessonFaults faults_of_documents(const Lesson& lesson);

}  // namespace dynlab::inline course
