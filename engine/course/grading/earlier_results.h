#pragma once
#include <filesystem>
#include <optional>

#include "course/grading/grade.h"
#include "course/grading/grading.h"

namespace dynlab::inline course {

/// What an earlier run wrote into a submission's folder of results; nothing where there is none that can be read.
std::optional<Grade> earlier_grade(const std::filesystem::path& folder);

/// Throws EnvironmentError where the results in request.out are those of another lesson. Makes the folder.
void refuse_other_lessons(const GradingRequest& request);

/// Writes what the results in request.out are made with (GradingMemory). Throws EnvironmentError where those that are
/// there were made with something else and are not to be made again: marks of two kinds never stand side by side.
void remember_inputs(const GradingRequest& request);

}  // namespace dynlab::inline course
