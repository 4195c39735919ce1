#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace dynlab::inline platform {

/// The program's caches below $XDG_CACHE_HOME/dynlab (else ~/.cache/dynlab): folders keyed by content, safe
/// to delete at any time, the least recently used dropped beyond `limit_bytes` unless used within the last minute. One
/// object lets its cache outgrow the limit by a sixteenth: to look through thousands of entries takes long.
/// With DYNLAB_NO_CACHE set, or where no cache folder can be made, a private folder per process. Keys are plain
/// file names (a hash).
class Cache {
  public:
    explicit Cache(const std::string& name, std::uint64_t limit_bytes = 256u << 20);

    /// The folder of `key` if it is there and complete; marks it as just used.
    std::optional<std::filesystem::path> find(const std::string& key) const;
    /// Makes an empty folder to be filled; commit() moves it into place under `key` (two writers: the first
    /// wins).
    std::filesystem::path prepare() const;
    std::filesystem::path commit(const std::filesystem::path& prepared, const std::string& key) const;

    void forget(const std::string& key) const;

    /// A short text under `key`, replaced whole by every store(). The keys of texts and of folders must differ.
    void store(const std::string& key, const std::string& text) const;
    std::optional<std::string> recall(const std::string& key) const;
    const std::filesystem::path& root() const { return root_; }

  private:
    void drop_beyond_limit() const;
    std::filesystem::path root_;
    std::uint64_t limit_bytes_;
    mutable std::atomic<std::uint64_t> unseen_bytes_;  ///< committed since the entries were looked through
};

}  // namespace dynlab::inline platform
