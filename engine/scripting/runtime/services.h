#pragma once
#include <functional>
#include <map>
#include <string>

namespace dynlab::inline scripting {

/// A service of the runtime: the language of the document that is made, for report.language(); "en" without it.
struct ReportLanguage {
    std::string code = "en";
};

/// A service of the runtime: what was chosen instead of the numbers that a script gives its sliders, by their names.
struct SliderValues {
    std::map<std::string, double> chosen;
    bool clamped = false;  ///< what lies outside a slider's range is its nearest end, not an error
};

/// A service of programs that show values otherwise than text: hears of each just before it is printed, with its
/// formula in LaTeX where it has one.
struct ValueListener {
    std::function<void(const std::string& latex)> expect;
};

}  // namespace dynlab::inline scripting
