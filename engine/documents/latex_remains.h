#pragma once
#include <set>
#include <string>

#include "documents/complaints.h"
#include "documents/weave.h"

namespace dynlab::inline documents {

/// The words after an escaped backslash: their authors want to see them unchanged.
std::set<std::string> escaped_commands(const MarkdownText& markdown);

/// "@key" of each \@key: text, not a citation.
std::set<std::string> escaped_citations(const std::string& text);

/// Formulas between \( and \) or \[ and \], which Markdown takes for escaped brackets and prints without a word: a
/// complaint for each line with one, outside code and formulas. Other text between escaped brackets is left alone.
void find_latex_brackets(const MarkdownText& markdown, Complaints& complaints);

}  // namespace dynlab::inline documents
