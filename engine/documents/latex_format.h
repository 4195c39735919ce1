#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "documents/words/characters.h"
#include "platform/cache.h"
#include "platform/child_process.h"

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

/// A search path of TeX: the working folder, what a layout's own LaTeX names beside it, TeX's files.
std::string template_files(const LatexLayout& layout);

/// The letters that the preamble declares to pdflatex.
PrintableCharacters printable_by_pdflatex(const std::filesystem::path& shared_templates);

/// The cache's format for a layout, its templates and the TeX that is installed. Where the cache has none, TeX begins
/// with it at once (it takes about a second) and works while the caller does something else.
class CachedLatexFormat {
  public:
    /// Throws MissingProgram without pdflatex.
    explicit CachedLatexFormat(const LatexLayout& layout);
    ~CachedLatexFormat();
    CachedLatexFormat(const CachedLatexFormat&) = delete;
    CachedLatexFormat& operator=(const CachedLatexFormat&) = delete;

    /// The folder that holds dynlab.fmt, once it is made. Throws MissingProgram when a LaTeX package is missing.
    std::filesystem::path folder();

  private:
    Cache cache_;
    std::string name_;
    std::optional<std::filesystem::path> folder_;
    std::filesystem::path prepared_;
    std::optional<ChildProcess> tex_;
};

/// Makes dynlab.fmt in `folder` itself, beside no cache.
void make_latex_format(const LatexLayout& layout, const std::filesystem::path& folder);

/// Throws MissingProgram when a log says that a LaTeX package or the babel language is not installed.
void check_missing_packages(const std::string& log);

}  // namespace dynlab::inline documents
