#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "documents/pdf/pdf_refusal.h"

namespace dynlab::inline documents {

/// A word and its place on the page: points from the upper left corner.
struct PdfWord {
    double left = 0, top = 0, right = 0, bottom = 0;
    double size = 0;  ///< of the font, in points
    bool bold = false, fixed_width = false, rotated = false;
    bool space_after = true;
    std::string text;  ///< UTF-8
};

struct PdfPage {
    double width = 0, height = 0;  ///< points
    std::vector<PdfWord> words;    ///< in reading order
};

struct PdfLayout {
    bool protected_by_password = false;  ///< readable, but a password guards changes
    std::vector<PdfPage> pages;
};

/// Limits for reading an untrusted file.
struct PdfLimits {
    std::uint64_t file_bytes = 100u << 20, memory_bytes = 1u << 30;
    int pages = 200, words = 200'000;
    std::chrono::milliseconds time{20'000};
};

/// Words and fonts of a PDF, as poppler finds them. A forked copy of this process with limits reads the file, so that a
/// hostile one can neither crash nor hang the caller. Throws PdfRefusal.
PdfLayout read_pdf_layout(const std::filesystem::path& file, const PdfLimits& limits = {});

/// The text of each page in the order in which its content prints it: slanted words, too, are whole. Throws PdfRefusal.
std::vector<std::string> text_in_content_order(const std::filesystem::path& file, const PdfLimits& limits = {});

/// Before many are read, while no other thread runs: has the libraries do once here what they do for the first PDF in a
/// process, so that no copy needs to.
void prepare_to_read_pdfs();

}  // namespace dynlab::inline documents
