#pragma once
#include <string>
#include <string_view>

namespace dynlab::inline documents {

/// The content of a page or a form (ISO 32000-1, 8 and annex A) without the operators that build, paint and clip by
/// paths, and their numbers: curves of a figure are most of its content, and no text. All else stays byte by byte; from
/// the first picture among the operators on, everything does. A content of faulty form stays as it is, for readers
/// differ in what they make of it: an operator in an array, paths within BT ... ET and texts without, wrong numbers.
std::string without_paths(std::string_view content);

}  // namespace dynlab::inline documents
