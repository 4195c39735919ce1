#pragma once
#include <atomic>
#include <filesystem>
#include <string_view>

#include "platform/cache.h"

namespace dynlab::inline app {

/// Whether a script may run without the user's consent. Allowed are scripts of lessons, scripts in folders that the
/// user allowed, and scripts that the user allowed or that this program created, as long as their text is unchanged. A
/// granted permission is valid for the lifetime of this object, even if the script changes.
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
