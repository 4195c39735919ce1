#pragma once
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "documents/latex_format.h"

namespace dynlab::inline documents {

struct LatexJob {
    std::string body;  ///< from \begin{document} on
    LatexLayout layout;
    std::filesystem::path work_folder;  ///< private; holds the pictures the body names
    std::string identity;               ///< of the document: its auxiliary files are kept under this name
    bool use_cache = true;
    std::filesystem::path format_folder;  ///< made by make_latex_format for this layout; empty: the cache's, or none
    std::vector<std::pair<std::string, double>>* timings = nullptr;
    CachedLatexFormat* begun_format = nullptr;  ///< the cache's for this layout, where it was begun before
    std::filesystem::path lualatex_fonts = {};  ///< made by make_lualatex_fonts; empty: the cache's, or none
};

/// A document, and what became of letters that pdflatex does not have.
struct LatexDocument {
    std::filesystem::path pdf;
    std::optional<char32_t> first_beyond;  ///< the first letter that pdflatex cannot set, if any
    bool by_lualatex = false;              ///< LuaLaTeX set the document; false where it is not installed
    std::set<char32_t> replaced;           ///< letters that no font has: "?" is in their places
};

/// LaTeX refused the document: its first real complaint, the line of the body (1-based, 0 unknown) and the text of
/// that line up to where it stopped.
struct LatexRefusal : ErrorOf<std::runtime_error> {
    LatexRefusal(const Message& message, int body_line, std::string before)
        : ErrorOf(message), line(body_line), text_before(std::move(before)) {}
    int line;
    std::string text_before;
};

/// Where LuaLaTeX looks for Noto's fonts, a search path.
inline constexpr char kNotoFolders[] = "/usr/share/fonts/truetype/noto:/usr/share/fonts/opentype/noto";

/// The programs and fonts for letters that pdflatex does not have.
inline constexpr char kLualatexPackages[] = "texlive-luatex fonts-noto-core fonts-noto-cjk";

/// Runs pdflatex, or LuaLaTeX for a text with letters that pdflatex does not have: without shell, with reading and
/// writing confined to the working folder, within limits of time and memory, as often as page counts, contents and
/// bookmarks need (once, when they are as in the run before). A slide that has no room for its content is refused.
/// Throws LatexRefusal, MissingProgram.
LatexDocument run_latex(const LatexJob& job);

/// Reads the fonts that LuaLaTeX needs for these scripts (scripts_of), which takes seconds, and keeps what it needs of
/// them in `folder`. Does nothing where LuaLaTeX is not installed.
void make_lualatex_fonts(const LatexLayout& layout, const std::set<std::string>& scripts,
                         const std::filesystem::path& folder);

}  // namespace dynlab::inline documents
