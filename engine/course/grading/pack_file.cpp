#include "course/grading/pack_file.h"

#include "course/intake/folder_copy.h"
#include "data_io/values/json_values.h"
#include "platform/files/zip_file.h"
#include "platform/hash.h"

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

constexpr char kManifest[] = "MANIFEST.json";

}  // namespace

PackFile pack_of(std::map<std::string, std::string> contents) {
    std::erase_if(contents, [](const auto& entry) {
        return entry.first.ends_with(".zip") || entry.first == kManifest ||
               entry.first.starts_with(std::string(kFiguresOfRuns) + "/");
    });
    PackFile pack;
    Manifest manifest;
    for (const auto& [name, content] : contents) {
        pack.files.push_back(name);
        manifest.files[name] = {content.size(), sha256_of(content)};
    }
    contents[kManifest] = json_of(manifest, 2) + "\n";
    pack.bytes = zip_of(contents);
    return pack;
}

}  // namespace dynlab::inline course
