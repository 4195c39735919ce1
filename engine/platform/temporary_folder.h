#pragma once
#include <filesystem>

#include "platform/files/ends_with_program.h"

namespace dynlab::inline platform {

/// A private folder below $TMPDIR, removed with everything in it when this object goes.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    EndsWithProgram ends_;
};

}  // namespace dynlab::inline platform
