#pragma once
#include "documents/complaints.h"
#include "documents/weave.h"

namespace dynlab::inline documents {

/// Formulas between \( and \) or \[ and \], which Markdown takes for escaped brackets and prints without a word: a
/// complaint for each line with one, outside code and formulas.
void find_latex_brackets(const MarkdownText& markdown, Complaints& complaints);

}  // namespace dynlab::inline documents
