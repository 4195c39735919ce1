#include "course/office/deadline_import.h"

#include "course/corrections/corrections.h"
#include "course/grading/deadlines.h"
#include "numerics/error.h"

namespace dynlab::inline course {
namespace {

constexpr char kForAll[] = "*";

/// When the newest version of a lab or a document was received.
std::optional<Instant> received_at(Course& course, const Assignment& a, std::int64_t group) {
    Rows rows = course.database().query(
        "SELECT max(received_at) FROM standing WHERE assignment = ? AND group_id = ? AND stage = 'first'", a.id, group);
    return rows.next() ? rows.optional_integer(0) : std::nullopt;
}

}  // namespace

DeadlineImport import_deadlines(Course& course, const Assignment& assignment, const std::filesystem::path& file,
                                Instant now) {
    const Deadlines table(file);
    const std::string reason = "imported from " + file.filename().string();
    DeadlineImport done;
    Assignment a = assignment;
    if (const auto all = table.rules().find(kForAll); all != table.rules().end()) {
        a.first_due = all->second.deadline, a.grace = all->second.grace;
        a.costs.late_day = all->second.percent_per_day, a.costs.late_most = all->second.most_percent;
        set_assignment(course, a, reason);
    }
    for (const auto& [who, rule] : table.rules()) {
        if (who == kForAll) continue;
        try {
            const Group group = group_named(course, who);
            if (rule.grace != a.grace || rule.percent_per_day != a.costs.late_day ||
                rule.most_percent != a.costs.late_most)
                throw InvalidArgument("a course has one grace and one penalty for all; use extra, or another deadline");
            if (due_for(course, a, group.id, "first") != rule.deadline) {
                extend(course, a, group.name, "first", rule.deadline, reason, now);
                ++done.extended;
            }
            if (!rule.received || received_at(course, a, group.id) == *rule.received) continue;
            HandedInWanted wanted;
            wanted.group = group.name;
            correct_arrival(course, a, wanted, *rule.received, reason, now);
            ++done.corrected;
        } catch (const InvalidArgument& error) {
            done.complaints.push_back(Message("the row of \"{}\": {}", who, message_of(error)));
        }
    }
    return done;
}

}  // namespace dynlab::inline course
