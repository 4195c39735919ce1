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
    std::optional<std::filesystem::path> roster;     ///< for addresses and numbers; default: stored in `marks`
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
/// * moodle-grades.csv: the worksheet with marks and comments filled in (export/platform_sheet.h). Without a worksheet,
///   a table of the columns that Moodle imports (Identifier, Grade, Last modified (grade)), the names, the maximum and
///   comments; comments are in the language of the feedback. moodle-feedback.zip, see MoodleFeedback, contains the
///   feedback that is not delivered yet, also of submissions that cannot be read and have no marks.
/// * canvas-grades.csv: the gradebook with the marks filled in. Without one, Student, ID, SIS User ID (the roster's
///   id), SIS Login ID (the roster's mail), Section, and the assignment.
/// * mail.csv, see mailing_list, with the additional columns points, possible and sha256 (of the feedback); new means
///   not delivered yet.
///
/// Moodle numbers participants for each assignment. The numbers come from the worksheet, else from the names of the
/// submissions' folders, else from the roster. If a folder contradicts the roster, the roster's numbers belong to
/// another assignment, and none of them is used.
///
/// If dynlab grade --answers left model answers in `marks`, every student with feedback gets them as well. A student
/// without marks gets no grade, and a platform without any participant number gets no file. If no file remains, the
/// result lists all students with marks as not entered. Throws EnvironmentError if there is no gradebook.csv, or if it
/// has another format.
GradeExport write_grade_export(const GradeExportRequest& request);

/// Marks the feedback listed in `marks`/handed_back/mail.csv as delivered, so that it is no longer new. Returns the
/// number of files that were new. Throws EnvironmentError if no export exists yet.
std::int64_t log_delivery(const std::filesystem::path& marks);

}  // namespace dynlab::inline course
