#include "platform/files/whole_folder.h"

#include <system_error>

#include "platform/error.h"

namespace dynlab::inline platform {

namespace fs = std::filesystem;

void make_whole_folder(const fs::path& folder, const std::function<void(const fs::path&)>& fill) {
    if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder)))
        throw EnvironmentError("{} exists already; choose another name, nothing was changed", folder.string());
    const fs::path target = fs::absolute(folder).lexically_normal();
    const fs::path clean = target.has_filename() ? target : target.parent_path();
    const fs::path growing = clean.parent_path() / ("." + clean.filename().string() + ".new");
    std::error_code error;
    fs::remove_all(growing, error);
    if (!fs::create_directories(growing, error))
        throw EnvironmentError("cannot make the folder {}: {}", folder.string(), error.message());
    try {
        fill(growing);
        fs::rename(growing, clean);
    } catch (...) {
        fs::remove_all(growing, error);
        throw;
    }
}

}  // namespace dynlab::inline platform
