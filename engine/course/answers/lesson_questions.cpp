#include "course/answers/lesson_questions.h"

#include <algorithm>

#include "base/reader.h"
#include "documents/document_rules.h"
#include "documents/text_lines.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "platform/text/read_number.h"
#include "workflow/student_copy.h"

namespace dynlab::inline course {
namespace {

QuestionName question_named(const std::string& text, const Lesson& lesson) {
    QuestionName question;
    std::string number = text;
    if (number.starts_with("q") || number.starts_with("Q")) number.erase(0, 1);
    if (const auto given = read_number<int>(number); given && *given > 0) {
        question.number = *given;
        return question;
    }
    question.titles = {folded_title(text)};
    for (const char* language : {"en", "fr"})
        if (std::filesystem::exists(lesson.report(language)))
            for (const SectionRule& section : document_rules(read_template(lesson.report(language))).sections)
                if (question.titles.contains(folded_title(section.english)) ||
                    question.titles.contains(folded_title(section.french)))
                    question.titles.insert({folded_title(section.english), folded_title(section.french)});
    return question;
}

}  // namespace

LessonQuestions::LessonQuestions(const Lesson& lesson) : lesson_(lesson) {
    const TemporaryFolder work;
    for (const std::string language : {"", "fr"}) {
        if (!language.empty() && !std::filesystem::exists(lesson.tasks(language))) continue;
        const std::filesystem::path copy = work.path() / ("copy" + language);
        make_student_copy(lesson, copy, {}, language);
        const std::vector<TextPart> parts = text_parts_in(copy);
        given_.add(parts);
        if (starter_.empty()) starter_ = parts;
    }
}

QuestionName LessonQuestions::question(const std::string& text) const {
    QuestionName question = question_named(text, lesson_);
    if (question.number > 0
            ? given_.questions().contains(question.number)
            : std::ranges::any_of(question.titles, [&](const std::string& title) { return given_.has_heading(title); }))
        return question;
    std::vector<std::string> known;
    for (const int number : given_.questions()) known.push_back(std::to_string(number));
    if (question.number == 0 || known.empty()) {
        known.clear();
        for (const std::string& heading : given_.headings()) known.push_back("\"" + folded_title(heading) + "\"");
    }
    throw EnvironmentError("{} has no question \"{}\"; the questions are {}", lesson_.slug, text, listed(known));
}

AskedQuestion LessonQuestions::asked(const QuestionName& question) const {
    return {written_answer(starter_, question, GivenText()),
            written_answer(text_parts_of_script(text_of_source(lesson_.script())), question, given_)};
}

std::vector<TextPart> text_parts_in(const std::filesystem::path& folder) {
    std::vector<TextPart> parts;
    if (std::filesystem::is_regular_file(folder / "analysis.lua"))
        parts = text_parts_of_script(text_of_source(folder / "analysis.lua"));
    if (std::filesystem::is_regular_file(folder / "report.md"))
        for (TextPart& part : text_parts_of_report(text_of_source(folder / "report.md")))
            parts.push_back(std::move(part));
    return parts;
}

}  // namespace dynlab::inline course
