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
DYNLAB_DESCRIBE(SubmissionToGrade, work, home, specimens)
DYNLAB_DESCRIBE(GradedSubmission, checks, reason, seconds)
DYNLAB_DESCRIBE(CheckResults, checks, judged, rigs, records, error)
DYNLAB_DESCRIBE(RequestedRecord, rig, specimen, seed)
DYNLAB_DESCRIBE(ChecksJob, files, hidden_folder, time_ms, most_ms, clock_multiple, only, submissions, records)

}  // namespace dynlab::inline course
