#include "course/grading/feedback.h"

#include <fmt/format.h>

#include <cctype>
#include <string_view>

#include "documents/run_record.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// A list item, its texts made harmless by `escape`.
std::string item_of(const CheckGrade& check, std::string (*escape)(const std::string&)) {
    std::string item =
        fmt::format("- **{}** – {}", escape(check.about),
                    check.graded ? fmt::format("{} of {}", points_text(check.earned), points_text(check.points))
                                 : "not graded yet");
    if (check.visible && !check.message.empty()) item += "\\\n  " + escape(check.message);
    if (check.earned < check.points && check.graded && !check.hint.empty())
        item += "\\\n  *" + escape(check.hint) + "*";
    return item + "\n";
}

std::string trouble_of(const Grade& grade, std::string (*escape)(const std::string&)) {
    if (grade.trouble.empty())
        return grade.silent ? "Your script ran to its end but gave no answer." : "Your script ran to its end.";
    if (grade.unreadable) return "**Your work could not be read, so it has no marks yet:** " + escape(grade.trouble);
    if (!grade.began) return "**Your script could not be begun:** " + escape(grade.trouble);
    return "**Your script did not run to its end:** " + escape(grade.trouble);
}

std::string lateness_of(const Grade& grade) {
    if (!(grade.penalty > 0)) return "";
    return fmt::format("It was late, which costs {} points: {}.", points_text(grade.penalty), grade.lateness);
}

std::string markdown_of(const Grade& grade) {
    std::string text =
        fmt::format("# Feedback\n\n**{}**, lesson {}: **{} of {} points.** {}\n\n{}\n\n## Checks\n\n",
                    readable_markdown(grade.submission), readable_markdown(grade.lesson), points_text(grade.earned()),
                    points_text(grade.possible()), lateness_of(grade), trouble_of(grade, readable_markdown));
    for (const CheckGrade& check : grade.checks) text += item_of(check, readable_markdown);
    return text;
}

RunRecord feedback_record(const Grade& grade) {
    RunRecord record;
    record.script = "feedback";
    const auto value = [&record](const char* name, const std::string& text) { record.values[name] = {{}, text}; };
    value("submission", grade.submission);
    value("lesson", grade.lesson);
    value("points", points_text(grade.earned()));
    value("possible", points_text(grade.possible()));
    value("lateness", lateness_of(grade));
    std::string items;
    for (const CheckGrade& check : grade.checks) items += item_of(check, escaped_markdown);
    record.texts["checks"] = {items};
    record.texts["trouble"] = {trouble_of(grade, escaped_markdown)};
    return record;
}

}  // namespace

std::string points_text(double points) {
    std::string text = fmt::format("{:.2f}", points);
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
    return text;
}

std::string readable_markdown(const std::string& text) {
    constexpr std::string_view kMeaningful = "\\`*_{}[]<>#|$~^";
    std::string result;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (kMeaningful.find(c) != std::string_view::npos) result += '\\';
        result += byte < 0x20 || byte == 0x7F ? ' ' : c;
    }
    return result;
}

std::string escaped_markdown(const std::string& text) {
    constexpr std::string_view kHarmless = ",.:;%?!'\"()/";
    std::string result;
    // Documents refuse a word {=latex} wherever it stands, as it marks raw output.
    for (const char c : replaced(text, "{=", "{ =")) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7F) {
            result += ' ';
            continue;
        }
        // Character references: a backslash before = and others would be taken for TeX.
        if (byte < 0x80 && std::ispunct(byte) && kHarmless.find(c) == std::string_view::npos)
            result += fmt::format("&#{};", byte);
        else
            result += c;
    }
    return result;
}

void write_feedback(const Grade& grade, const fs::path& folder, const BoxedDocuments* documents) {
    write_file_atomically(folder / "feedback.md", markdown_of(grade));
    if (documents) documents->make("feedback.md", feedback_record(grade), folder / "feedback.pdf");
}

}  // namespace dynlab::inline course
