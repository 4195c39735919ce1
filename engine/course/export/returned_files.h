#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "course/store/assignments.h"

namespace dynlab::inline course {

struct ReturnRequest {
    std::filesystem::path folder;          ///< to be made
    bool moodle = false;                   ///< also as Moodle's zip of feedback files
    std::filesystem::path worksheet = {};  ///< Moodle's grading worksheet, for the participants' numbers; may be empty
    bool all = false;                      ///< also what was returned before
    Instant now = 0;
};

struct ReturnOutcome {
    std::map<std::string, std::vector<std::string>> files;  ///< by group: names of the files that are new for it
    std::vector<std::string> without_mail;                  ///< groups of whose members no address is known
    std::vector<std::string> without_number;                ///< ids of students whose number in Moodle is not known
    std::int64_t other_numbers = 0;  ///< students whose number in the roster is another one: of another assignment
};

/// Writes the files that groups have not received yet into a new folder: copies to review, reviews, receipts.
///
///     FOLDER/GROUP/NAME   the files
///     FOLDER/mail.csv     one row per student, see mailing_list
///     FOLDER/moodle.zip   for each student, if requested, see MoodleFeedback
///
/// The participant number of a student comes from the worksheet, else from the names of the files received for this
/// assignment, else from the roster. A number that is known to belong to another assignment is not used. A file that
/// replaces an older version counts as new. The course database logs the returned files.
/// Throws InvalidArgument if the folder exists.
ReturnOutcome return_files(Course& course, const Assignment& assignment, const ReturnRequest& request);

/// Participant numbers of this assignment by student: from `table` if it is Moodle's worksheet, otherwise from the
/// names of the received files.
std::map<std::string, std::string> participants_for(Course& course, const Assignment& assignment,
                                                    const std::filesystem::path& table);

}  // namespace dynlab::inline course
