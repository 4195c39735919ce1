#pragma once
#include <filesystem>

namespace dynlab::inline workflow {

/// Two pages to lay beside the keyboard, made from the help pages, as PDF. `output` appears whole or stays as it was.
/// Throws MissingProgram without pdflatex, EnvironmentError for another kind of file.
void make_cheat_sheet(const std::filesystem::path& output);

}  // namespace dynlab::inline workflow
