#pragma once
#include <string>

namespace dynlab::inline figures {

struct Figure;

/// The text with commas in its decimal numbers: "fit 93.2 %" becomes "fit 93,2 %"; "1.2.3" and "a.1" stay.
std::string with_decimal_commas(const std::string& text);

/// The figure as a French text wants it: the texts of the standard plots ("time (s)", "measured") in French, and commas
/// in the numbers of all texts. What somebody wrote by himself stays as it is. The numbers beside the axes are the
/// renderer's.
Figure in_french(const Figure& figure);

}  // namespace dynlab::inline figures
