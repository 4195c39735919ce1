#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "documents/percent_script.h"
#include "documents/run_record.h"

namespace dynlab::inline platform {
class Cache;
}

namespace dynlab::inline workflow {

/// The help pages as scripts in cells: text, and the example of a function's page as code that was run.
struct HelpExamples {
    std::map<std::string, PercentScript> pages;  ///< by name of the page; its cell of code is called like the page
    RunRecord record;  ///< of all examples: cells by page, figures as "page-figure", without captions
};

/// Runs the example of every function's page, each as a separate script, in `folder`. Throws DocumentError that names
/// the page whose example fails.
HelpExamples run_help_examples(const std::filesystem::path& folder, const Cache& cache);

}  // namespace dynlab::inline workflow
