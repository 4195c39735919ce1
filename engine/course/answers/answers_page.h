#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "course/intake/roster.h"
#include "platform/sandbox.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline course {

struct AnswersRequest {
    Lesson lesson;
    std::filesystem::path submissions;  ///< a folder or a platform's zip, as ClassSubmissions takes them
    std::filesystem::path out;          ///< folder, made where there is none
    std::string question;               ///< its number, or the title of a section of the report
    std::string check;                  ///< to which marks belong, for the column check. Default: "q3" for question 3
    std::vector<Student> roster;        ///< whose names and ids are replaced
    Isolation isolation = Isolation::kFull;
    std::filesystem::path program;  ///< dynlab
};

struct AnswersOutcome {
    std::size_t submissions = 0, answers = 0, groups = 0;  ///< groups: of equal or nearly equal answers
    std::vector<Message> complaints;                       ///< sentences: what cannot be read
    std::filesystem::path page, text, marks;               ///< HTML, Markdown, CSV
};

/// Puts all answers to one question on one page, out/answers-q3.html and .md, under numbers that do not follow the
/// names of the submissions; names and ids of the roster become "[name]". Answers that say the same are shown once.
/// out/answers-q3.csv has a row for each submission with its number and empty columns points and reason, to be filled
/// in and copied into marks.csv: a later call keeps its numbers and everything that was filled in. Throws
/// EnvironmentError where the lesson has no such question (the message lists those it has), or the CSV cannot be read.
AnswersOutcome collect_answers(const AnswersRequest& request);

}  // namespace dynlab::inline course
