#pragma once
#include <cstddef>

namespace dynlab::inline platform {

/// The longest text that may be given to std::regex where anybody can have written it: matching takes stack for every
/// character, and a line of some 20,000 of them would end the program.
inline constexpr std::size_t kLongestForRegex = 4000;

}  // namespace dynlab::inline platform
