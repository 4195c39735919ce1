#pragma once
#include <atomic>
#include <filesystem>
#include <string_view>

#include "platform/cache.h"

namespace dynlab::inline app {

/// Whether a script may be run without a question: those of the lessons, of folders that somebody allowed, and scripts
/// that somebody allowed or this program began, while they are as they were left. What is granted once holds for the
/// life of this object, however the script is changed meanwhile.
class Permissions {
  public:
    explicit Permissions(const std::filesystem::path& script);
    bool granted() const { return granted_; }
    void grant();                              ///< for all scripts of its folder
    void grant_script(std::string_view text);  ///< for this one with this text
  private:
    bool was_granted() const;

    std::filesystem::path script_, folder_;
    Cache cache_;
    std::atomic<bool> granted_ = false;
};

}  // namespace dynlab::inline app
