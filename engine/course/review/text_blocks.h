#pragma once
#include <string>
#include <vector>

#include "course/findings/document_text.h"

namespace dynlab::inline course {

/// A paragraph, an item of a list, a heading, or a line of code.
struct TextBlock {
    std::string text;  ///< on one line; words that were hyphenated at a line's end are whole again
    int page = 1;
    bool heading = false, item = false;
};

/// The text of a PDF in blocks, as the distances of its lines, indents and the marks of list items tell them. What goes
/// on after a page's end is one block.
std::vector<TextBlock> text_blocks(const DocumentText& text);

}  // namespace dynlab::inline course
