#include "course/review/final_changes_document.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/reader.h"
#include "course/review/marked_text.h"
#include "course/store/side_by_side.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kWordsOfPassage = 220, kWordsOfTrace = 45, kWordsOfLeadIn = 14, kMostRows = 40,
                      kMostPassages = 150;
constexpr char kNoTrace[] = "No change found that touches this.";

std::string percent(double share) {
    return fmt::format("{:.0f} %", 100 * share);
}

std::string with_minus(const std::string& change) {
    return change.starts_with('-') ? "−" + change.substr(1) : change;
}

/// Fills the slots of the template.
class Composition {
  public:
    Composition(const GroupChanges& changes, Course& course, const Assignment& assignment)
        : g_(changes), clock_(course.clock()) {
        record_.script = "final changes";
        const auto value = [&](const char* name, const std::string& text) {
            record_.values[name] = {{}, text_.cell(text, 60, 30)};
        };
        value("group", g_.group), value("assignment", assignment.name), value("course", course.name());
        record_.tables["came"] = received_files();
        const auto text = [&](const char* name, std::string markdown) { record_.texts[name] = {std::move(markdown)}; };
        text("summary", summary()), text("basis", basis()), text("sections", sections()), text("values", values());
        text("passages", passages()), text("remarks", remarks());
    }

    RunRecord record() && { return std::move(record_); }

  private:
    std::string summary() const {
        MessageList parts{{}, Join::kSemicolon};
        if (g_.pages_before && g_.pages_after)
            parts.items.push_back(
                *g_.pages_before == *g_.pages_after
                    ? plural(*g_.pages_after, "{} page as before", "{} pages as before")
                    : plural(*g_.pages_after, "{} page instead of {}", "{} pages instead of {}", *g_.pages_before));
        if (g_.text) parts.items.push_back(Message("{} of the text changed", percent(g_.text->share)));
        const int wanted = g_.traced() + g_.untraced();
        if (g_.text && wanted > 0)
            parts.items.push_back(Message("{} of {} remarks have a trace in it", g_.traced(), wanted));
        return message_text(parts.items.empty() ? Message("There is nothing to compare.") : Message("{}.", parts)) +
               "\n";
    }

    RecordedTable received_files() const {
        RecordedTable table{{"version", "file", "its name", "came", "", "compared"}, {}};
        for (const ReceivedFile& file : g_.received)
            table.rows.push_back({file.stage == "first" ? "first" : "final",
                                  fmt::format("{} v{}", file.part, file.number), text_.cell(file.name, 40, 28),
                                  clock_.show(file.at), file.late > 0 ? "late " + duration_text(file.late) : "in time",
                                  file.compared ? "yes" : "no"});
        return table;
    }

    std::string basis() const {
        std::string text;
        const auto line = [&](const Message& sentence) { text += text_.plain(message_text(sentence)) + "\n\n"; };
        if (!g_.has_first) line(Message("There is no first version: nothing can be compared."));
        if (g_.same_files) line(Message("The final version is the first one, byte for byte."));
        if (!g_.compared.empty()) line(g_.compared);
        for (const Message& trouble : g_.troubles) line(trouble);
        if (g_.text && g_.text->moved > 0)
            line(plural(g_.text->moved,
                        "{} sentence stands elsewhere than before, otherwise unchanged; this counts as no change.",
                        "{} sentences stand elsewhere than before, otherwise unchanged; this counts as no change."));
        if (g_.text && !g_.text->renumbered.empty()) line(renumbering());
        return text.empty() ? "\n" : text;
    }

    Message renumbering() const {
        MessageList parts;
        for (const auto& [was, now] : g_.text->renumbered) parts.items.push_back(Message("{} is now {}", was, now));
        return Message("{}; another number alone counts as no change.", parts);
    }

    std::string sections() {
        if (!g_.text) return "Not known.\n";
        RecordedTable& table = record_.tables["sections"];
        table.header = {"section", "words, first", "words, final", "what became of it"};
        for (const SectionChange& section : g_.text->sections) {
            std::string what = section.share == 0      ? "unchanged"
                               : section.share < 0.005 ? "less than 1 % changed"
                                                       : percent(section.share) + " changed";
            if (!section.before) what = "new";
            if (!section.after) what = "gone";
            if (section.renamed()) what = fmt::format("was \"{}\"; {}", text_.cell(*section.before, 60, 20), what);
            const std::string title = section.after ? *section.after : *section.before;
            table.rows.push_back({title.empty() ? "(before the first heading)" : text_.cell(title, 60, 20),
                                  section.before ? std::to_string(section.words_before) : "",
                                  section.after ? std::to_string(section.words_after) : "", what});
        }
        return "::: {.table name=sections}\n:::\n";
    }

