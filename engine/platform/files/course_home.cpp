#include "platform/files/course_home.h"

#include <cstdlib>
#include <map>
#include <string>

#include "platform/cache.h"
#include "platform/error.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

constexpr const char* kParts[] = {"lessons", "data", "report_templates"};
constexpr const char* kOverlaid = "report_templates";  // file by file; the others as whole folders
constexpr std::uintmax_t kMaxByteCount = 256u << 20;   // of a course's own files, which are copied

using FilesByPlace = std::map<fs::path, fs::path>;

/// The regular files below root/part, by their place below root; hidden ones are left out.
void add_files(const fs::path& root, const fs::path& part, FilesByPlace& files) {
    if (!fs::is_directory(root / part)) return;
    for (auto entry = fs::recursive_directory_iterator(root / part); entry != fs::recursive_directory_iterator();
         ++entry) {
        if (entry->path().filename().string().starts_with('.')) {
            entry.disable_recursion_pending();
            continue;
        }
        if (entry->is_regular_file()) files[part / fs::relative(entry->path(), root / part)] = entry->path();
    }
}

FilesByPlace merged_files(const fs::path& course, const fs::path& installed) {
    FilesByPlace files, own;
    for (const char* part : kParts) {
        add_files(installed, part, files);
        add_files(course, part, own);
        if (part == std::string(kOverlaid) || !fs::is_directory(course / part)) continue;
        for (const auto& entry : fs::directory_iterator(course / part)) {
            const fs::path replaced = fs::path(part) / entry.path().filename();
            std::erase_if(files, [&](const auto& file) {
                return *std::next(file.first.begin()) == replaced.filename() && *file.first.begin() == part;
            });
        }
    }
    std::uintmax_t bytes = 0;
    for (const auto& [place, file] : own) bytes += fs::file_size(file);
    if (bytes > kMaxByteCount)
        throw EnvironmentError(
            "the lessons, data and templates of the course in {} are larger than 256 MB; remove large files from these "
            "folders",
            course.string());
    for (const auto& [place, file] : own) files[place] = file;
    return files;
}

std::string name_of(const FilesByPlace& files) {
    EntryName name("courses");
    for (const auto& [place, file] : files)
        name.add(place.string())
            .add(file.string())
            .add(std::to_string(fs::file_size(file)))
            .add(std::to_string(fs::last_write_time(file).time_since_epoch().count()));
    return name.text();
}

}  // namespace

std::optional<fs::path> own_course() {
    const char* named = std::getenv("DYNLAB_COURSE");
    if (named == nullptr || *named == '\0') return std::nullopt;
    const fs::path folder = fs::absolute(named).lexically_normal();
    if (!fs::is_directory(folder))
        throw EnvironmentError("DYNLAB_COURSE: folder not found: '{}'. Set DYNLAB_COURSE to an existing folder", named);
    for (const char* part : kParts)
        if (fs::is_directory(folder / part)) return folder;
    throw EnvironmentError(
        "DYNLAB_COURSE: {} contains none of the folders lessons, data and report_templates. Set DYNLAB_COURSE to a "
        "folder that contains at least one of them",
        folder.string());
}

fs::path course_home(const fs::path& course, const fs::path& installed) {
    const Cache cache;
    const FilesByPlace files = merged_files(course, installed);
    const std::string name = name_of(files);
    if (const auto known = cache.find(name)) return *known;
    const fs::path growing = cache.prepare();
    for (const char* part : kParts) fs::create_directories(growing / part);
    for (const auto& [place, file] : files) {
        fs::create_directories((growing / place).parent_path());
        fs::copy_file(file, growing / place);
    }
    return cache.commit(growing, name);
}

}  // namespace dynlab::inline platform
