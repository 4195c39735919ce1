#pragma once
#include <string>

#include "base/reader.h"

namespace dynlab::inline figures {

struct Figure;

/// The figure as its reader sees it: all texts verbatim in the language. Where that has commas in its decimal numbers,
/// those that authors wrote get them, too. The numbers beside the axes are the renderer's.
Figure readable(const Figure& figure, const Reader& reader);

bool has_decimal_comma(const Reader& reader);

/// The text with commas in its decimal numbers: "fit 93.2 %" becomes "fit 93,2 %"; "1.2.3" and "a.1" stay.
std::string with_decimal_commas(const std::string& text);

}  // namespace dynlab::inline figures
