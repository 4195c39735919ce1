#pragma once
#include <string>
#include <vector>

#include "documents/run_record.h"
#include "workflow/lesson_catalogue.h"

namespace dynlab::inline workflow {

/// The simulated data sets among those that a run read, sorted: groups may have records of their own of them.
std::vector<std::string> simulated_data_of(const RunRecord& record);

/// Those that the lesson's worked solution reads, however its script spells or computes their names: it is run for
/// this, its figures undrawn, and what it read is kept for the same script. Throws EnvironmentError where the solution
/// stops with an error.
std::vector<std::string> simulated_data_of(const Lesson& lesson);

}  // namespace dynlab::inline workflow
