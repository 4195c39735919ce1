#pragma once
#include <string>
#include <vector>

#include "documents/percent_script.h"
#include "documents/run_record.h"

namespace dynlab::inline workflow {

/// A short guided demonstration: a literate script lessons/demos/NN_name.lua, shown page by page.
struct Demonstration {
    std::string name;  ///< "getting_started"
    std::filesystem::path script;
    std::string title;  ///< what one learns, from the script's header
};

/// All that are installed, in the order of their numbers. Throws DocumentError when a header cannot be read.
std::vector<Demonstration> demonstrations();

/// Throws EnvironmentError that suggests the nearest name, or lists all, for one that does not exist.
Demonstration find_demonstration(const std::string& name);

/// The text of a demonstration, for a terminal: one page for each code cell, with the text before it, the code (every
/// line marked with '>'), the printed text and the files of its figures. Text after the last code cell forms a separate
/// page. No page follows the cell in which an error stopped the run.
std::vector<std::string> pages_of(const PercentScript& script, const RunRecord& record);

}  // namespace dynlab::inline workflow
