#include "course/grading/feedback.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <variant>

#include "base/languages.h"
#include "course/issues/lesson_reader.h"
#include "documents/run_record.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/hash.h"
#include "platform/program_identity.h"
#include "platform/program_lookup.h"
#include "platform/text/plain_words.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kTemplate[] = "feedback.md";

using Escape = std::string (*)(const std::string&);

/// The feedback of one submission in its language; texts of others are made harmless by `escape`.
class FeedbackText {
  public:
    FeedbackText(const Grade& grade, Escape escape)
        : grade_(grade), reader_(grade.language, grade.lesson), escape_(escape) {}

    std::string heading() const { return words(Message("Feedback for {}", escape_(title()))); }
    std::string title() const { return printable(grade_.title.empty() ? grade_.submission : grade_.title); }
    std::string checks_heading() const { return words(Message("Checks")); }

    std::string result() const {
        if (grade_.without_marks()) return words(Message("Lesson {}: **no marks yet.**", escape_(grade_.lesson)));
        std::string text = words(Message("Lesson {}: **{} of {} points.**", escape_(grade_.lesson),
                                         points_number(grade_.earned()), points_number(grade_.possible())));
        if (grade_.whole_mark)
            text +=
                " " + words(Message("Marked as a whole by your instructor: {}", escaped(words(grade_.whole_reason))));
        if (grade_.penalty > 0)
            text += " " + words(Message("Your submission was late. Points deducted: {} ({}).",
                                        points_number(grade_.penalty), grade_.lateness));
        const std::string other = escape_(grade_.counts_instead);
        if (!other.empty())
            text += "\n\n" + words(grade_.newest_counts ? Message("**This submission does not count.** Of your "
                                                                  "submissions, the newest submission counts: {}.",
                                                                  other)
                                                        : Message("**This submission does not count.** Of your "
                                                                  "submissions, the best submission counts: {}.",
                                                                  other));
        return text;
    }

    std::string error_reason() const {
        if (grade_.error_reason.empty())
            return words(grade_.silent ? Message("Your script ran to completion but submitted no answer.")
                                       : Message("Your script ran to completion."));
        const std::string why = error_text();
        if (grade_.unreadable && grade_.whole())
            return words(
                Message("**The program could not read your work, so your instructor marked it manually:** {}", why));
        return words(grade_.unreadable ? Message("**Your work could not be read, so it has no marks yet:** {}", why)
                     : grade_.began    ? Message("**Your script stopped with an error:** {}", why)
                                       : Message("**Your script could not be started:** {}", why));
    }

    std::string checks() const {
        std::string items;
        for (const CheckGrade& check : grade_.checks) items += item_of(check);
        return items;
    }

    std::string closing() const {
        return words(
            Message("Points are awarded automatically. dynlab checks your answers for your data and for data sets that "
                    "you have not seen. If you think that a check is wrong, contact your instructor and explain why."));
    }

  private:
    std::string words(const Message& message) const { return reader_.text(message); }

    /// A list item.
    std::string item_of(const CheckGrade& check) const {
        std::string item =
            fmt::format("- **{}** – {}", escaped(words(check.about)),
                        words(check.graded ? points_of(check.earned, check.points) : Message("not graded yet")));
        if (check.visible && !check.message.empty()) item += "\\\n  " + escaped(words(check.message));
        if (check.earned < check.points && check.graded && !check.hint.empty())
            item += "\\\n  *" + escaped(words(check.hint)) + "*";
        return item + "\n";
    }

    /// In French, a space comes before a colon, which is none of "analysis.lua:3": as code the place stays as it is.
    std::string error_text() const {
        static const RE2 kPlace(R"(([\w.-]+\.lua:\d+): )", RE2::Latin1);
        const Message& error_reason = grade_.error_reason;
        const bool placed = error_reason.arguments().size() == 2;
        const auto* const first = placed ? std::get_if<std::string>(&error_reason.arguments()[0]) : nullptr;
        const auto* const sentence = placed ? std::get_if<MessageList>(&error_reason.arguments()[1]) : nullptr;
        std::string place;
        if (reader_.reader().catalog == nullptr || first == nullptr || sentence == nullptr ||
            !RE2::FullMatch(*first, kPlace, &place))
            return escaped(words(error_reason));
        return "`" + place + "`: " + escaped(words(Message("{}", *sentence)));
    }

    /// Quotation marks stay straight on paper: hints quote code.
    std::string escaped(const std::string& text) const {
        return escape_ == escaped_markdown ? replaced(escape_(text), "\"", "&#34;") : escape_(text);
    }

    const Grade& grade_;
    LessonReader reader_;
    Escape escape_;
};

RunRecord feedback_record(const FeedbackText& text) {
    RunRecord record;
    record.script = "feedback";
    record.texts["result"] = {text.result()};
    record.texts["checks"] = {text.checks()};
    record.texts["trouble"] = {text.error_reason()};
    record.texts["closing"] = {text.closing()};
    return record;
}

/// A line for all that the PDF is made from, the same text in another form among it, and one for the PDF itself.
std::string text_and_document(const std::string& markdown, const fs::path& pdf) {
    const std::string layout = digest_of_folder(shared_folder() / "report_templates").hex();
    return fmt::format("{}\n{}\n", sha256_of(program_identity() + "\n" + layout + "\n" + markdown),
                       sha256_of_file(pdf));
}

}  // namespace

Number points_number(double points) {
    const std::string text = fmt::format("{:.2f}", points);
    return decimals(points, text.ends_with("00") ? 0 : text.ends_with('0') ? 1 : 2);
}

std::string points_text(double points) {
    return number_text(points_number(points));
}

Message points_of(double earned, double possible) {
    return Message("{} of {}", points_number(earned), points_number(possible));
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
    // Documents refuse the text {=latex} at any position, as it marks raw output.
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

std::string feedback_markdown(const Grade& grade) {
    const FeedbackText text(grade, readable_markdown);
    return fmt::format("# {}\n\n{}\n\n{}\n\n## {}\n\n{}\n{}\n", text.heading(), text.result(), text.error_reason(),
                       text.checks_heading(), text.checks(), text.closing());
}

void set_feedback(const Grade& grade, const fs::path& pdf, const fs::path& made, const SandboxedDocuments* documents) {
    const std::string markdown = feedback_markdown(grade);
    if (fs::exists(pdf) && fs::exists(made) && read_file(made) == text_and_document(markdown, pdf)) return;
    fs::remove(pdf);
    if (!documents) return;
    const FeedbackText text(grade, escaped_markdown);
    documents->make(
        kTemplate, feedback_record(text), pdf,
        {{"title", text.heading()}, {"lang", catalog_of(grade.language) == nullptr ? "en" : grade.language}});
    fs::create_directories(made.parent_path());
    write_file_atomically(made, text_and_document(markdown, pdf));
}

}  // namespace dynlab::inline course
