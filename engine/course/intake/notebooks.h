#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "course/intake/submission.h"

namespace dynlab::inline course {

/// Returns the script of a submitted notebook. A guarded child process reads the notebook, because it is untrusted
/// input.
/// Throws SubmissionError with a sentence for the student.
std::string script_of_submitted_notebook(const std::filesystem::path& notebook);

/// Replaces every analysis.ipynb in a private copy of a submission by analysis.lua with the same modification time. The
/// notebook, its outputs and its metadata are deleted. If a folder contains both files, the newer one is used.
/// Returns the folders whose script was a notebook.
/// Throws SubmissionError if a notebook cannot be read, or if both files differ and their times do not show which one
/// is newer.
std::vector<std::filesystem::path> take_notebooks(const std::filesystem::path& folder);

}  // namespace dynlab::inline course
