#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline course {

/// What goes back to students and platforms from a folder of marks.
struct GradeExportRequest {
    std::filesystem::path marks;                     ///< the OUT of dynlab grade
    std::string assignment;                          ///< its column in Canvas's gradebook, such as "Lab 4 (1234)"
    std::optional<std::filesystem::path> roster;     ///< for addresses and the platforms' numbers
    std::optional<std::filesystem::path> worksheet;  ///< as downloaded from Moodle or Canvas, to be filled in
    bool all = false;                                ///< feedback that was delivered before goes into the zip, too
};

struct GradeExport {
    std::vector<std::filesystem::path> files;
    std::vector<Message> notes;       ///< whole sentences
    std::vector<Message> complaints;  ///< who could not be entered, in whole sentences
    std::vector<Message> unwritten;   ///< platforms whose files are not there, and why, in whole sentences
};

/// Writes into `marks`/handed_back, from gradebook.csv and the feedback in `marks`:
///
/// * moodle-grades.csv: the worksheet with marks and comments filled in (export/platform_sheet.h), or without one a
///   table of what Moodle's import wants (Identifier, Grade, Last modified (grade)), the names, the maximum and
///   comments; comments are in the language of the feedback. moodle-feedback.zip, see MoodleFeedback, has the feedback
///   that was not delivered yet, also of submissions that cannot be read and have no marks.
/// * canvas-grades.csv: the gradebook with the marks filled in, or without one Student, ID, SIS User ID (the roster's
///   id), SIS Login ID (its mail), Section, the assignment.
/// * mail.csv, see mailing_list, with points, possible and sha256 (of the feedback) besides; new is what was not
///   delivered yet.
///
/// Moodle numbers participants for each assignment. Their numbers are those of the worksheet, else those in the names
/// of the submissions' folders, else the roster's; where a folder contradicts the roster, the roster's are of another
/// assignment, and none of them is used.
///
/// Where dynlab grade --answers left model answers in `marks`, everybody with feedback gets them as well.
/// Who has no marks has no grade, and a platform that nobody has a number of no file; where that leaves none, everybody
/// with marks could not be entered. Throws EnvironmentError where there is no gradebook.csv, or one of another kind.
GradeExport write_grade_export(const GradeExportRequest& request);

/// Records that the feedback listed in `marks`/handed_back/mail.csv was delivered: it is not new any more. Returns how
/// many files were new. Throws EnvironmentError where nothing was written yet.
std::int64_t record_delivery(const std::filesystem::path& marks);

}  // namespace dynlab::inline course
