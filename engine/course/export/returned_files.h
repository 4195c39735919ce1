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

/// Lays what groups are to get and have not got yet into a new folder: copies to review, reviews, receipts.
///
///     FOLDER/GROUP/NAME   the files
///     FOLDER/mail.csv     a row a student, see mailing_list
///     FOLDER/moodle.zip   for each student, if wanted, see MoodleFeedback
///
/// Participants have the number in the worksheet, else the one in the names of what was received for this assignment,
/// else the roster's, unless one of these is known to be of another assignment.
/// What another version replaced is new again. The store remembers what was returned. Throws InvalidArgument where the
/// folder is not new.
ReturnOutcome return_files(Course& course, const Assignment& assignment, const ReturnRequest& request);

/// Numbers of participants in this assignment, by student: those in `table`, where that is Moodle's worksheet, else
/// those in the names of what was received.
std::map<std::string, std::string> participants_for(Course& course, const Assignment& assignment,
                                                    const std::filesystem::path& table);

}  // namespace dynlab::inline course
