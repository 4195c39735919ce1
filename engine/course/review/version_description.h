#pragma once
#include "course/review/version_reading.h"
#include "course/sandbox_jobs/job_descriptions.h"

namespace dynlab::inline course {

/// The job that reads a version, as data_io/values/described.h stores it.

DYNLAB_DESCRIBE(VersionJob, folder, to, pdf)

}  // namespace dynlab::inline course
