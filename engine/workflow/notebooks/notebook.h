#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/message.h"
#include "documents/percent_script.h"
#include "documents/run_record.h"

namespace dynlab::inline workflow {

/// Jupyter notebooks (nbformat 4.5) are scripts in the percent format with outputs: every cell of the script is a cell
/// of the notebook, and the lines before its first marker, the header among them, are a code cell. A cell of a notebook
/// remembers in its metadata what its marker said, and the cell's very lines where they are not what would be written
/// again, so that a script comes back byte for byte; where a cell was changed since, what it says now counts.

bool is_notebook(const std::filesystem::path& file);  ///< by its ending, .ipynb

/// Jupyter's kernel that runs these notebooks, and the language it says it speaks.
inline constexpr const char* kKernelName = "dynlab";
inline constexpr const char* kKernelTitle = "dynlab (Lua)";
inline constexpr const char* kKernelLanguage = "lua";

/// The notebook of a script, without outputs or with those of a run (`figures`: names of the figures of the run
/// results, and the JSON of the data that a notebook shows for them, as figure_bundle() makes it).
std::string notebook_of(const PercentScript& script, const RunRecord* record = nullptr,
                        const std::map<std::string, std::string>& figures = {});

struct NotebookScript {
    std::string source;           ///< the script
    std::vector<Message> losses;  ///< what a script cannot hold
};

/// The script that a notebook contains. Messages use `name` as the file's name. Throws DocumentError for text that is
/// not JSON or no notebook, nbformat before 4, a notebook of another language, or one without cells.
NotebookScript script_of_notebook(std::string_view json, const std::filesystem::path& name);
/// Of a file, of at most 64 MB; what is larger is refused.
NotebookScript read_notebook(const std::filesystem::path& file);

/// A script, or the one that a notebook says.
PercentScript read_script_or_notebook(const std::filesystem::path& file);

/// "cell 3, line 2" for a line of the script that a notebook became; empty for the line of a marker.
Message place_in_notebook(const std::string& source, int line);
/// A message, or a text, in which every "SCRIPT:12" is "NOTEBOOK, cell 3, line 2", and SCRIPT is NOTEBOOK elsewhere.
Message with_places_in_notebook(const Message& message, const std::string& script, const std::string& notebook,
                                const std::string& source);
std::string with_places_in_notebook(const std::string& text, const std::string& script, const std::string& notebook,
                                    const std::string& source);

}  // namespace dynlab::inline workflow
