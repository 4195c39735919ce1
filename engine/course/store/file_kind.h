#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace dynlab::inline course {

/// What kind of file it is, by its first bytes and its name's ending: "pdf", "pack" (zip or tar), "script" (.lua),
/// "text" (what a word processor writes: .docx, .odt, ...), or empty for anything else.
std::string kind_of_file(const std::string& name, std::string_view content);
/// The same of a file that can be read at `file` and was received under `name`. Throws EnvironmentError.
std::string kind_of_file_at(const std::string& name, const std::filesystem::path& file);

}  // namespace dynlab::inline course
