#include "course/grading/late_penalties.h"

#include <fmt/format.h>

#include "base/reader.h"
#include "course/intake/arrival_times.h"
#include "data_io/text_table.h"
#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

constexpr double kNeedsConfirmation = 50;  ///< percent

}  // namespace

LatePenalties::LatePenalties(std::filesystem::path out, bool accept)
    : file_(std::move(out) / "accepted_late.csv"), accept_(accept) {
    if (!std::filesystem::exists(file_)) return;
    const TextTable table = read_text_table(file_);
    const auto submission = table.column("submission"), percent = table.column("percent");
    if (!submission || !percent)
        throw EnvironmentError("{}: the columns submission and percent are needed; there are {}", file_.string(),
                               listed(table.names));
    for (const auto& row : table.rows) accepted_[row[*submission]] = number_in_cell(row[*percent]).value_or(0);
}

Lateness LatePenalties::counted(const std::string& submission, const Lateness& late) {
    const auto known = accepted_.find(submission);
    const bool accepted = accept_ || late.typed || (known != accepted_.end() && known->second >= late.percent);
    const bool waits = late.percent >= kNeedsConfirmation && !accepted;
    if (late.percent >= kNeedsConfirmation && accept_) accepted_[submission] = late.percent;
    seen_[submission] = {late, waits};
    if (!waits) return late;
    Lateness waiting = late;
    waiting.percent = 0;
    waiting.reason = Message("{}; this penalty of {} % is not applied until your instructor confirms it", late.reason,
                             significant(late.percent, 4));
    return waiting;
}

std::vector<Message> LatePenalties::late() const {
    std::vector<Message> clauses;
    for (const auto& [name, seen] : seen_)
        if (seen.lateness.hours > 0)
            clauses.push_back(Message("\"{}\": late by {}, {} % of its points", name,
                                      duration_message(seen.lateness.late),
                                      significant(seen.waits ? 0 : seen.lateness.percent, 4)));
    return clauses;
}

std::vector<Message> LatePenalties::waiting() const {
    std::vector<Message> sentences;
    for (const auto& [name, seen] : seen_)
        if (seen.waits)
            sentences.push_back(
                Message("\"{}\" came {} after its deadline, and a penalty of {} % is not applied yet: accept it with "
                        "--accept-late, or write the true time into the column received of the deadlines",
                        name, duration_message(seen.lateness.late), significant(seen.lateness.percent, 4)));
    return sentences;
}

Message LatePenalties::doubt() const {
    std::vector<std::int64_t> late;
    for (const auto& [name, seen] : seen_)
        if (seen.lateness.hours > 0) late.push_back(seen.lateness.late);
    return doubt_about_zone(std::move(late), seen_.size());
}

void LatePenalties::conclude(ClassWork& work) const {
    work.late = late();
    work.unconfirmed = waiting();
    work.doubt = doubt();
    if (accepted_.empty()) return;
    TextTable table;
    table.names = {"submission", "percent"};
    for (const auto& [name, percent] : accepted_) table.rows.push_back({name, fmt::format("{}", percent)});
    write_file_atomically(file_, csv_text(table));
}

}  // namespace dynlab::inline course
