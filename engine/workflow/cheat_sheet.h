#pragma once
#include <filesystem>

namespace dynlab::inline workflow {

/// Creates a reference card of two pages from the help pages, as PDF. `output` is complete or unchanged. Throws
/// MissingProgram without pdflatex, EnvironmentError for another file type.
void make_cheat_sheet(const std::filesystem::path& output);

}  // namespace dynlab::inline workflow
