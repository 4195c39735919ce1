#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "course/grading/grading.h"
#include "platform/locks/file_lock.h"
#include "workflow/parts/part.h"

namespace dynlab::inline course {

struct GradingOutcome {
    int submissions = 0, made = 0, kept = 0, not_whole = 0;  ///< not_whole: a check is left ungraded
    int unowned = 0, unreadable = 0;
    int failed = 0;                   ///< could not be graded now, through no doing of the student
    std::vector<Message> complaints;  ///< whole sentences for the instructor
    int unconfirmed = 0;              ///< penalties that wait for the instructor
    std::vector<Message> late;        ///< a clause for each late submission, with what it costs
    std::vector<Message> notes;       ///< of the time that is given
    std::vector<Message> attention;   ///< what needs attention, a sentence each, as in the summary
};

/// One run at a time works in a folder of results, which is made. Throws EnvironmentError where another does.
FileLock lock_results(const std::filesystem::path& out);

/// The rules of a class, tested on the reference solution of the lesson.
struct EvaluatedRules {
    /// Throws EnvironmentError: isolation that this machine does not have, checks that cannot be read, and results of
    /// another lesson in the folder.
    explicit EvaluatedRules(const GradingOptions& options);

    GradingRules rules;
    std::vector<Message> complaints;  ///< of checks that the reference solution fails: they are left ungraded
    std::optional<Message> note;      ///< that there is little time
};

/// Grades one part of the chosen submissions, and writes nothing that is of the whole class. Several parts may be
/// graded at a time, on several machines.
GradingOutcome grade_part_of_class(const ClassWork& work, const WorkPart& part, const EvaluatedRules& evaluated,
                                   const GradingOptions& options);
/// Of so many parts those in which a chosen submission has no result of these files, rules and program.
MissingParts ungraded_parts(const ClassWork& work, int parts, const EvaluatedRules& evaluated,
                            const GradingOptions& options);

/// Grades a class. Files in `options.out`: results/NAME/ with results.json and feedback.md and .pdf for each
/// submission, logs/NAME/log.txt, which may quote hidden data sets, gradebook.csv, summary.md or .pdf, marks.csv. Each
/// submission is graded in its own sandbox, by `setup.jobs` threads. A result whose inputs are unchanged is kept, so
/// that an interrupted run resumes where it stopped. Marks depend on neither the order nor the threads. The caller
/// holds the lock of the folder. Throws Interrupted after Ctrl-C.
/// `count`: called once, when the results of all submissions are written, for the marks of `work.students`.
GradingOutcome grade_class(const ClassWork& work, const EvaluatedRules& evaluated, const GradingOptions& options,
                           const std::function<std::vector<CountedMark>()>& count);

}  // namespace dynlab::inline course
