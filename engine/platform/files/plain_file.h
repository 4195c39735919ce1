#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "platform/system_call.h"

namespace dynlab::inline platform {

/// Files in a folder where somebody else may have put something in their place: a link is never followed, a pipe or a
/// device never waited for, and what is new is its owner's only.

/// Nothing where there is none, for what is no plain file, and for one of more than `most` bytes.
std::optional<std::string> read_plain_file(const std::filesystem::path& file, std::uintmax_t most);
/// Of a larger one the first `most` bytes; empty where there is none.
std::string start_of_plain_file(const std::filesystem::path& file, std::uintmax_t most);
/// For writing, made where there is none; `flags` such as O_APPEND. No descriptor where something else is in its place.
FileDescriptor open_plain_file(const std::filesystem::path& file, int flags = 0);
/// Whole or not at all, whatever was in its place before. Throws EnvironmentError as write_file_atomically does.
void write_plain_file(const std::filesystem::path& file, std::string_view content);

}  // namespace dynlab::inline platform
