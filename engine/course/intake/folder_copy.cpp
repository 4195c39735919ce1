#include "course/intake/folder_copy.h"

#include <algorithm>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepestFolder = 20;  ///< folders within folders

class FolderCopier {
  public:
    FolderCopier(std::uint64_t bytes_left, int files_left) : bytes_left_(bytes_left), files_left_(files_left) {}

    void copy(const fs::path& from, const fs::path& to, const fs::path& inside, int depth) {
        for (const auto& entry : fs::directory_iterator(from)) {
            if (result_.too_large) return;
            const fs::path name = entry.path().filename();
            if (name.string().starts_with('.')) continue;
            const fs::file_type type = entry.symlink_status().type();
            if (type == fs::file_type::symlink && inside.empty() && name == "data") {
                fs::create_directory_symlink(shared_folder() / "data", to / name);
            } else if (type == fs::file_type::directory) {
                result_.too_large = depth == kDeepestFolder;
                fs::create_directory(to / name);
                if (!result_.too_large) copy(entry.path(), to / name, inside / name, depth + 1);
            } else if (type == fs::file_type::regular) {
                copy_file(entry, to / name);
            } else {
                result_.left_out.push_back((inside / name).string());
            }
        }
    }

    const FolderCopy& result() const { return result_; }

  private:
    void copy_file(const fs::directory_entry& entry, const fs::path& to) {
        const std::uint64_t size = entry.file_size();
        result_.too_large = size > bytes_left_ || --files_left_ < 0;
        if (result_.too_large) return;
        bytes_left_ -= size;
        fs::copy_file(entry.path(), to);
        fs::last_write_time(to, entry.last_write_time());
    }

    std::uint64_t bytes_left_;
    int files_left_;
    FolderCopy result_;
};

}  // namespace

FolderCopy copy_folder(const fs::path& from, const fs::path& to, std::uint64_t max_bytes, int max_files) {
    try {
        FolderCopier copying(max_bytes, max_files);
        copying.copy(from, to, {}, 0);
        return copying.result();
    } catch (const fs::filesystem_error& error) {
        throw EnvironmentError("cannot copy {}: {} ({})", from.string(), error.code().message(),
                               error.path1().string());
    }
}

std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
        const std::string name = entry->path().filename();
        if (name.starts_with('.') || name == "__MACOSX") {
            entry.disable_recursion_pending();
        } else if (entry->symlink_status().type() == fs::file_type::regular) {
            files.push_back(entry->path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

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

}  // namespace dynlab::inline course
