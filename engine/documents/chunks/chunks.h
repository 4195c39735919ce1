#pragma once
#include <string>
#include <vector>

#include "documents/weave.h"

namespace dynlab::inline documents {

/// A piece of a document that can be set separately: paragraphs, a whole list, table, block or formula.
struct Chunk {
    std::string markdown;
    Place origin;                       ///< of its first line
    int first_line = 1, last_line = 1;  ///< in the document's Markdown
};

/// The document cut where a line at the margin begins after an empty one, but for what only reads right together:
/// lists, fenced blocks, comments, tables with empty lines and captions. Chunks one after another are the document.
std::vector<Chunk> chunks_of(const MarkdownText& markdown);

}  // namespace dynlab::inline documents
