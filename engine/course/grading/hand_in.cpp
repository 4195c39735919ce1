#include "course/grading/hand_in.h"

#include <map>

#include "course/boxes/zip_file.h"
#include "course/intake/folder_copy.h"
#include "course/intake/notebooks.h"
#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {
namespace {

/// What the manifest of a pack says of a file.
struct PackedFile {
    std::uint64_t bytes;
    std::string sha256;
};

struct Manifest {
    int format = 1;
    std::map<std::string, PackedFile> files = {};
};

DYNLAB_DESCRIBE(PackedFile, bytes, sha256)
DYNLAB_DESCRIBE(Manifest, format, files)

namespace fs = std::filesystem;

constexpr std::uint64_t kMostPackedBytes = 200ull << 20;
constexpr int kMostFiles = 2000;
constexpr char kManifest[] = "MANIFEST.json";

}  // namespace

Pack pack_folder(const fs::path& folder, const fs::path& file) {
    const auto has = [&](const char* name) { return fs::is_regular_file(fs::symlink_status(folder / name)); };
    if (!has("analysis.lua") && !has("analysis.ipynb"))
        throw EnvironmentError("{} has no analysis.lua; pack the folder that dynlab new made", folder.string());
    const TemporaryFolder copy;
    const FolderCopy copied = copy_folder(folder, copy.path(), kMostPackedBytes, kMostFiles);
    if (copied.too_large)
        throw EnvironmentError("{} is too large: a submission has at most {} files and {} MB", folder.string(),
                               kMostFiles, kMostPackedBytes >> 20);
    take_notebooks(copy.path());
    std::map<std::string, std::string> contents = contents_of(copy.path());
    std::erase_if(contents, [](const auto& entry) {
        return entry.first.ends_with(".zip") || entry.first == kManifest ||
               entry.first.starts_with(std::string(kFiguresOfRuns) + "/");
    });
    Pack pack;
    pack.left_out = copied.left_out;
    Manifest manifest;
    for (const auto& [name, content] : contents) {
        pack.files.push_back(name);
        manifest.files[name] = {content.size(), sha256_of(content)};
    }
    contents[kManifest] = json_of(manifest, 2) + "\n";
    write_zip(file, contents);
    pack.hash = sha256_of_file(file);
    return pack;
}

}  // namespace dynlab::inline course
