#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline data_io {

/// The text of a file's bytes in UTF-8 with \n between lines, from any program: UTF-8 and UTF-16 with or (UTF-8)
/// without byte order mark; bytes that are not UTF-8 are read as Windows-1252, which a sentence in `notes` reports.
/// Line ends of old Macs (CR alone) become \n; CR LF stays. Throws EnvironmentError for bytes that are no text; `file`
/// is for its message.
std::string decoded_text(const std::filesystem::path& file, std::string bytes, std::vector<Message>& notes);

}  // namespace dynlab::inline data_io
