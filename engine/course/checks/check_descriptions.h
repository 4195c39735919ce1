#pragma once
#include "course/checks/check_run.h"
#include "course/issues/issue_description.h"
#include "course/sandbox_jobs/job_descriptions.h"

namespace dynlab::inline course {

/// Checks, what they are tried on and what they say, as data_io/values/described.h stores them.

DYNLAB_DESCRIBE(CheckFile, name, source, visible)
DYNLAB_DESCRIBE(AnswerChange, name, factor)
DYNLAB_DESCRIBE(CheckedSubmission, runs, findings, source, change)
DYNLAB_DESCRIBE(CheckDescription, id, about, hint, points, rerun, document, by_hand, rubric, visible)
DYNLAB_DESCRIBE(EvaluatedCheck, check, share, message, for_instructor, seconds)
DYNLAB_DESCRIBE(SubmissionToGrade, work, home, variants)
DYNLAB_DESCRIBE(GradedSubmission, checks, reason, seconds)
template <Is<CheckResults> T, class V>
void describe(T& object, V& member) {
    auto& [checks, judged, plants, data_sets, error] = object;
    member("checks", checks), member("judged", judged), member("plants", plants);
    member("records", data_sets), member("error", error);
}
DYNLAB_DESCRIBE(RequestedDataSet, plant, variant, seed)
template <Is<ChecksJob> T, class V>
void describe(T& object, V& member) {
    auto& [files, hidden_folder, time_ms, most_ms, clock_multiple, only, submissions, data_sets] = object;
    member("files", files), member("hidden_folder", hidden_folder), member("time_ms", time_ms);
    member("most_ms", most_ms), member("clock_multiple", clock_multiple), member("only", only);
    member("submissions", submissions), member("records", data_sets);
}

}  // namespace dynlab::inline course
