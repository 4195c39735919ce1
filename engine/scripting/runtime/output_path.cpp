#include "scripting/runtime/output_path.h"

#include <algorithm>

#include "numerics/error.h"
#include "platform/error.h"
#include "platform/written_files.h"
#include "scripting/runtime/context.h"

namespace dynlab::inline scripting {

namespace fs = std::filesystem;

bool is_below_folder(const fs::path& path, const fs::path& folder) {
    const fs::path root = fs::weakly_canonical(fs::absolute(folder)), file = fs::weakly_canonical(fs::absolute(path));
    const auto [end, rest] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
    return end == root.end() || (std::next(end) == root.end() && end->empty());
}

fs::path output_path(const RuntimeContext& context, const std::string& path) {
    if (path.empty() || path.find('\0') != std::string::npos)
        throw InvalidArgument("the path of a file to write must not be empty");
    const fs::path file = fs::weakly_canonical(fs::absolute(context.options.out_folder / path));
    if (!is_below_folder(file, context.options.out_folder) && !is_below_folder(file, context.options.script_folder))
        throw InvalidArgument(
            "'{}' is outside the script's folder and the output folder; scripts can write only to these folders and "
            "their subfolders",
            path);
    if (context.services.written != nullptr) context.services.written->take(file);
    std::error_code failure;
    fs::create_directories(file.parent_path(), failure);
    if (failure)
        throw EnvironmentError("the folder {} cannot be created: {}", file.parent_path().string(), failure.message());
    return file;
}

}  // namespace dynlab::inline scripting
