#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline course {

/// What goes back to students and platforms from a folder of marks.
struct HandBackRequest {
    std::filesystem::path marks;                  ///< the OUT of dynlab grade
    std::string assignment;                       ///< its column in Canvas's gradebook, such as "Lab 4 (1234)"
    std::optional<std::filesystem::path> roster;  ///< for addresses and the platforms' numbers
};

struct HandedBack {
    std::vector<std::filesystem::path> files;
    std::vector<Message> complaints;  ///< who could not be entered, in whole sentences
    std::vector<Message> unwritten;   ///< platforms whose files are not there, and why, in whole sentences
};

/// Writes into `marks`/handed_back, from gradebook.csv and the feedback in `marks`:
///
/// * moodle-grades.csv, a grading worksheet with what Moodle's import wants (Identifier, Grade, Last modified (grade)),
///   the names, the maximum and comments, in the language of the feedback; moodle-feedback.zip, see MoodleFeedback. The
///   number of a participant is the roster's, or the one in the name of the submission's folder.
/// * canvas-grades.csv: Student, ID, SIS User ID (the roster's id), SIS Login ID (its mail), Section, the assignment.
/// * mail.csv, see mailing_list, with points, possible and sha256 (of the feedback) besides; new is what changed since
///   the last time.
///
/// Where dynlab grade --answers left model answers in `marks`, everybody with feedback gets them as well.
/// Who has no marks is left out, and so is a platform that nobody has a number of; where that leaves none, everybody
/// with marks could not be entered. Throws EnvironmentError where there
/// is no gradebook.csv, or one of another kind.
HandedBack hand_back(const HandBackRequest& request);

}  // namespace dynlab::inline course
