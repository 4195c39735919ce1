#pragma once
#include "course/grading/grade_class.h"

namespace dynlab::inline cli {

/// Notes and complaints, on standard error.
void show_complaints(const GradingOutcome& outcome);

/// Prints what came of grading; returns the exit code.
int show_grading(const GradingOutcome& outcome, Isolation isolation, const std::filesystem::path& out, bool pdf);

}  // namespace dynlab::inline cli
