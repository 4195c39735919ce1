#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "platform/sandbox.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline course {

struct SimilarityRequest {
    Lesson lesson;                      ///< its starter does not count, its reference solution is compared
    std::filesystem::path submissions;  ///< a folder or a platform's zip, as ClassSubmissions takes them
    std::filesystem::path out;
    std::vector<std::filesystem::path> others;  ///< former years' submissions (folder or zip), or folders of scripts
    double line = 0.6;                          ///< least share of a reported pair
    Isolation isolation = Isolation::kFull;
    std::filesystem::path program;  ///< dynlab
};

struct SimilarityOutcome {
    std::size_t scripts = 0, groups = 0, pairs = 0;  ///< groups: three or more copies; pairs: of what is in none
    std::vector<Message> complaints;                 ///< whole sentences: what could not be compared
};

/// Compares the scripts of a class with one another, with the reference solution and with other scripts, and writes
/// similarity.md and similarity.csv into `out`. Throws EnvironmentError if there are no submissions.
SimilarityOutcome compare_class(const SimilarityRequest& request);

}  // namespace dynlab::inline course
