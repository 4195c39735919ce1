#pragma once
#include <filesystem>
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
};

/// LaTeX refused the document: its first real complaint, the line of the body (1-based, 0 unknown) and the text of
/// that line up to where it stopped.
struct LatexRefusal : ErrorOf<std::runtime_error> {
    LatexRefusal(const Message& message, int body_line, std::string before)
        : ErrorOf(message), line(body_line), text_before(std::move(before)) {}
    int line;
    std::string text_before;
};

/// Runs pdflatex without shell, with reading and writing confined to the working folder, within limits of time and
/// memory, as often as page counts, contents and bookmarks need (once, when they are as in the run before). Returns
/// the PDF. A slide that has no room for what stands on it is refused. Throws LatexRefusal, MissingProgram.
std::filesystem::path run_latex(const LatexJob& job);

}  // namespace dynlab::inline documents
