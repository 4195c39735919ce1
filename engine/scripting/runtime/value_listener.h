#pragma once
#include <functional>
#include <string>

namespace dynlab::inline scripting {

/// A service of programs that show values otherwise than text: hears of each just before it is printed, with its
/// formula in LaTeX where it has one.
struct ValueListener {
    std::function<void(const std::string& latex)> expect;
};

}  // namespace dynlab::inline scripting
