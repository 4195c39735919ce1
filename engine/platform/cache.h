#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "platform/hash.h"
#include "platform/program_identity.h"

namespace dynlab::inline platform {

/// Number of results that a cache returned, and number of results that were computed.
struct CacheUse {
    std::size_t from_cache = 0, made = 0;
};

/// The name of an entry: its kind, and a digest of the maker of such entries (the program, unless another maker is
/// given) and of all inputs of the entry, in order. Equal names mean equal contents.
class EntryName {
  public:
    explicit EntryName(std::string kind, std::string_view maker = program_identity());
    EntryName& add(std::string_view part);
    std::string text() const;  ///< "calls/" and 32 digits

  private:
    std::string kind_;
    DigestStream parts_;
};

/// Cache for results between runs, in $XDG_CACHE_HOME/dynlab or ~/.cache/dynlab. An entry consists of bytes or of a
/// folder with files. Entries are written atomically, and users may delete them at any time. If the bytes written since
/// the last check exceed a sixteenth of `limit_bytes`, the cache evicts the least recently used entries until the rest
/// fits, but no entry used within the last minute. If DYNLAB_NO_CACHE is set, or if the folder cannot be created, the
/// cache is private to the process. Grading does not use the cache.
class Cache {
  public:
    explicit Cache(std::uint64_t limit_bytes = 512u << 20);

    /// Whether entries survive this process. If not, callers need not compute names of entries.
    bool lasting() const { return lasting_; }
    const std::filesystem::path& root() const { return root_; }

    /// Entries of bytes. Disk errors do not stop the caller: bytes that cannot be written are not cached, and a corrupt
    /// entry is removed and counts as missing. If two processes write the same entry, the later one wins.
    std::optional<std::string> load_entry(const std::string& name) const;
    void save_entry(const std::string& name, std::string_view bytes) const;

    /// Files under a name: the entry's folder if it is there, which marks it as just used.
    std::optional<std::filesystem::path> find(const std::string& name) const;
    /// Makes an empty folder to be filled; commit() moves it into place (the first of two writers wins). Both throw
    /// EnvironmentError.
    std::filesystem::path prepare() const;
    std::filesystem::path commit(const std::filesystem::path& prepared, const std::string& name) const;

    void erase_entry(const std::string& name) const;

  private:
    void write(const std::string& name, std::string_view bytes) const;
    void add_growth(std::uint64_t bytes) const;
    void drop_beyond_limit() const;

    std::filesystem::path root_;
    std::uint64_t limit_bytes_;
    bool lasting_ = true;
};

}  // namespace dynlab::inline platform
