#include "app/kernel/kernel_spec.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kDescription = "kernel.json";

fs::path folder_in(const char* variable) {
    const char* const folder = std::getenv(variable);
    return folder == nullptr || *folder == '\0' ? fs::path() : fs::path(folder);
}

}  // namespace

fs::path kernels_folder(const std::string& prefix) {
    if (!prefix.empty()) return fs::path(prefix) / "share" / "jupyter" / "kernels";
    if (const fs::path data = folder_in("JUPYTER_DATA_DIR"); !data.empty()) return data / "kernels";
    if (const fs::path data = folder_in("XDG_DATA_HOME"); !data.empty()) return data / "jupyter" / "kernels";
    if (const fs::path home = folder_in("HOME"); !home.empty())
        return home / ".local" / "share" / "jupyter" / "kernels";
    return {};
}

fs::path install_kernel(const fs::path& folder, const fs::path& program) {
    if (folder.empty())
        throw EnvironmentError(
            "cannot find Jupyter's kernel folder, because HOME is not set. Set HOME, or give --prefix");
    const fs::path ours = folder / kKernelName;
    fs::create_directories(ours);
    const json description = {{"argv", {program.string(), "kernel", "run", "{connection_file}"}},
                              {"display_name", kKernelTitle},
                              {"language", kKernelLanguage},
                              {"interrupt_mode", "message"},
                              {"metadata", {{"debugger", false}}}};
    write_file_atomically(ours / kDescription, description.dump(1) + "\n");
    return ours / kDescription;
}

bool remove_kernel(const fs::path& folder) {
    const fs::path ours = folder / kKernelName;
    const bool there = fs::remove(ours / kDescription);
    std::error_code not_empty;
    fs::remove(ours, not_empty);
    return there;
}

std::optional<fs::path> installed_kernel() {
    for (const fs::path& folder : {kernels_folder(), kernels_folder("/usr/local"), kernels_folder("/usr")}) {
        const fs::path file = folder / kKernelName / kDescription;
        std::error_code none;
        if (folder.empty() || !fs::is_regular_file(file, none)) continue;
        const json description = json::parse(read_text(file), nullptr, false);
        if (!description.is_object()) continue;
        const json argv = description.value("argv", json());
        if (argv.is_array() && !argv.empty() && argv[0].is_string()) return argv[0].get<std::string>();
    }
    return {};
}

}  // namespace dynlab::inline app
