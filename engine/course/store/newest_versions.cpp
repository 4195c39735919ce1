#include "course/store/newest_versions.h"

#include "course/store/inspection.h"

namespace dynlab::inline course {
namespace {

constexpr char kStandingFile[] = "SELECT id, number, late, part, hash, name, received_at FROM standing f WHERE ";

std::optional<ValidFile> file_in(Rows rows) {
    if (!rows.next()) return {};
    return ValidFile{rows.integer(0), rows.integer(1), rows.integer(2), rows.text(3),
                     rows.text(4),    rows.text(5),    rows.integer(6)};
}

/// When each group first submitted something, by group: what is not withdrawn, and what is.
struct FirstSubmissions {
    std::map<std::int64_t, Instant> submitted, withdrawn;
};
FirstSubmissions first_submissions(Course& course, const Assignment& assignment) {
    FirstSubmissions first;
    for (Rows rows = course.database().query("SELECT group_id, withdrawn, min(received_at) FROM arrived WHERE "
                                             "assignment = ? AND stage = 'first' AND group_id IS NOT NULL GROUP BY "
                                             "group_id, withdrawn",
                                             assignment.id);
         rows.next();)
        (rows.integer(1) != 0 ? first.withdrawn : first.submitted)[rows.integer(0)] = rows.integer(2);
    return first;
}

}  // namespace

std::map<std::int64_t, std::map<std::string, SubmittedParts>> newest_versions(Course& course,
                                                                              const Assignment& assignment) {
    std::map<std::int64_t, std::map<std::string, SubmittedParts>> all;
    for (Rows rows = course.database().query(
             "SELECT group_id, stage, CASE ?2 WHEN 'lab' THEN replace(part, 'pack', 'script') ELSE part END, number, "
             "late, received_at, findings, EXISTS (SELECT 1 FROM arrivals a WHERE a.version = s.id) FROM standing s "
             "WHERE assignment = ?1 AND stage <> 'review' ORDER BY CASE ?2 WHEN 'lab' THEN received_at ELSE number "
             "END, id",
             assignment.id, assignment.kind);
         rows.next();) {
        const Inspection seen = inspection_from(rows.text(6));
        if (seen.error_reason == kNotTaken || seen.error_reason == kBeside) continue;
        SubmittedFile& newest = all[rows.integer(0)][rows.text(1)][rows.text(2)];
        const bool timely = newest.version > 0 && newest.late == 0 && newest.error_reason.empty();
        newest = {rows.integer(3),      rows.integer(4),   rows.integer(5),  timely ? newest.version : newest.in_time,
                  rows.integer(7) != 0, seen.rules_broken, seen.error_reason};
    }
    return all;
}

std::vector<FileNotTaken> files_not_taken(Course& course, const Assignment& assignment) {
    std::vector<FileNotTaken> files;
    for (Rows rows = course.database().query(
             "SELECT name, findings, received_at, hash FROM standing r WHERE assignment = ?1 AND part = ?2 AND NOT "
             "EXISTS "
             "(SELECT 1 FROM standing s WHERE s.assignment = ?1 AND s.part <> ?2 AND (s.hash = r.hash OR (s.group_id = "
             "r.group_id AND s.stage = r.stage AND s.received_at >= r.received_at))) ORDER BY id",
             assignment.id, kUnreadable);
         rows.next();)
        if (const Inspection seen = inspection_from(rows.text(1)); seen.error_reason == kNotTaken)
            files.push_back({rows.text(0), seen.reason, rows.integer(2), rows.text(3)});
    return files;
}

std::map<std::string, std::int64_t> author_groups(Course& course, const Assignment& assignment) {
    const auto [submitted, withdrawn] = first_submissions(course, assignment);
    std::map<std::string, std::int64_t> authors, of_withdrawn, present;
    // The group of several that counts comes last: a present one, the first by name.
    for (Rows rows = course.database().query(
             "SELECT m.student, m.group_id, m.since, m.until, "
             "rank() OVER (PARTITION BY m.student ORDER BY m.since, m.until IS NULL) = 1 "
             "FROM memberships m JOIN groups g ON g.id = m.group_id ORDER BY m.until IS NULL, g.name DESC, m.since");
         rows.next();) {
        const std::string student = rows.text(0);
        const std::int64_t group = rows.integer(1);
        const std::optional<Instant> until = rows.optional_integer(3);
        if (!until) present[student] = group;
        for (const auto& [times, groups] : {std::pair(&submitted, &authors), std::pair(&withdrawn, &of_withdrawn)}) {
            const auto at = times->find(group);
            if (at == times->end() || (until && *until <= at->second)) continue;
            if (rows.integer(2) <= at->second || rows.integer(4) != 0) (*groups)[student] = group;
        }
    }
    authors.merge(of_withdrawn);
    authors.merge(present);
    return authors;
}

std::vector<Group> groups_of_authors(Course& course, const Assignment& assignment) {
    const auto authors = author_groups(course, assignment);
    FirstSubmissions first = first_submissions(course, assignment);
    first.submitted.merge(first.withdrawn);
    std::vector<Group> groups = groups_of(course);
    for (Group& group : groups) {
        if (const auto at = first.submitted.find(group.id); at != first.submitted.end())
            group.members = members_at(course, group.id, at->second);
        else
            std::erase_if(group.members, [&](const std::string& id) { return authors.at(id) != group.id; });
    }
    return groups;
}

std::optional<ValidFile> newest_file(Course& course, const Assignment& assignment, std::int64_t group,
                                     const std::string& stage, const std::string& part, std::int64_t pair) {
    return file_in(course.database().query(
        std::string(kStandingFile) + "assignment = ? AND group_id = ? AND stage = ? AND part = ? AND ifnull(pair, 0) = "
                                     "? ORDER BY number DESC LIMIT 1",
        assignment.id, group, stage, part, pair));
}

std::optional<ValidFile> standing_file(Course& course, std::int64_t id) {
    return file_in(course.database().query(std::string(kStandingFile) + "id = ?", id));
}

std::optional<ValidFile> pack_of_document(Course& course, std::int64_t document) {
    return file_in(course.database().query(
        std::string(kStandingFile) +
            "part = 'pack' AND EXISTS (SELECT 1 FROM standing d WHERE d.id = ? AND d.assignment = f.assignment AND "
            "d.group_id = f.group_id AND d.stage = f.stage AND ifnull(d.pair, 0) = ifnull(f.pair, 0) AND f.received_at "
            ">= d.received_at AND NOT EXISTS (SELECT 1 FROM standing e WHERE e.assignment = d.assignment AND "
            "e.group_id = d.group_id AND e.stage = d.stage AND ifnull(e.pair, 0) = ifnull(d.pair, 0) AND e.part = "
            "d.part AND e.number > d.number AND e.received_at <= f.received_at)) ORDER BY number DESC LIMIT 1",
        document));
}

}  // namespace dynlab::inline course
