#include "course/grading/feedback.h"

#include <fmt/format.h>

#include <cctype>
#include <nlohmann/json.hpp>
#include <string_view>

#include "documents/run_record.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A list item, its texts made harmless by `escape`.
std::string item_of(const json& check, std::string (*escape)(const std::string&)) {
    const bool graded = check.at("graded");
    const double points = check.at("points"), earned = check.at("earned");
    const std::string message = check.at("visible").get<bool>() ? check.at("message") : json("");
    const std::string hint = check.at("hint");
    std::string item =
        fmt::format("- **{}** – {}", escape(check.at("about")),
                    graded ? fmt::format("{} of {}", points_text(earned), points_text(points)) : "not graded yet");
    if (!message.empty()) item += "\\\n  " + escape(message);
    if (earned < points && graded && !hint.empty()) item += "\\\n  *" + escape(hint) + "*";
    return item + "\n";
}

std::string trouble_of(const json& grade, std::string (*escape)(const std::string&)) {
    const std::string trouble = grade.at("trouble");
    if (trouble.empty()) return "Your script ran to its end.";
    return "**Your script did not run to its end:** " + escape(trouble);
}

/// For readers of the Markdown itself: only what would change its meaning is escaped.
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

std::string markdown_of(const json& grade) {
    std::string text = fmt::format("# Feedback\n\n**{}**, lesson {}: **{} of {} points.** {}\n\n{}\n\n## Checks\n\n",
                                   readable_markdown(grade.at("submission")), readable_markdown(grade.at("lesson")),
                                   grade.at("points").get<std::string>(), grade.at("possible").get<std::string>(),
                                   grade.at("lateness").get<std::string>(), trouble_of(grade, readable_markdown));
    for (const json& check : grade.at("checks")) text += item_of(check, readable_markdown);
    return text;
}

RunRecord feedback_record(const json& grade) {
    RunRecord record;
    record.script = "feedback";
    for (const char* name : {"submission", "lesson", "points", "possible", "lateness"})
        record.values[name] = {{}, grade.at(name)};
    std::string items;
    for (const json& check : grade.at("checks")) items += item_of(check, escaped_markdown);
    record.texts["checks"] = {items};
    record.texts["trouble"] = {trouble_of(grade, escaped_markdown)};
    return record;
}

json json_of(const Grade& grade) {
    json j = {{"submission", grade.submission},
              {"lesson", grade.lesson},
              {"points", points_text(grade.earned())},
              {"possible", points_text(grade.possible())},
              {"lateness", grade.penalty > 0 ? fmt::format("It came {:.1f} hours late, which costs {} points.",
                                                           grade.late_hours, points_text(grade.penalty))
                                             : ""},
              {"trouble", grade.trouble},
              {"checks", json::array()}};
    for (const CheckGrade& check : grade.checks)
        j["checks"].push_back({{"about", check.about},
                               {"hint", check.hint},
                               {"message", check.message},
                               {"points", check.points},
                               {"earned", check.earned},
                               {"visible", check.visible},
                               {"graded", check.graded}});
    return j;
}

}  // namespace

std::string points_text(double points) {
    std::string text = fmt::format("{:.2f}", points);
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
    return text;
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
    const json text = json_of(grade);
    write_file_atomically(folder / "feedback.md", markdown_of(text));
    if (documents) documents->make("feedback.md", feedback_record(text), folder / "feedback.pdf");
}

}  // namespace dynlab::inline course
