#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "base/message.h"
#include "documents/run_record.h"

namespace dynlab::inline course {

/// The message with `change` made to its text. It stays translatable where changing its text arguments alone has that
/// effect; else the changed text is verbatim.
Message with_changed_text(const Message& message, const std::function<std::string(const std::string&)>& change);

/// Converts a message from a sandbox for the author of the work in `folder`: file names are relative to the work
/// ("analysis.lua:98: ..."), and the name of the program is removed.
std::string without_sandbox_paths(const std::string& said, const std::filesystem::path& folder);
Message without_sandbox_paths(const Message& said, const std::filesystem::path& folder);

/// The message of an error with its place: "analysis.lua:98: ...".
Message with_place(const RecordedError& error);

/// The message of an error, truncated if it is long.
Message shortened_error(const Message& error_reason);

/// The text without its full stop, for use inside another sentence.
std::string without_full_stop(std::string text);

}  // namespace dynlab::inline course
