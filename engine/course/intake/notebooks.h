#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "course/intake/submission.h"

namespace dynlab::inline course {

/// The script that a handed-in notebook says, read in a guarded child: the file is anybody's. Throws SubmissionError
/// with a sentence for the student.
std::string script_of_handed_in(const std::filesystem::path& notebook);

/// In a private copy of what was handed in: every analysis.ipynb becomes the analysis.lua beside it, as old as it was,
/// and goes, with its outputs and whatever its metadata say of people. Where both lie there, the newer holds. Returns
/// the folders whose script was a notebook. Throws SubmissionError: it cannot be read; both say different
/// things, and which is newer cannot be told.
std::vector<std::filesystem::path> take_notebooks(const std::filesystem::path& folder);

}  // namespace dynlab::inline course
