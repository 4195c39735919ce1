#pragma once
#include "course/grading/grade_class.h"

namespace dynlab::inline cli {

/// Prints what came of grading; returns the exit code.
int show_grading(const GradingOutcome& outcome, Isolation isolation, const std::filesystem::path& out, bool pdf);

}  // namespace dynlab::inline cli
