#include "platform/locks/complete_folder.h"

#include <cerrno>
#include <system_error>

#include "platform/error.h"
#include "platform/files/ends_with_program.h"
#include "platform/locks/in_use.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

/// An empty folder in use, with the permissions that the umask grants: those of make_folder_in_use are private.
fs::path new_folder_in(const fs::path& parent, std::error_code& error) {
    const std::string beginning = prefix_in_use(".new-");
    fs::create_directories(parent, error);
    remove_unused(parent, beginning, Leftovers::kFolders);
    const fs::path made = make_folder_in_use(parent, beginning);
    if (made.empty()) {
        error.assign(errno, std::generic_category());
        return made;
    }
    const fs::path ordinary = made / "ordinary";
    if (fs::create_directory(ordinary, error)) fs::permissions(made, fs::status(ordinary).permissions(), error);
    fs::remove(ordinary, error);
    return made;
}

}  // namespace

void make_complete_folder(const fs::path& folder, const std::function<void(const fs::path&)>& fill) {
    const auto refuse_if_taken = [&folder] {
        if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder)))
            throw EnvironmentError(
                "{} already exists and is not an empty folder. Nothing was changed; give another name",
                folder.string());
    };
    refuse_if_taken();
    const fs::path target = fs::absolute(folder).lexically_normal();
    const fs::path clean = target.has_filename() ? target : target.parent_path();
    std::error_code error;
    const fs::path growing = new_folder_in(clean.parent_path(), error);
    if (growing.empty()) throw EnvironmentError("cannot create the folder {}: {}", folder.string(), error.message());
    const EndsWithProgram ends(growing);
    try {
        fill(growing);
        refuse_if_taken();  // by another process meanwhile
        fs::rename(growing, clean);
    } catch (...) {
        fs::remove_all(growing, error);
        release_folder_in_use(growing);
        throw;
    }
    release_folder_in_use(growing);
}

}  // namespace dynlab::inline platform
