#pragma once
#include <filesystem>
#include <string>

#include "platform/cache.h"

namespace dynlab::inline app {

/// Whether a script may be run without a question: those of the lessons, of folders that somebody allowed, and scripts
/// that this program began.
class Permissions {
  public:
    explicit Permissions(const std::filesystem::path& script);
    bool granted() const;
    void grant() const;         ///< for all scripts of its folder
    void grant_script() const;  ///< for this one
  private:
    std::filesystem::path script_, folder_;
    Cache cache_;
};

}  // namespace dynlab::inline app
