#pragma once
#include <filesystem>
#include <string>

namespace dynlab {

/// The name of the precompiled preamble: pdflatex -fmt=dynlab.
inline constexpr char kLatexFormatName[] = "dynlab";

/// Writes preamble.tex and characters.tex of report_templates/latex, set for `language` ("en", "fr"), into `folder`.
void write_preamble(const std::filesystem::path& shared_templates, const std::string& language,
                    const std::filesystem::path& folder);

/// The cache folder that holds dynlab.fmt for this language, these templates and the TeX that is installed; made
/// when it is not there (about a second). Throws MissingProgram when pdflatex or a LaTeX package is missing.
std::filesystem::path latex_format_folder(const std::filesystem::path& shared_templates, const std::string& language);

/// Throws MissingProgram when a log says that a LaTeX package or the babel language is not installed.
void check_missing_packages(const std::string& log);

}  // namespace dynlab
