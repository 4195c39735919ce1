#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "course/answers/written_answers.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline course {

/// The lesson's side of a question.
struct AskedQuestion {
    std::string text, solution;  ///< Markdown; may be empty
};

/// What a lesson asks in words, and what it gives to all students.
class LessonQuestions {
  public:
    explicit LessonQuestions(const Lesson& lesson);

    const GivenText& given() const { return given_; }
    /// By its number ("3", "q3"), or the title of a section of the report. Throws EnvironmentError for a question that
    /// the lesson does not have; the message lists those it has.
    QuestionName question(const std::string& text) const;
    AskedQuestion asked(const QuestionName& question) const;

  private:
    Lesson lesson_;
    GivenText given_;
    std::vector<TextPart> starter_;
};

/// The text of analysis.lua and report.md in a folder. A missing file gives no part.
std::vector<TextPart> text_parts_in(const std::filesystem::path& folder);

}  // namespace dynlab::inline course
