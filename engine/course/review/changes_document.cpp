#include <fmt/format.h>

#include <algorithm>

#include "base/reader.h"
#include "course/grading/feedback.h"
#include "course/review/version_changes.h"
#include "course/store/side_by_side.h"
#include "documents/text_lines.h"
#include "platform/terminal/aligned_table.h"
#include "platform/text/plain_words.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kContextWords = 15;  ///< unchanged words around a change
constexpr std::size_t kMaxWordLength =
    30;  ///< characters that fit on a line behind a few words, as wide as they may be
constexpr std::size_t kMaxShownWords = 20'000;
constexpr std::size_t kMaxRows = 60;

std::string percent(const WordDiff& diff) {
    const double share = 100 * diff.share();
    return share > 0 && share < 1 ? "< 1 %" : fmt::format("{:.0f} %", share);
}

/// Without control characters, and no word is wider than the page or cell.
std::string fitted(const std::string& text, std::size_t max_word) {
    std::string result;
    for (const std::string& word : words_between_spaces(text))
        result += (result.empty() ? "" : " ") + printable(word, max_word);
    return result;
}

std::string escaped(const std::string& text) {
    return escaped_markdown(fitted(text, kMaxWordLength));
}

std::string cell(const std::string& text) {
    return fitted(printable(text, 60), 20);
}

/// The text with deleted words struck out and inserted words bold; of long unchanged stretches only the ends.
class MarkedText {
  public:
    std::string markdown(const std::vector<MarkedWords>& pieces) {
        for (std::size_t i = 0; i < pieces.size() && shown_ < kMaxShownWords; ++i) {
            const std::vector<ReportWord>& words = pieces[i].words;
            if (pieces[i].mark != '=') {
                if (i == 0) put_place(words.front());
                put(words, 0, words.size(), pieces[i].mark == '-' ? "~~" : "**");
                continue;
            }
            const bool first = i == 0, last = i + 1 == pieces.size();
            const std::size_t head = first ? 0 : std::min(kContextWords, words.size()),
                              tail = last ? 0 : std::min(kContextWords, words.size() - head);
            const bool shortened = head + tail < words.size();
            put(words, 0, head, "");
            if (shortened && !first) text_ += "…\n\n";
            if (shortened && !last) put_place(words[words.size() - tail]), text_ += "… ";
            put(words, words.size() - tail, words.size(), "");
        }
        return text_ + (shown_ < kMaxShownWords ? "\n" : "\n\nThe other changes are left out.\n");
    }

  private:
    void put(const std::vector<ReportWord>& words, std::size_t from, std::size_t to, const char* mark) {
        std::string run;
        for (std::size_t i = from; i < to && shown_ < kMaxShownWords; ++i, ++shown_)
            run += (run.empty() ? "" : " ") + escaped(words[i].text);
        if (!run.empty()) text_ += mark + run + mark + " ";
    }

    void put_place(const ReportWord& word) {
        const std::string page = word.page > 0 ? fmt::format("page {}", word.page) : "",
                          section = escaped(printable(word.section, 80));
        if (page.empty() && section.empty()) return;
        text_ += fmt::format("*{}{}{}:* ", section, page.empty() || section.empty() ? "" : ", ", page);
    }

    std::string text_;
    std::size_t shown_ = 0;
};

std::string pages(const GroupChanges& g) {
    const auto shown = [](std::optional<int> count) { return count ? std::to_string(*count) : std::string("?"); };
    return g.pages_before == g.pages_after ? shown(g.pages_after)
                                           : shown(g.pages_before) + " -> " + shown(g.pages_after);
}

