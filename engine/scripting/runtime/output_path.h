#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline scripting {

struct RuntimeContext;

/// Where a script may write `path`: relative paths count from the output folder; the result lies below it or below the
/// script's folder, symbolic links followed. Makes missing folders in between. Throws InvalidArgument for other places,
/// EnvironmentError for files that are not to be replaced (Services::written).
std::filesystem::path output_path(const RuntimeContext& context, const std::string& path);

/// Whether a path, links resolved, lies in a folder or below it.
bool is_below_folder(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace dynlab::inline scripting
