#include "course/store/versions.h"

#include "course/store/receipts.h"

namespace dynlab::inline course {

AddedVersion add_version(Course& course, const Assignment& a, const NewVersion& v, Instant now) {
    const Instant due = due_for(course, a, v.group, v.stage);
    const std::int64_t late = v.at > due + a.grace ? v.at - due : 0;
    const Receipt receipt{course.name(), a.name,   v.group_name, v.stage, v.part, v.name,
                          v.hash,        v.number, v.bytes,      late,    v.at,   due};
    course.register_file(v.hash, v.bytes, now);
    course.database().run(
        "INSERT INTO versions (assignment, group_id, stage, pair, part, number, hash, name, received_at, due_at, late, "
        "findings, signature) VALUES (?, nullif(?, 0), ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        a.id, v.group, v.stage, v.pair, v.part, v.number, v.hash, v.name, v.at, due, late, v.findings,
        version_signature(course, receipt));
    return {course.database().getLastInsertRowid(), late};
}

}  // namespace dynlab::inline course
