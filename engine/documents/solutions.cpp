#include "documents/solutions.h"

#include <re2/re2.h>

#include <optional>

#include "base/languages.h"
#include "base/reader.h"
#include "documents/error.h"
#include "documents/percent_script.h"
#include "documents/text_lines.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline documents {
namespace {

constexpr std::string_view kNarrowSpace = "\u202F";

const std::string_view kStarterSign = "STARTER:";

/// The text of a line that is nothing but a comment.
std::optional<std::string> comment_of(std::string_view line) {
    const std::string text = trimmed(line);
    if (!text.starts_with("--")) return std::nullopt;
    return trimmed(std::string_view(text).substr(2));
}

std::string_view indentation_of(std::string_view line) {
    return line.substr(0, line.find_first_not_of(" \t"));
}

std::string_view end_of(std::string_view line) {
    if (line.ends_with("\r\n")) return "\r\n";
    return line.ends_with('\n') ? "\n" : "";
}

/// "local K = 1" of "  -- STARTER: local K = 1", with the line's indentation and end.
std::string starter_text(std::string_view line, bool in_text) {
    std::string text(line.substr(line.find(kStarterSign) + kStarterSign.size()));
    if (text.starts_with(' ')) text.erase(0, 1);
    return std::string(indentation_of(line)) + (in_text ? "-- " : "") + text;
}

/// A copy is in one language: of say("time", "temps") it keeps one text, and the function itself is not the student's.
std::string in_one_language(std::string source, std::string_view language) {
    static const RE2 function(R"((?m)^local function say\(english, french\)\r?\n.*\r?\nend\r?\n)");
    static const RE2 call(R"re(\bsay\(("[^"\\\n]*"),\s*("[^"\\\n]*")\))re");
    if (!RE2::Replace(&source, function, "")) return source;
    RE2::GlobalReplace(&source, call, language == "fr" ? R"(\2)" : R"(\1)");
    return source;
}

}  // namespace

SolutionLine solution_line(std::string_view line, const std::filesystem::path& file, int number) {
    const std::optional<std::string> comment = comment_of(line);
    if (!comment) return SolutionLine::kNone;
    if (*comment == "BEGIN SOLUTION") return SolutionLine::kBegin;
    if (*comment == "END SOLUTION") return SolutionLine::kEnd;
    if (comment->starts_with(kStarterSign)) return SolutionLine::kStarter;
    const std::string lower = in_small_letters(*comment);
    for (const char* marker : {"begin solution", "end solution", "begin the solution", "end of solution"})
        if (lower.starts_with(marker) && lower.size() <= std::string_view(marker).size() + 2)
            throw DocumentError(
                Place{file, number},
                Message("\"{}\" is not a solution marker; write \"-- BEGIN SOLUTION\" or \"-- END SOLUTION\"",
                        trimmed(line)));
    return SolutionLine::kNone;
}

AnswerMarks answer_marks(std::string_view language) {
    const Reader reader{catalog_of(language)};
    std::string text = message_text(Message("Your answer:"), reader);
    for (std::size_t i; (i = text.find(kNarrowSpace)) != std::string::npos;)
        text.replace(i, kNarrowSpace.size(), " ");  // as an editor's space bar types it
    return {"-- " + message_text(Message("YOUR CODE HERE"), reader), "-- *" + text + "*"};
}

std::string without_solutions(const std::string& source, const std::filesystem::path& name, std::string_view language) {
    const AnswerMarks marks = answer_marks(language);
    std::string result;
    int begun = 0;  // line of the open BEGIN SOLUTION, 0 outside
    bool in_text = false, hidden = false;
    bool asked = false;  // the mark of code was the last that was said
    int number = 0;
    const auto fail = [&](int line, const Message& what) { throw DocumentError(Place{name, line}, what); };
    for (std::string_view line : lines_with_ends(source)) {
        ++number;
        if (is_cell_marker(line)) {
            if (begun) fail(begun, Message("this solution is not closed with \"-- END SOLUTION\" in the same cell"));
            in_text = is_text_cell_marker(line);
            asked = asked && !in_text;
            hidden = line.find("echo=false") != std::string_view::npos;
        }
        switch (solution_line(line, name, number)) {
            case SolutionLine::kBegin:
                if (begun)
                    fail(number, Message("a solution starts inside the solution that starts on line {}; close the "
                                         "first solution with \"-- END SOLUTION\"",
                                         begun));
                begun = number;
                if (hidden || (asked && !in_text)) break;
                asked = !in_text;
                result += indentation_of(line);
                result += in_text ? marks.text : marks.code;
                result += end_of(line);
                break;
            case SolutionLine::kEnd:
                if (!begun)
                    fail(number,
                         Message("\"-- END SOLUTION\" needs a \"-- BEGIN SOLUTION\" before it in the same cell"));
                begun = 0;
                break;
            case SolutionLine::kStarter:
                if (!begun)
                    fail(number, Message("\"-- STARTER:\" is outside a solution; move the line between \"-- BEGIN "
                                         "SOLUTION\" and \"-- END SOLUTION\""));
                asked = false;
                result += starter_text(line, in_text);
                break;
            case SolutionLine::kNone:
                if (begun) break;
                asked = asked && (is_cell_marker(line) || is_blank(line));
                result += line;
        }
    }
    if (begun) fail(begun, Message("this solution is not closed with \"-- END SOLUTION\" in the same cell"));
    return in_one_language(std::move(result), language);
}

}  // namespace dynlab::inline documents
