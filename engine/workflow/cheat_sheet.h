#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline workflow {

/// From \begin{document} on: every function with its summary, area by area, then the phrases of the page "matlab".
std::string cheat_sheet_latex();

/// Two pages to lay beside the keyboard, made from the help pages, as PDF. `output` appears whole or stays as it was.
/// Throws MissingProgram without pdflatex, EnvironmentError for another kind of file.
void make_cheat_sheet(const std::filesystem::path& output);

}  // namespace dynlab::inline workflow
