#include "cli/course/grading_report.h"

#include <fmt/format.h>

#include <iostream>

#include "base/reader.h"
#include "cli/commands.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

std::string attention_text(const GradingOutcome& outcome) {
    if (outcome.attention.empty()) return "";
    std::string text = message_text(plural(static_cast<std::int64_t>(outcome.attention.size()),
                                           "{} note needs attention:", "{} notes need attention:")) +
                       "\n";
    for (const Message& sentence : outcome.attention) text += "  " + terminal_text(message_text(sentence)) + "\n";
    return text;
}

std::string late_text(const GradingOutcome& outcome) {
    if (outcome.late.empty()) return "";
    std::string text =
        message_text(plural(static_cast<std::int64_t>(outcome.late.size()), "{} late:", "{} late:")) + "\n";
    for (const Message& clause : outcome.late) text += "  " + terminal_text(message_text(clause)) + "\n";
    return text;
}

}  // namespace

void show_complaints(const GradingOutcome& outcome) {
    for (const Message& note : outcome.notes)
        std::cerr << "dynlab: note: " << terminal_text(message_text(note)) << '\n';
    for (const Message& complaint : outcome.complaints)
        std::cerr << "dynlab: " << terminal_text(message_text(complaint)) << '\n';
}

int show_grading(const GradingOutcome& outcome, Isolation isolation, const std::filesystem::path& out, bool pdf) {
    show_complaints(outcome);
    std::cout << fmt::format("{}: {} graded now, {} unchanged{}; isolation {}\n",
                             message_text(plural(outcome.submissions, "{} submission", "{} submissions")), outcome.made,
                             outcome.kept,
                             outcome.not_whole > 0 ? fmt::format(", {} with ungraded checks", outcome.not_whole) : "",
                             isolation_name(isolation))
              << late_text(outcome) << attention_text(outcome) << (out / "gradebook.csv").string() << '\n'
              << (out / (pdf ? "summary.pdf" : "summary.md")).string() << '\n';
    const bool all_is_graded = outcome.not_whole + outcome.unreadable + outcome.unowned + outcome.unconfirmed == 0;
    return all_is_graded && outcome.complaints.empty() ? kDone : kFailed;
}

}  // namespace dynlab::inline cli
