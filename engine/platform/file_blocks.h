#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

#include "platform/system_call.h"

namespace dynlab::inline platform {

/// Throws EnvironmentError with file and reason ("cannot read x.csv: is a directory").
[[noreturn]] void fail_to_read(const std::filesystem::path& file, int error_number);

FileDescriptor open_to_read(const std::filesystem::path& file);  ///< throws EnvironmentError

/// Calls `take` with one block of the file after the other. Throws EnvironmentError when the file cannot be read.
void for_each_block(const std::filesystem::path& file, const std::function<void(std::string_view)>& take);

}  // namespace dynlab::inline platform
