#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace dynlab::inline platform {

/// The content of a text file, without the byte order mark that some editors put before UTF-8: it is not part of the
/// first line. Throws EnvironmentError as read_file does.
std::string read_text(const std::filesystem::path& file);
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace dynlab::inline platform
