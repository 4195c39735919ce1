#include "workflow/site/site_folder.h"

#include <algorithm>
#include <set>

#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/files/temporary_file.h"
#include "platform/hash.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = "site-files.txt";

/// Names and the hashes that a site's files may have: two while one is written over another.
using WrittenBefore = std::map<std::string, std::set<std::string>>;

/// The files of an older site. Names that lead out of the folder are left out.
WrittenBefore written_before(const fs::path& folder) {
    WrittenBefore written;
    if (!fs::is_regular_file(folder / kList)) return written;
    for (const std::string& line : lines_of(read_file(folder / kList))) {
        const std::size_t space = line.find("  ");
        if (space == std::string::npos) continue;
        const fs::path name = line.substr(space + 2);
        const bool inside = name.is_relative() && name.lexically_normal() == name && *name.begin() != "..";
        if (inside) written[name.string()].insert(line.substr(0, space));
    }
    return written;
}

[[noreturn]] void refuse(const fs::path& folder, const Message& why) {
    throw EnvironmentError("{} was not changed, because {}; give a new or an empty folder", folder.string(), why);
}

/// Refuses a file of that name that the older site did not write, or that was changed since.
void check_file(const fs::path& folder, const std::string& name, const WrittenBefore& before) {
    const fs::path file = folder / name;
    if (!fs::exists(fs::symlink_status(file))) return;
    const auto known = before.find(name);
    if (known == before.end()) refuse(folder, Message("it contains a file {} that is not part of a site", name));
    if (!fs::is_regular_file(fs::symlink_status(file)) || !known->second.count(sha256_of_file(file)))
        refuse(folder, Message("{} was changed after the site was created", name));
}

}  // namespace

void check_site_folder(const fs::path& folder) {
    if (!fs::exists(fs::symlink_status(folder))) return;
    if (!fs::is_directory(folder)) refuse(folder, Message("it is a file"));
    remove_leftover_files(folder);
    const auto entries = fs::recursive_directory_iterator(folder);
    if (std::all_of(begin(entries), end(entries),
                    [](const auto& entry) { return entry.is_directory() && !entry.is_symlink(); }))
        return;
    const auto before = written_before(folder);
    if (before.empty()) refuse(folder, Message("it contains files that are not part of a site"));
    for (const auto& [name, hashes] : before) check_file(folder, name, before);
}

void write_site_folder(const fs::path& folder, const SiteFiles& files) {
    check_site_folder(folder);
    const WrittenBefore before = written_before(folder);
    std::string list;
    for (const auto& [name, content] : files) {
        check_file(folder, name, before);
        list += sha256_of(content) + "  " + name + "\n";
    }
    // The list first holds both, so that a run that is ended half way leaves a site, too.
    std::string both = list;
    for (const auto& [name, hashes] : before)
        for (const std::string& hash : hashes) both += hash + "  " + name + "\n";
    fs::create_directories(folder);
    write_file_atomically(folder / kList, both);
    std::vector<NewFile> written;
    for (const auto& [name, content] : files) {
        fs::create_directories((folder / name).parent_path());
        written.push_back({folder / name, content});
    }
    write_files_atomically(written);
    for (const auto& [name, hashes] : before)
        if (!files.count(name)) fs::remove(folder / name);
    write_file_atomically(folder / kList, list);
}

}  // namespace dynlab::inline workflow
