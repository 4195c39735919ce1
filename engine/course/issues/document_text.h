#pragma once
#include <string>
#include <vector>

#include "documents/pdf/pdf_layout.h"

namespace dynlab::inline course {

/// Words next to each other in one line of a page. Page numbers and turned text (axis labels) are left out.
struct TextLine {
    int page = 1;  ///< 1-based
    double left = 0, top = 0, right = 0, bottom = 0, size = 0;
    bool bold = false, fixed_width = false;
    std::vector<std::string> words;
    std::string text() const;  ///< its words with spaces between them
    bool is_prose() const { return words.size() >= 5 && !fixed_width; }
};

struct Heading {
    int page = 1;
    double size = 0;
    std::string text;
    std::size_t first_line = 0, last_line = 0;  ///< of DocumentText::lines
};

/// A word of the running text; one that is hyphenated at the end of a line is whole.
struct TextWord {
    std::string text;
    int page = 1;
    std::size_t line = 0;
    bool starts_line = false;
};

/// The text of a document as a reader sees it.
struct DocumentText {
    double width = 0, height = 0;  ///< of the first page, points
    double body_size = 0;          ///< median font size of the prose, points; 0 without text
    std::vector<TextLine> lines;
    std::vector<Heading> headings;  ///< the title of the document is none
    std::vector<TextWord> words;    ///< without text in a fixed-width font, which is code
    bool is_slides() const { return width > height; }
};

DocumentText text_of_layout(const PdfLayout& layout);

}  // namespace dynlab::inline course
