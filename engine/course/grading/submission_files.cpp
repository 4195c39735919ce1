#include "course/grading/submission_files.h"

#include "course/grading/pack_file.h"
#include "course/intake/folder_copy.h"
#include "course/intake/notebooks.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxPackedBytes = 200ull << 20;
constexpr int kMaxFiles = 2000;

}  // namespace

Pack pack_folder(const fs::path& folder, const fs::path& file) {
    const auto has = [&](const char* name) { return fs::is_regular_file(fs::symlink_status(folder / name)); };
    if (!has("analysis.lua") && !has("analysis.ipynb"))
        throw EnvironmentError("{} has no analysis.lua; pack the folder that dynlab new created", folder.string());
    const TemporaryFolder copy;
    const FolderCopy copied = copy_folder(folder, copy.path(), kMaxPackedBytes, kMaxFiles);
    if (copied.too_large)
        throw EnvironmentError(
            "{} is too large: a submission can have at most {} files and {} MB. "
            "Remove files that the report does not need",
            folder.string(), kMaxFiles, kMaxPackedBytes >> 20);
    take_notebooks(copy.path());
    PackFile made = pack_of(contents_of(copy.path()));
    write_file_atomically(file, made.bytes);
    return {std::move(made.files), copied.left_out, sha256_of(made.bytes)};
}

}  // namespace dynlab::inline course
