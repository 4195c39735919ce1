#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline course {

/// What kind of file it is that can be read at `file` and was received under `name`, by its first bytes and its name's
/// ending: "pdf", "pack" (zip or tar), "script" (.lua), "text" (what a word processor writes: .docx, .odt, ...), or
/// empty for anything else. Throws EnvironmentError.
std::string kind_of_file_at(const std::string& name, const std::filesystem::path& file);

}  // namespace dynlab::inline course
