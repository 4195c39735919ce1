#include "course/store/newest_versions.h"

#include "course/store/inspection.h"

namespace dynlab::inline course {

std::map<std::int64_t, std::map<std::string, HandedInParts>> newest_versions(Course& course,
                                                                             const Assignment& assignment) {
    std::map<std::int64_t, std::map<std::string, HandedInParts>> all;
    for (Rows rows = course.database().query(
             "SELECT group_id, stage, part, number, late, received_at, findings FROM standing WHERE assignment = ? AND "
             "stage <> 'review' ORDER BY number",
             assignment.id);
         rows.next();) {
        HandedIn& newest = all[rows.integer(0)][rows.text(1)][rows.text(2)];
        const Inspection seen = inspection_from(rows.text(6));
        const bool timely = newest.version > 0 && newest.late == 0 && newest.trouble.empty();
        newest = {rows.integer(3),   rows.integer(4), rows.integer(5), timely ? newest.version : newest.in_time,
                  seen.rules_broken, seen.trouble};
    }
    return all;
}

}  // namespace dynlab::inline course
