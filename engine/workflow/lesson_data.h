#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "documents/run_record.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline workflow {

/// The simulated data sets among those that a run read, sorted: groups may have their own versions of these data sets.
std::vector<std::string> simulated_data_of(const RunRecord& record);

/// The data sets that the lesson's reference solution reads, regardless of how its script spells or computes their
/// names. The solution is run for this, without drawing figures, and the result is cached for the same script. Throws
/// EnvironmentError if the solution stops with an error.
std::vector<std::string> simulated_data_of(const Lesson& lesson);

/// Whether a lesson brings data along: a folder `data` with data sets (each a folder with SOURCE.md), or files .csv or
/// .mat beside its script.
bool has_own_data(const Lesson& lesson);

/// Copies these into a folder of data sets, which is made where there is none; a file NAME.csv becomes the data set
/// NAME.
void copy_own_data(const Lesson& lesson, const std::filesystem::path& data_folder);

}  // namespace dynlab::inline workflow
