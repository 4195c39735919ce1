#include "course/corrections/corrections.h"

#include <fmt/format.h>

#include <algorithm>

#include "course/review/review_pairs.h"
#include "course/store/inspection.h"
#include "course/store/receipts.h"
#include "numerics/error.h"

namespace dynlab::inline course {
namespace {

const char* stage_name(const std::string& stage) {
    return stage == "first" ? "first version" : stage == "review" ? "review" : "final version";
}

struct Found {
    std::int64_t id = 0, number = 0;
    std::string part;
};

/// What a correction is about, as it lies in the store.
class SelectedFiles {
  public:
    SelectedFiles(Course& course, const Assignment& assignment, const SubmissionSelection& requested)
        : db_(course.database()),
          assignment_(assignment),
          requested_(requested),
          group_(group_named(course, requested.group)) {
        if (requested.stage == "review")
            pair_ = reviewed_pair(review_pairs(course, assignment), group_, requested.report).id;
    }

    const Group& group() const { return group_; }
    std::optional<std::int64_t> pair() const { return pair_; }
    std::string what() const { return fmt::format("{} of {}", stage_name(requested_.stage), group_.name); }

    /// Those that are withdrawn, or those that are not.
    std::vector<Found> all(bool withdrawn) const {
        const std::vector<std::string> parts = parts_of(assignment_, requested_.stage);
        if (!requested_.part.empty()) {
            if (requested_.part != kUnreadable && std::ranges::find(parts, requested_.part) == parts.end())
                throw InvalidArgument("{} has no part {}; the parts are {}", assignment_.name, requested_.part,
                                      listed(parts));
            return {one(requested_.part, withdrawn)};
        }
        std::optional<Found> document = newest(assignment_.is_lab() ? "" : parts.front(), withdrawn);
        std::vector<Found> found = {document ? *document : one("pack", withdrawn)};
        for (Rows rows = db_.query("SELECT w.id, w.number, w.part FROM arrived w JOIN versions o ON o.id = w.id JOIN "
                                   "versions v ON v.id = ? WHERE o.assignment = v.assignment AND o.group_id = "
                                   "v.group_id AND o.stage = v.stage AND ifnull(o.pair, 0) = ifnull(v.pair, 0) AND "
                                   "o.received_at = v.received_at AND o.part <> v.part AND o.part <> 'unreadable' AND "
                                   "w.withdrawn = ?",
                                   found.front().id, std::int64_t{withdrawn});
             rows.next();)
            found.push_back({rows.integer(0), rows.integer(1), rows.text(2)});
        return found;
    }

  private:
    /// Without a part the script or pack that came last.
    std::optional<Found> newest(const std::string& part, bool withdrawn) const {
        Rows rows = db_.query(
            "SELECT id, number, part FROM arrived WHERE assignment = ? AND group_id = ? AND stage = ? AND ifnull(pair, "
            "0) = ? AND (part = ?5 OR (?5 = '' AND part IN ('script', 'pack'))) AND withdrawn = ? AND number = "
            "ifnull(?, number) ORDER BY CASE ?5 WHEN '' THEN received_at ELSE number END DESC, id DESC",
            assignment_.id, group_.id, requested_.stage, pair_.value_or(0), part, std::int64_t{withdrawn},
            requested_.number);
        if (!rows.next()) return {};
        return Found{rows.integer(0), rows.integer(1), rows.text(2)};
    }
    Found one(const std::string& part, bool withdrawn) const {
        if (const auto found = newest(part, withdrawn)) return *found;
        const std::string version = requested_.number ? fmt::format("{} v{}", part, *requested_.number) : part;
        throw withdrawn
            ? InvalidArgument("the {} ({}) for {} has not been withdrawn", what(), version, assignment_.name)
            : InvalidArgument("the {} ({}) for {} does not exist", what(), version, assignment_.name);
    }

