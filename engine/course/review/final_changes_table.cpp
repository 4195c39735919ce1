#include <fmt/format.h>

#include <algorithm>

#include "base/reader.h"
#include "course/review/final_changes.h"
#include "platform/terminal/aligned_table.h"

namespace dynlab::inline course {
namespace {

std::string pages_cell(const GroupChanges& g) {
    const auto shown = [](std::optional<int> pages) { return pages ? fmt::format("{}", *pages) : std::string("?"); };
    if (!g.pages_before && !g.pages_after) return "-";
    if (g.pages_before == g.pages_after) return shown(g.pages_after);
    return fmt::format("{} -> {}", shown(g.pages_before), shown(g.pages_after));
}

std::string sections_cell(const TextChanges& text) {
    int fresh = 0, gone = 0, renamed = 0;
    for (const SectionChange& section : text.sections) {
        fresh += !section.before;
        gone += !section.after;
        renamed += section.renamed();
    }
    MessageList parts;
    if (fresh > 0) parts.items.push_back(Message("{} new", fresh));
    if (gone > 0) parts.items.push_back(Message("{} gone", gone));
    if (renamed > 0) parts.items.push_back(Message("{} renamed", renamed));
    return message_text(parts.items.empty() ? Message("same") : Message("{}", parts));
}

/// What the instructor may want to look at.
Message to_look_at(const GroupChanges& g) {
    if (!g.has_final) return g.dropped_out ? Message("dropped out") : Message("no final version");
    if (!g.has_first) return Message("no first version to compare with");
    if (g.same_files) return Message("the final version is the first one, byte for byte");
    if (!g.text) return g.troubles.empty() ? Message("cannot be compared") : g.troubles.back();
    MessageList things{{}, Join::kSemicolon};
    if (g.text->passages.empty()) things.items.push_back(Message("no change in the text"));
    const auto unread = std::count_if(g.reviews.begin(), g.reviews.end(),
                                      [](const AnsweredReview& review) { return !review.trouble.empty(); });
    if (unread > 0) things.items.push_back(plural(unread, "{} unreadable review", "{} unreadable reviews"));
    if (g.reviews.empty()) things.items.push_back(Message("no review was released"));
    if (g.untraced() > 0) things.items.push_back(plural(g.untraced(), "{} remark left?", "{} remarks left?"));
    if (!g.troubles.empty()) things.items.push_back(g.troubles.front());
    return Message("{}", things);
}

int count(const GroupChanges& g, bool with_trace) {
    int remarks = 0;
    for (const AnsweredReview& review : g.reviews)
        for (const AnsweredRemark& answered : review.remarks)
            remarks += answered.remark.wants_answer && answered.traces.empty() != with_trace;
    return remarks;
}

}  // namespace

int GroupChanges::traced() const {
    return count(*this, true);
}
int GroupChanges::untraced() const {
    return count(*this, false);
}

std::string final_changes_table(const Assignment& assignment, const std::vector<GroupChanges>& groups) {
    std::vector<std::vector<std::string>> rows;
    int finals = 0, traced = 0, untraced = 0;
    for (const GroupChanges& g : groups) {
        finals += g.has_final;
        const bool both = g.has_first && g.has_final;
        if (both) traced += g.traced(), untraced += g.untraced();
        rows.push_back({g.group, both ? pages_cell(g) : "-", g.text ? sections_cell(*g.text) : "-",
                        g.values ? fmt::format("{} of {}", g.values->changed.size(), g.values->compared) : "-",
                        g.text ? fmt::format("{:.0f} %", 100 * g.text->share) : "-",
                        both ? fmt::format("{} / {}", g.traced(), g.traced() + g.untraced()) : "-",
                        message_text(to_look_at(g))});
    }
    std::string text = fmt::format("{}: what changed from the first to the final version\n\n", assignment.name);
    text += aligned_table(
        {"group", "pages", "sections", "values changed", "text changed", "remarks with a trace", "to look at"}, rows);
    return text + fmt::format(
                      "\n{} of {} groups have a final version; {} of {} remarks have a trace in the text.\n"
                      "Traces are found by words: whether a remark was answered is for you to say.\n",
                      finals, groups.size(), traced, traced + untraced);
}

}  // namespace dynlab::inline course
