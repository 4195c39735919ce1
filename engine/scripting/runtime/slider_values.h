#pragma once
#include <map>
#include <string>

namespace dynlab::inline scripting {

/// A service of the runtime: what was chosen instead of the numbers that a script gives its sliders, by their names.
struct SliderValues {
    std::map<std::string, double> chosen;
    bool clamped = false;  ///< what lies outside a slider's range is its nearest end, not an error
};

}  // namespace dynlab::inline scripting
