#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dynlab::inline workflow {

/// What a run, and the document of it, read: data files and pictures, by content, and which data files lie beside them
/// and beside the script, since `load` may prefer a new one. From path to a digest.
using InputsRead = std::map<std::string, std::string>;

InputsRead inputs_read(const std::vector<std::filesystem::path>& files, const std::filesystem::path& script_folder);
/// Whether all of it is there as it was.
bool unchanged(const InputsRead& inputs);

}  // namespace dynlab::inline workflow
