#pragma once
#include <filesystem>

#include "base/message.h"

namespace dynlab::inline platform {

/// What the standard library's functions for files throw, in the words of our own messages: "cannot make the folder
/// analysis_out: permission denied".
Message file_error_sentence(const std::filesystem::filesystem_error& error);

}  // namespace dynlab::inline platform
