#pragma once
#include <string>
#include <vector>

#include "base/message.h"
#include "base/reader.h"

namespace dynlab::inline scripting {

/// The message with the reader's names of options for its OptionName arguments, for every later reader.
Message with_script_options(const Message& message, const Reader& reader);

/// About an option that is none of these.
Message unknown_option(const std::string& name, const std::vector<std::string>& known);
/// "zoh", "foh"
MessageList listed_in_quotes(const std::vector<std::string>& texts);

}  // namespace dynlab::inline scripting