RunRecord record_of(const GroupChanges& g, const Course& course, const Assignment& assignment) {
    const CourseClock& clock = course.clock();
    RunRecord record;
    record.values = {{"group", {{}, cell(g.group)}},
                     {"assignment", {{}, cell(assignment.name)}},
                     {"course", {{}, cell(course.name())}}};
    RecordedTable& files = record.tables["files"] = {{"version", "file", "received", ""}, {}};
    for (const auto* stage : {&g.first, &g.final})
        for (const ValidFile& file : *stage)
            files.rows.push_back({stage == &g.first ? "first" : "final", fmt::format("{} v{}", file.part, file.number),
                                  clock.show(file.received_at),
                                  file.late > 0 ? "late by " + duration_text(file.late) : "on time"});
    std::string summary;
    const auto say = [&](const Message& sentence) { summary += escaped(message_text(sentence)) + "\n\n"; };
    if (g.first.empty()) say(Message("No first version exists for comparison."));
    if (g.same_files) say(Message("The final version is identical to the first version, byte for byte."));
    if (g.text)
        say(Message("{} of the words changed: {} deleted, {} inserted; number of pages: {}.", percent(*g.text),
                    g.text->deleted, g.text->inserted, pages(g)));
    if (!g.compared.empty()) say(g.compared);
    for (const Message& problem : g.problems) say(problem);
    std::string values = "Values can be compared if both versions have a pack with an analysis that runs.\n";
    if (g.values) {
        values = fmt::format("{} of {} values, answers and table cells of the analysis changed.\n\n",
                             g.values->changed.size(), g.values->compared);
        RecordedTable& table = record.tables["values"] = {{"name", "first", "final"}, {}};
        for (const ValueChange& change : g.values->changed)
            if (table.rows.size() < kMaxRows)
                table.rows.push_back({cell(change.name), cell(change.before), cell(change.after)});
        if (!table.rows.empty()) values += "::: {.table name=values}\n:::\n";
    }
    std::string reviews;
    for (const ReleasedReview& review : g.reviews) {
        reviews += fmt::format("## {}, released {}\n\n", review.reviewer, clock.show(review.released));
        if (!review.problem.empty()) reviews += escaped(message_text(review.problem)) + "\n\n";
        for (const ReviewBlock& block : review.blocks)
            reviews += (block.heading ? "**" + escaped(block.text) + "**" : escaped(block.text)) + "\n\n";
    }
    record.texts = {{"summary", {summary + "\n"}},
                    {"values", {values}},
                    {"text", {g.text ? MarkedText().markdown(g.text->pieces) : "The texts cannot be compared.\n"}},
                    {"reviews", {reviews.empty() ? "No review was released to this group.\n" : reviews}}};
    return record;
}

Message attention(const GroupChanges& g) {
    if (g.final.empty()) return g.dropped_out ? Message("dropped out") : Message("no final version");
    if (g.first.empty()) return Message("no first version for comparison");
    if (g.same_files) return Message("the final version is identical to the first version, byte for byte");
    if (!g.text) return g.problems.empty() ? Message("cannot be compared") : g.problems.back();
    if (g.text->share() == 0) return Message("the text is unchanged");
    return g.problems.empty() ? Message() : g.problems.front();
}

}  // namespace

std::string changes_table(const Assignment& assignment, const std::vector<GroupChanges>& groups) {
    std::vector<std::vector<std::string>> rows;
    std::size_t finals = 0;
    for (const GroupChanges& g : groups) {
        finals += !g.final.empty();
        const bool both = !g.first.empty() && !g.final.empty();
        rows.push_back({g.group, both ? pages(g) : "-", g.text ? percent(*g.text) : "-",
                        g.text ? fmt::format("{}", g.text->deleted) : "-",
                        g.text ? fmt::format("{}", g.text->inserted) : "-",
                        g.values ? fmt::format("{} of {}", g.values->changed.size(), g.values->compared) : "-",
                        fmt::format("{}", g.reviews.size()), message_text(attention(g))});
    }
    return fmt::format("{}: changes from the first to the final version\n\n", assignment.name) +
           aligned_table({"group", "pages", "words changed", "deleted", "inserted", "values changed", "reviews",
                          "needs attention"},
                         rows) +
           fmt::format("\n{} of {} groups have a final version.\n", finals, groups.size());
}

std::size_t write_changes(const std::vector<GroupChanges>& groups, Course& course, const Assignment& assignment,
                          const fs::path& folder, const SandboxedDocuments& documents,
                          const std::function<void(std::size_t, std::size_t)>& progress) {
    std::vector<const GroupChanges*> finals;
    for (const GroupChanges& g : groups)
        if (!g.final.empty()) finals.push_back(&g);
    fs::create_directories(folder);
    const auto write = [&](std::size_t i) {
        const RunRecord record = record_of(*finals[i], course, assignment);
        for (const char* const ending : {".md", ".pdf"})
            documents.make("version_changes.md", record, folder / (finals[i]->group + ending));
    };
    side_by_side(finals.size(), write, progress);
    return finals.size();
}

}  // namespace dynlab::inline course
