#pragma once
#include <string_view>

#include "base/message.h"

namespace dynlab::inline scripting {

/// The present name of a function that was renamed; empty for every other name. Scripts with the earlier names run
/// until the end of 2027.
std::string_view present_name(std::string_view earlier);

/// The note for a script with an earlier name.
Message renamed(std::string_view earlier);

}  // namespace dynlab::inline scripting
