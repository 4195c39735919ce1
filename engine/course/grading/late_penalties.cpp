#include "course/grading/late_penalties.h"

#include <algorithm>
#include <ctime>

#include "base/reader.h"
#include "course/intake/arrival_times.h"
#include "course/intake/lateness.h"

namespace dynlab::inline course {
namespace {

constexpr double kNeedsConfirmation = 50;  ///< percent

std::string shown_instant(std::int64_t instant) {
    const std::time_t seconds = instant;
    std::tm time{};
    ::localtime_r(&seconds, &time);
    char text[64];
    return {text,
            std::strftime(text, sizeof text, time.tm_sec == 0 ? "%Y-%m-%d %H:%M %Z" : "%Y-%m-%d %H:%M:%S %Z", &time)};
}

/// "received 2026-03-01 18:20 CET, 20 min after the deadline of 2026-03-01 18:00 CET; 10 % of the points are
/// taken off for each day or part of a day"
Message reason_of(const LatePolicy& policy, std::int64_t received) {
    const std::string came = shown_instant(received), due = shown_instant(policy.deadline);
    const Message duration = duration_message(received - policy.deadline);
    if (policy.max_percent < 100)
        return Message(
            "received {}, {} after the deadline of {}; the penalty is {} % of the points for each day or part of a "
            "day, at most {} %",
            came, duration, due, significant(policy.percent_per_day, 4), significant(policy.max_percent, 4));
    return Message(
        "received {}, {} after the deadline of {}; the penalty is {} % of the points for each day or part of a day",
        came, duration, due, significant(policy.percent_per_day, 4));
}

}  // namespace

Lateness lateness_of(const LatePolicy& policy, std::int64_t received) {
    const std::int64_t late = received - policy.deadline;
    if (late <= policy.grace) return {};
    return {static_cast<double>(late) / 3600, late_percent(policy.percent_per_day, policy.max_percent, late),
            reason_of(policy, received), late};
}

bool needs_confirmation(const Lateness& lateness) {
    return lateness.percent >= kNeedsConfirmation;
}

Lateness unconfirmed(const Lateness& lateness) {
    Lateness waiting = lateness;
    waiting.percent = 0, waiting.waiting_percent = lateness.percent;
    waiting.reason = Message("{}; this penalty of {} % is not applied until your instructor confirms it",
                             lateness.reason, significant(lateness.percent, 4));
    return waiting;
}

void conclude_lateness(ClassWork& work) {
    std::vector<std::int64_t> late;
    std::vector<const WorkItem*> items;
    for (const WorkItem& item : work.items)
        if (item.lateness.late > 0) items.push_back(&item);
    std::ranges::sort(items, {}, [](const WorkItem* item) { return item->submission.name; });
    for (const WorkItem* item : items) {
        const Lateness& lateness = item->lateness;
        late.push_back(lateness.late);
        const bool waits = lateness.waiting_percent > 0;
        const std::string& name = item->submission.name;
        const Message by = duration_message(lateness.late);
        work.late.push_back(waits
                                ? Message("\"{}\" is late by {}; a penalty of {} % of the points is not applied until "
                                          "you confirm it",
                                          name, by, significant(lateness.waiting_percent, 4))
                                : Message("\"{}\" is late by {}; the penalty is {} % of the points", name, by,
                                          significant(lateness.percent, 4)));
        if (!waits) continue;
        ++work.unconfirmed;
        work.attention.push_back(
            Message("\"{}\" arrived {} after its deadline, but the penalty of {} % is not applied yet. Confirm the "
                    "penalty with --accept-late (dynlab grade, dynlab course submit), or correct the time of receipt "
                    "with dynlab course set-received",
                    name, by, significant(lateness.waiting_percent, 4)));
    }
    if (Message question = doubt_about_zone(std::move(late), work.items.size()); !question.empty())
        work.notes.push_back(std::move(question));
}

}  // namespace dynlab::inline course
