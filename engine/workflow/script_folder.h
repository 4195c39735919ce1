#pragma once
#include <filesystem>

namespace dynlab::inline workflow {

/// Converts a single script or notebook to the folder that students submit, in `folder`, which is empty: the script as
/// analysis.lua, a report.md that shows its cells under its title, the files next to it or in subfolders that it names
/// (data and modules in quotes, pictures in its text), and, as report.pdf, the PDF with its name. Throws
/// EnvironmentError, DocumentError as read_percent_script() does.
void make_script_folder(const std::filesystem::path& script, const std::filesystem::path& folder);

}  // namespace dynlab::inline workflow
