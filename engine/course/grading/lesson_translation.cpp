#include "course/grading/lesson_translation.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>

#include "base/catalog.h"
#include "documents/percent_script.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

std::string tasks_to_translate(const Lesson& lesson, const std::string& language) {
    const PercentScript script = read_percent_script(lesson.script());
    std::string text = "-- ---\n-- title: " + script.header.title + "\n";
    if (!script.header.subtitle.empty()) text += "-- subtitle: " + script.header.subtitle + "\n";
    text += "-- language: " + language + "\n-- ---\n";
    for (const Cell& cell : script.cells) {
        if (cell.kind != Cell::Kind::kText) continue;
        text += "\n-- %% [markdown]\n";
        for (const std::string& line : lines_of(cell.content)) text += line.empty() ? "--\n" : "-- " + line + "\n";
    }
    return text;
}

std::string words_to_translate(const Lesson& lesson, const std::string& language) {
    const fs::path file = lesson.checks_in(language);
    std::string text = fs::exists(file) ? read_text(file)
                                        : fmt::format(
                                              "msgid \"\"\nmsgstr \"\"\n\"Language: {}\\n\"\n\"Content-Type: "
                                              "text/plain; charset=UTF-8\\n\"\n",
                                              language);
    const Catalog catalog(text);
    for (const std::string& sentence : sentences_of_checks(read_text(lesson.folder / "checks.lua"))) {
        const std::string id = fmt::format("msgid \"{}\"\n", replaced(sentence, "\"", "\\\""));
        if (catalog.translation(sentence).empty() && text.find(id) == std::string::npos)
            text += "\n" + id + "msgstr \"\"\n";
    }
    return text;
}

}  // namespace

std::vector<std::string> sentences_of_checks(const std::string& source) {
    static const RE2 kSentence(R"re((?:\b(?:say|hint|about|message)\s*=\s*|judge\()"((?:[^"\\]|\\.)*)")re");
    std::vector<std::string> sentences;
    std::string sentence;
    for (re2::StringPiece rest = source; RE2::FindAndConsume(&rest, kSentence, &sentence);) {
        const std::string text = replaced(sentence, "\\\"", "\"");
        if (std::ranges::find(sentences, text) == sentences.end()) sentences.push_back(text);
    }
    return sentences;
}

std::vector<fs::path> write_translation_skeleton(const Lesson& lesson, const std::string& language) {
    std::vector<fs::path> written;
    const auto write = [&](const fs::path& file, const std::string& text) {
        if (fs::exists(file) && read_text(file) == text) return;
        write_file_atomically(file, text);
        written.push_back(file);
    };
    if (!fs::exists(lesson.tasks(language))) write(lesson.tasks(language), tasks_to_translate(lesson, language));
    if (fs::exists(lesson.folder / "checks.lua"))
        write(lesson.checks_in(language), words_to_translate(lesson, language));
    return written;
}

}  // namespace dynlab::inline course
