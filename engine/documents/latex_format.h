#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline documents {

/// The name of the precompiled preamble: pdflatex -fmt=dynlab.
inline constexpr char kLatexFormatName[] = "dynlab";

/// The layouts of report_templates/latex: which preamble, and its language ("en", "fr").
struct LatexLayout {
    std::filesystem::path shared_templates;  ///< the folder report_templates
    std::string language = "en";
    bool slides = false;
};

/// Writes preamble.tex, and what it reads, into `folder`.
void write_preamble(const LatexLayout& layout, const std::filesystem::path& folder);

/// The cache folder that holds dynlab.fmt for this layout, these templates and the TeX that is installed; made
/// when it is not there (about a second). Throws MissingProgram when pdflatex or a LaTeX package is missing.
std::filesystem::path latex_format_folder(const LatexLayout& layout);

/// Makes dynlab.fmt in `folder` itself, beside no cache.
void make_latex_format(const LatexLayout& layout, const std::filesystem::path& folder);

/// Throws MissingProgram when a log says that a LaTeX package or the babel language is not installed.
void check_missing_packages(const std::string& log);

}  // namespace dynlab::inline documents
