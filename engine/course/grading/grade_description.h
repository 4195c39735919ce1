#pragma once
#include "course/grading/grade.h"
#include "course/intake/text_with_message.h"
#include "data_io/values/described.h"

namespace dynlab::inline course {

/// A submission's result as data_io/values/described.h stores it, without its log and without values that appear only
/// in the log.

template <Is<CheckGrade> T, class V>
void describe(T& object, V& member) {
    auto& [id, about, hint, message, points, earned, visible, graded, by_hand, rubric, for_instructor] = object;
    member("id", id);
    store_text_of_author(member, "about", about);
    store_text_of_author(member, "hint", hint);
    store_text_with_message(member, "message", "stored_message", message);
    member("points", points), member("earned", earned), member("visible", visible), member("graded", graded);
    member("by_hand", by_hand), member("rubric", rubric);
}

template <Is<Grade> T, class V>
void describe(T& object, V& member) {
    auto& [submission, lesson, isolation, fingerprint, error_reason, unreadable, began, silent, remark, printed, checks,
           late_hours, penalty, lateness, title, language, counts_instead, newest_counts, whole_mark, whole_reason,
           log] = object;
    member("submission", submission), member("lesson", lesson), member("isolation", isolation);
    member("fingerprint", fingerprint), member("unreadable", unreadable);
    store_text_with_message(member, "trouble", "stored_trouble", error_reason);
    member("began", began), member("silent", silent), member("printed", printed);
    store_text_with_message(member, "remark", "stored_remark", remark);
    member("checks", checks), member("late_hours", late_hours), member("penalty", penalty);
    store_text_with_message(member, "lateness", "stored_lateness", lateness);
    member("title", title), member("language", language);
    member("counts_instead", counts_instead), member("newest_counts", newest_counts);
}

}  // namespace dynlab::inline course
