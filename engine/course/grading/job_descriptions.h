#pragma once
#include "course/checks/check_run.h"
#include "course/findings/finding_description.h"
#include "course/grading/boxed_document.h"
#include "course/grading/graded_run.h"
#include "course/grading/unpack.h"
#include "course/review/version_reading.h"
#include "documents/record_description.h"

namespace dynlab::inline course {

/// Jobs for boxes and what comes of them, as data_io/values/described.h stores them.

DYNLAB_DESCRIBE(GradedRun, answers, figures, values, printed, error, seconds, lesson, began)
DYNLAB_DESCRIBE(RunJob, script, french_sentences, seed, answers, time_ms, memory_bytes, recalls)
DYNLAB_DESCRIBE(CheckFile, name, source, visible)
DYNLAB_DESCRIBE(AnswerChange, name, factor)
DYNLAB_DESCRIBE(CheckedSubmission, runs, findings, source, change)
DYNLAB_DESCRIBE(CheckDescription, id, about, hint, points, rerun, document, by_hand, rubric, visible)
DYNLAB_DESCRIBE(TriedCheck, check, share, message, for_instructor, seconds)
DYNLAB_DESCRIBE(SubmissionToJudge, work, home, specimens)
DYNLAB_DESCRIBE(JudgedSubmission, checks, reason, seconds)
DYNLAB_DESCRIBE(CheckResults, checks, judged, rigs, records, error)
DYNLAB_DESCRIBE(WantedRecord, rig, specimen, seed)
DYNLAB_DESCRIBE(ChecksJob, files, hidden_folder, time_ms, most_ms, only, submissions, records)
DYNLAB_DESCRIBE(Unpacked, left_out, error)
DYNLAB_DESCRIBE(UnpackJob, archive, to, bytes, files, keep_times)

template <Is<DocumentJob> T, class V>
void describe(T& object, V& member) {
    auto& [template_name, metadata, record, latex_format, to] = object;
    member("template", template_name), member("metadata", metadata), member("record", record);
    member("latex_format", latex_format), member("to", to);
}

DYNLAB_DESCRIBE(VersionJob, folder, to, pdf)
DYNLAB_DESCRIBE(BoxedOutcome, error)

}  // namespace dynlab::inline course
