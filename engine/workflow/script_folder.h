#pragma once
#include <filesystem>

namespace dynlab::inline workflow {

/// Makes of a script or notebook that stands alone what students hand in, in `folder`, which is empty: the script as
/// analysis.lua, a report.md that shows its cells under its title, the files beside it or in folders there that it
/// names (data and modules in quotes, pictures in its text), and, as report.pdf, the PDF that bears its name. Throws
/// EnvironmentError, DocumentError as read_percent_script().
void make_script_folder(const std::filesystem::path& script, const std::filesystem::path& folder);

}  // namespace dynlab::inline workflow
