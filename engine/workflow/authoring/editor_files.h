#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dynlab::inline workflow {

/// What editors want beside a student's scripts, below a folder: stubs of dynlab's functions and the settings that make
/// the language server for Lua (LuaLS) read them, tasks of VS Code whose problem matcher finds the lines that messages
/// name, and an .editorconfig. Files that are there with another text stay as they are; their names are given back.
std::vector<std::string> write_editor_files(const std::filesystem::path& folder);

}  // namespace dynlab::inline workflow
