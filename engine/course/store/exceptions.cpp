#include "course/store/exceptions.h"

#include "numerics/error.h"

namespace dynlab::inline course {

void refuse_without_reason(const std::string& reason) {
    if (reason.empty()) throw InvalidArgument("say why: --reason \"...\"; it stands in the history");
}

Instant due_for(Course& course, const Assignment& a, std::int64_t group, const std::string& stage) {
    const std::optional<Instant> common = stage == "first"    ? std::optional(a.first_due)
                                          : stage == "review" ? a.review_due
                                                              : a.final_due;
    if (!common) {
        if (stage == "review") refuse_without_reviews(a);
        throw a.is_talk() ? InvalidArgument("{} is a talk: it has no final version", a.name)
                          : InvalidArgument("{} is a lab: it has no final version", a.name);
    }
    Rows own = course.database().query(
        "SELECT due_at FROM extensions WHERE assignment = ? AND group_id = ? AND stage = ? ORDER BY id DESC LIMIT 1",
        a.id, group, stage);
    return own.next() ? own.optional_integer(0).value_or(*common) : *common;
}

bool is_held(Course& course, const Assignment& a, std::int64_t group, std::optional<std::int64_t> pair) {
    Rows rows = course.database().query(
        "SELECT held FROM holds WHERE assignment = ? AND group_id = ? AND ifnull(pair, 0) = ? ORDER BY id DESC LIMIT 1",
        a.id, group, pair.value_or(0));
    return rows.next() && rows.integer(0) != 0;
}

}  // namespace dynlab::inline course
