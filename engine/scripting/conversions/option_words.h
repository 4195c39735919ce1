#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/message.h"

namespace dynlab::inline scripting {

/// The name that scripts have for an option of numerics, MaxIter for max_iterations; in backticks what is none. For
/// Reader::option_name.
std::string option_name(std::string_view member);
/// The message with these names in the place of its OptionName arguments, so that every reader sees them.
Message with_script_options(const Message& message);

/// The names of numerics' options that have one in scripts.
std::vector<std::string> translated_options();

/// About an option that is none of these.
Message unknown_option(const std::string& name, const std::vector<std::string>& known);
/// "zoh", "foh"
MessageList listed_in_quotes(const std::vector<std::string>& texts);

}  // namespace dynlab::inline scripting
