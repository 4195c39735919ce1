#include "course/grading/hand_in.h"

#include <map>

#include "course/boxes/zip_file.h"
#include "course/intake/folder_copy.h"
#include "course/intake/notebooks.h"
#include "data_io/dataset_index.h"
#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "workflow/student_copy.h"

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

/// All files below, by their path there.
std::map<std::string, std::string> contents_of(const fs::path& folder) {
    std::map<std::string, std::string> contents;
    for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
        if (entry->is_symlink()) {
            entry.disable_recursion_pending();
        } else if (entry->is_regular_file()) {
            contents[entry->path().lexically_relative(folder).generic_string()] = read_file(entry->path());
        }
    }
    return contents;
}

}  // namespace

Pack pack_folder(const fs::path& folder, const fs::path& file) {
    const auto has = [&](const char* name) { return fs::is_regular_file(fs::symlink_status(folder / name)); };
    if (!has("analysis.lua") && !has("analysis.ipynb"))
        throw EnvironmentError("{} has no analysis.lua; pack the folder that dynlab new made", folder.string());
    const TemporaryFolder copy;
    const FolderCopy copied = copy_folder(folder, copy.path(), kMostPackedBytes, kMostFiles);
    if (copied.too_large)
        throw EnvironmentError("{} is too large: at most {} files and {} MB are handed in", folder.string(), kMostFiles,
                               kMostPackedBytes >> 20);
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

std::vector<std::string> bundle_lesson(const Lesson& lesson, const fs::path& file,
                                       std::optional<std::uint32_t> group_seed) {
    const TemporaryFolder work;
    const fs::path starter = work.path() / lesson.slug;
    make_student_copy(lesson, starter, group_seed);
    std::map<std::string, std::string> contents;
    for (const auto& [name, content] : contents_of(starter)) contents[lesson.slug + "/" + name] = content;
    if (fs::exists(lesson.folder / "checks.lua"))
        contents[lesson.slug + "/checks.lua"] = read_file(lesson.folder / "checks.lua");
    const std::string script = read_file(lesson.script());
    for (const std::string& data_set : dataset_names()) {
        const bool own =
            fs::is_directory(fs::symlink_status(starter / "data")) && fs::exists(starter / "data" / data_set);
        if (own || script.find("load(\"" + data_set + "\")") == std::string::npos) continue;
        for (const auto& [name, content] : contents_of(shared_folder() / "data" / data_set))
            contents[lesson.slug + "/data/" + data_set + "/" + name] = content;
    }
    write_zip(file, contents);
    std::vector<std::string> names;
    for (const auto& [name, content] : contents) names.push_back(name);
    return names;
}

}  // namespace dynlab::inline course
