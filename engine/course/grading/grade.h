#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline course {

/// What one check gave a submission.
struct CheckGrade {
    std::string id;
    Message about, hint;  ///< as the author of the checks wrote them
    Message message;
    double points = 0, earned = 0;
    bool visible = true;   ///< the student may see the message
    bool graded = true;    ///< false: the check itself is broken, or could not be run
    bool by_hand = false;  ///< the instructor marks it, in marks.csv, by the rubric
    std::string rubric = {};
    Message for_instructor = {};  ///< text with details of hidden data sets; not part of the result
};

/// A submission's result.
struct Grade {
    std::string submission, lesson, isolation;
    std::string fingerprint;  ///< of all that it depends on: an equal one need not be made again
    Message error_reason;     ///< why the script did not run to its end, in a sentence for the student
    bool unreadable = false;  ///< nothing could be run, as `error_reason` says: no marks, which is not the mark 0
    bool began = true;        ///< false where the script could not even be begun
    bool silent = false;      ///< the script gave no answer at all
    Message remark;           ///< for the instructor: which version was taken
    std::string printed;      ///< end of what the script printed
    std::vector<CheckGrade> checks;
    double late_hours = 0, penalty = 0;  ///< penalty in points
    Message lateness;                    ///< why there is a penalty, as Deadlines says
    std::string title;                   ///< whom the feedback is for: a group or a person
    std::string language;                ///< of the feedback; English where it has no catalog
    std::string counts_instead;          ///< the submission of the same owner that counts; empty if this one does
    bool newest_counts = false;          ///< ... as it is the newest; else as it is the better one
    std::optional<double> whole_mark;    ///< the instructor's mark for the whole submission: it replaces all points
    Message whole_reason;                ///< of that mark, for the student
    std::string log;                     ///< what was run and how long it took; not part of the result

    /// Of graded checks, less the penalty, not below 0; or the mark for the whole, from which nothing is taken off.
    double earned() const;
    double possible() const;  ///< of graded checks; of all where the whole is marked
    bool whole() const;       ///< every check is graded, or the whole is marked
    bool without_marks() const { return unreadable && !whole(); }  ///< until the instructor gives them by hand
};

/// Gradescope's results.json of `marked`, which is `grade` with the instructor's own marks. extra_data contains `grade`
/// itself and the fields that the format lacks. The messages of hidden checks appear nowhere.
std::string to_results_json(const Grade& grade, const Grade& marked);
/// The `grade` of that text. Throws EnvironmentError for a text that to_results_json did not make.
Grade from_results_json(const std::string& text);

/// What that text shows of one check of `marked`.
struct ShownResult {
    Message about;
    Message output;  ///< what the check said, and its hint where points are missing; may be empty text
    double points = 0, earned = 0;
};
/// Throws as from_results_json.
std::vector<ShownResult> shown_results(const std::string& text);

}  // namespace dynlab::inline course
