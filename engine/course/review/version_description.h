#pragma once
#include "course/boxes/job_descriptions.h"
#include "course/review/version_reading.h"

namespace dynlab::inline course {

/// The job that reads a version, as data_io/values/described.h stores it.

DYNLAB_DESCRIBE(VersionJob, folder, to, pdf)

}  // namespace dynlab::inline course
