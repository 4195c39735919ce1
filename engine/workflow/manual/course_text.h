#pragma once
#include <filesystem>
#include <string>

#include "documents/run_record.h"
#include "documents/weave.h"

namespace dynlab::inline platform {
class Cache;
}

namespace dynlab::inline workflow {

/// All lessons as students get them, as a part of one document.
struct CourseText {
    MarkdownText markdown;     ///< a heading of the first level for each lesson, its own are one level lower
    RunRecord record;          ///< of all of them, figures drawn as PDF; names begin with that of their lesson
    std::string bibliography;  ///< BibTeX, each entry once
};

/// Runs the lessons that `cache` does not know; figures are drawn into `folder`. Throws DocumentError for a lesson that
/// cannot be run.
CourseText course_text(const std::filesystem::path& folder, const Cache& cache);

}  // namespace dynlab::inline workflow