    std::string values() {
        if (!g_.values) return "Values can be compared where both versions came as packs whose analysis can be run.\n";
        const ValueChanges& all = *g_.values;
        if (all.changed.empty())
            return fmt::format("All {} values and cells of tables that the analysis reports are what they were.\n",
                               all.compared);
        RecordedTable& table = record_.tables["values"];
        table.header = {"reported as", "first", "final", "change"};
        for (std::size_t i = 0; i < std::min(all.changed.size(), kMostRows); ++i) {
            const ValueChange& change = all.changed[i];
            const auto shown = [&](const std::string& text) {
                return text.empty() ? std::string("–") : text_.cell(text, 40, 18);
            };
            table.rows.push_back({text_.cell(change.name, 60, 24), shown(change.before), shown(change.after),
                                  with_minus(change.change)});
        }
        return fmt::format(
            "{} of {} values and cells of tables that the analysis reports have changed{}.\n\n"
            "::: {{.table name=values}}\n:::\n",
            all.changed.size(), all.compared,
            all.changed.size() > kMostRows ? fmt::format("; the first {} of them", kMostRows) : "");
    }

    /// "Change 3, in 4 Validation, page 3".
    std::string location_of(std::size_t i) const {
        const Passage& passage = g_.text->passages[i];
        std::string location = fmt::format("Change {}", i + 1);
        if (!passage.section.empty()) location += fmt::format(", in \"{}\"", text_.cell(passage.section, 60, 20));
        if (passage.page_before > 0 && passage.page_before == passage.page_after)
            location += fmt::format(", page {}", passage.page_after);
        else if (passage.page_before > 0 && passage.page_after > 0)
            location += fmt::format(", page {}, now {}", passage.page_before, passage.page_after);
        else if (passage.page_before + passage.page_after > 0)
            location += fmt::format(", page {}", passage.page_before + passage.page_after);
        return location;
    }

    std::string passages() const {
        if (!g_.text) return "Not known.\n";
        const auto& all = g_.text->passages;
        if (all.empty()) return "No sentence has changed.\n";
        std::string text;
        for (std::size_t i = 0; i < std::min(all.size(), kMostPassages); ++i) {
            text += text_.emphasised(location_of(i) + ".");
            const std::string lead_in = last_words(all[i].lead_in, kWordsOfLeadIn);
            if (!lead_in.empty()) text += " " + text_.plain(lead_in);
            text += " " + text_.marked(all[i], kWordsOfPassage) + "\n\n";
        }
        if (all.size() > kMostPassages)
            text += fmt::format("Further {} changes are left out.\n", all.size() - kMostPassages);
        return text;
    }

    std::string remarks() const {
        if (g_.reviews.empty()) return "No review was released to these authors.\n";
        std::string text;
        for (const AnsweredReview& review : g_.reviews) {
            text += fmt::format("## {}, released {}\n\n", review.reviewer, clock_.show(review.released));
            if (!review.trouble.empty()) text += text_.plain(message_text(review.trouble)) + "\n\n";
            std::string question;
            int number = 0;
            for (const AnsweredRemark& answered : review.remarks) {
                const Remark& remark = answered.remark;
                if (!remark.question.empty() && remark.question != question)
                    text += "**" + text_.plain(question = remark.question) + "**\n\n";
                text += text_.emphasised(fmt::format("Remark {}.", ++number)) + " " + text_.plain(remark.text);
                // One paragraph, which is not torn apart at the end of a page.
                text += "\\\n" + outcome(answered) + "\n";
            }
        }
        return text;
    }

    std::string outcome(const AnsweredRemark& answered) const {
        if (!answered.remark.wants_answer) return "→ *Praise: no answer is looked for.*\n";
        if (!g_.text) return "→ *Not known: the versions could not be compared.*\n";
        if (answered.traces.empty()) return std::string("→ **") + kNoTrace + "**\n";
        std::string text;
        for (const RemarkMatch& trace : answered.traces) {
            std::vector<std::string> reasons;
            if (!trace.places.empty()) reasons.push_back(fmt::format("it names {}", fmt::join(trace.places, ", ")));
            if (!trace.words.empty()) reasons.push_back(fmt::format("words: {}", fmt::join(trace.words, ", ")));
            text += fmt::format("→ {} {} {}\n\n", text_.emphasised(location_of(trace.passage) + ":"),
                                text_.marked(g_.text->passages[trace.passage], kWordsOfTrace),
                                text_.emphasised(fmt::format("({})", fmt::join(reasons, "; "))));
        }
        return text;
    }

    const GroupChanges& g_;
    const CourseClock& clock_;
    MarkedText text_;
    RunRecord record_;
};

}  // namespace

std::size_t write_change_documents(const std::vector<GroupChanges>& groups, Course& course,
                                   const Assignment& assignment, const fs::path& folder,
                                   const BoxedDocuments& documents,
                                   const std::function<void(std::size_t, std::size_t)>& progress) {
    std::vector<std::pair<std::string, RunRecord>> records;
    for (const GroupChanges& changes : groups)
        if (changes.has_final) records.emplace_back(changes.group, Composition(changes, course, assignment).record());
    fs::create_directories(folder);
    side_by_side(
        records.size(),
        [&](std::size_t i) {
            for (const char* const ending : {".md", ".pdf"})
                documents.make("final_changes.md", records[i].second, folder / (records[i].first + ending));
        },
        progress);
    return records.size();
}

}  // namespace dynlab::inline course
