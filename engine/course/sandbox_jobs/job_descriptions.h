#pragma once
#include "course/sandbox_jobs/graded_run.h"
#include "course/sandbox_jobs/sandboxed_document.h"
#include "course/sandbox_jobs/unpack.h"
#include "data_io/values/message_values.h"
#include "documents/record_description.h"

namespace dynlab::inline course {

/// Jobs for sandboxes and their results, as data_io/values/described.h stores them. Jobs of checks are described in
/// checks/check_descriptions.h, the job of a report's version in review/version_description.h.

DYNLAB_DESCRIBE(GradedRun, answers, figures, values, printed, error, seconds, lesson, began)
DYNLAB_DESCRIBE(RunJob, script, seed, answers, time_ms, memory_bytes, recalls)
DYNLAB_DESCRIBE(Unpacked, left_out, error)
DYNLAB_DESCRIBE(UnpackJob, archive, to, bytes, files, keep_times)

template <Is<DocumentJob> T, class V>
void describe(T& object, V& member) {
    auto& [template_name, metadata, record, latex_format, lualatex_fonts, to] = object;
    member("template", template_name), member("metadata", metadata), member("record", record);
    member("latex_format", latex_format), member("lualatex_fonts", lualatex_fonts), member("to", to);
}

DYNLAB_DESCRIBE(SandboxOutcome, error, notes)

}  // namespace dynlab::inline course