    Database& db_;
    const Assignment& assignment_;
    const SubmissionSelection& requested_;
    Group group_;
    std::optional<std::int64_t> pair_;
};

std::int64_t group_of_version(Course& course, std::int64_t version) {
    Rows rows = course.database().query("SELECT group_id FROM versions WHERE id = ?", version);
    return rows.next() ? rows.integer(0) : 0;
}

std::vector<std::int64_t> ids_of(const std::vector<Found>& all) {
    std::vector<std::int64_t> ids;
    for (const Found& one : all) ids.push_back(one.id);
    return ids;
}

}  // namespace

void log_arrival(Course& course, const Assignment& a, std::int64_t version, Instant received, const std::string& reason,
                 Instant now) {
    Receipt receipt = receipt_of(course, version);
    const Instant due = due_for(course, a, group_of_version(course, version), receipt.stage);
    ++receipt.correction;
    receipt.received = received, receipt.due = due;
    receipt.late = received > due + a.grace ? received - due : 0;
    course.database().run(
        "INSERT INTO arrivals (version, received_at, due_at, late, reason, made_at, signature) VALUES (?, ?, ?, ?, ?, "
        "?, ?)",
        version, received, due, receipt.late, reason, now, version_signature(course, receipt));
}

void confirm_arrivals(Course& course, const Assignment& a, const std::vector<std::int64_t>& versions, Instant now) {
    Transaction transaction(course.database());
    for (const std::int64_t version : versions)
        log_arrival(course, a, version, receipt_of(course, version).received, "confirmed", now);
    course.note(fmt::format("{}: {} times of receipt confirmed", a.name, versions.size()), now);
    transaction.commit();
}

std::vector<std::int64_t> correct_arrival(Course& course, const Assignment& a, const SubmissionSelection& requested,
                                          Instant received, const std::string& reason, Instant now) {
    refuse_without_reason(reason);
    if (received > now)
        throw InvalidArgument("the time of receipt, {}, is in the future; give the time at which the file arrived",
                              course.clock().show_exactly(received));
    Transaction transaction(course.database());
    const SelectedFiles files(course, a, requested);
    const std::vector<Found> all = files.all(false);
    const auto is_recorded = [&, due = due_for(course, a, files.group().id, requested.stage)](const Found& one) {
        Rows newest = course.database().query(
            "SELECT received_at = ? AND due_at = ? AND reason = ? FROM arrivals WHERE version = ? ORDER BY id DESC "
            "LIMIT 1",
            received, due, reason, one.id);
        return newest.next() && newest.integer(0) != 0;
    };
    if (std::ranges::all_of(all, is_recorded)) return ids_of(all);  // the command is repeated
    for (const Found& one : all) log_arrival(course, a, one.id, received, reason, now);
    course.note(fmt::format("{}: {} (v{}) was received at {}; reason: {}", a.name, files.what(), all.front().number,
                            course.clock().show_exactly(received), reason),
                now);
    transaction.commit();
    return ids_of(all);
}

std::vector<std::int64_t> withdraw(Course& course, const Assignment& a, const SubmissionSelection& requested,
                                   bool withdrawn, const std::string& reason, Instant now) {
    refuse_without_reason(reason);
    Transaction transaction(course.database());
    const SelectedFiles files(course, a, requested);
    const std::vector<Found> all = files.all(!withdrawn);
    std::string parts;
    for (const Found& one : all) {
        parts += fmt::format("{}{} v{}", parts.empty() ? "" : ", ", one.part, one.number);
        course.database().run("INSERT INTO withdrawals (version, withdrawn, reason, made_at) VALUES (?, ?, ?, ?)",
                              one.id, std::int64_t{withdrawn}, reason, now);
    }
    course.note(fmt::format("{}: {} ({}) {}; reason: {}", a.name, files.what(), parts,
                            withdrawn ? "withdrawn" : "is reinstated", reason),
                now);
    transaction.commit();
    return ids_of(all);
}

void extend(Course& course, const Assignment& a, const std::string& group, const std::string& stage,
            std::optional<Instant> due, const std::string& reason, Instant now) {
    refuse_without_reason(reason);
    Transaction transaction(course.database());
    const Group whose = group_named(course, group);
    Rows newest = course.database().query(
        "SELECT due_at IS ? AND reason = ? FROM extensions WHERE assignment = ? AND group_id = ? AND stage = ? "
        "ORDER BY id DESC LIMIT 1",
        due, reason, a.id, whose.id, stage);
    if (newest.next() && newest.integer(0) != 0) return;  // the command is repeated
    const Instant before = due_for(course, a, whose.id, stage);
    course.database().run(
        "INSERT INTO extensions (assignment, group_id, stage, due_at, reason, made_at) VALUES (?, ?, ?, ?, ?, ?)", a.id,
        whose.id, stage, due, reason, now);
    course.note(fmt::format("{}: the {} of {} is due {} instead of {}; reason: {}", a.name, stage_name(stage),
                            whose.name, course.clock().show_exactly(due_for(course, a, whose.id, stage)),
                            course.clock().show_exactly(before), reason),
                now);
    transaction.commit();
}

void hold(Course& course, const Assignment& a, const SubmissionSelection& requested, bool held,
          const std::string& reason, Instant now) {
    refuse_without_reason(reason);
    refuse_without_reviews(a);
    if (requested.stage == "final")
        throw InvalidArgument("a final version is not sent to other groups and cannot be withheld");
    Transaction transaction(course.database());
    const SelectedFiles files(course, a, requested);
    if (is_held(course, a, files.group().id, files.pair()) == held)
        throw held ? InvalidArgument("the {} is already withheld", files.what())
                   : InvalidArgument("the {} is not withheld", files.what());
    course.database().run(
        "INSERT INTO holds (assignment, group_id, pair, held, reason, made_at) VALUES (?, ?, ?, ?, ?, ?)", a.id,
        files.group().id, files.pair(), std::int64_t{held}, reason, now);
    course.note(fmt::format("{}: the {} is {}; reason: {}", a.name, files.what(),
                            held ? "held back" : "not withheld anymore", reason),
                now);
    transaction.commit();
}

std::vector<JournalLine> journal_of(Course& course) {
    std::vector<JournalLine> lines;
    for (Rows rows = course.database().query("SELECT at, what FROM journal ORDER BY id"); rows.next();)
        lines.push_back({rows.integer(0), rows.text(1)});
    return lines;
}

}  // namespace dynlab::inline course
