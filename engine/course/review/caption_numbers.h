#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "course/review/report_text.h"

namespace dynlab::inline course {

/// Which figure and table of one version is which of another: those with the same caption.
class CaptionNumbers {
  public:
    CaptionNumbers(const ReportText& before, const ReportText& after);

    /// "Figure 2" and "Figure 3", of those whose number changed.
    std::vector<std::pair<std::string, std::string>> changed() const;
    /// A text of the first version with the numbers of the second: "see (Figure 2)" -> "see (Figure 3)".
    std::string renumbered(const std::string& text) const;

  private:
    std::map<std::pair<std::string, std::string>, std::string> numbers_;  ///< by label and number; changed ones only
};

}  // namespace dynlab::inline course
