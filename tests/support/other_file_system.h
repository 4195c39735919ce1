#pragma once
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace dynlab::test {

/// A new folder on another file system than that of temporary folders, where this machine has one.
class OtherFileSystem {
  public:
    OtherFileSystem() {
        std::string pattern = "/dev/shm/dynlab-test-XXXXXX";
        struct stat here {
        }, there{};
        if (!::mkdtemp(pattern.data())) return;
        folder_ = pattern;
        const std::filesystem::path temporary = std::filesystem::temp_directory_path();
        is_other_ = ::stat(temporary.c_str(), &here) == 0 && ::stat(folder_.c_str(), &there) == 0 &&
                    here.st_dev != there.st_dev;
    }
    ~OtherFileSystem() {
        std::error_code ignored;
        if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
    }
    OtherFileSystem(const OtherFileSystem&) = delete;
    OtherFileSystem& operator=(const OtherFileSystem&) = delete;

    const std::filesystem::path& path() const { return folder_; }
    bool is_there() const { return is_other_; }

  private:
    std::filesystem::path folder_;
    bool is_other_ = false;
};

}  // namespace dynlab::test
