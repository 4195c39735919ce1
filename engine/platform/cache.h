#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "platform/hash.h"
#include "platform/program_identity.h"

namespace dynlab::inline platform {

/// What a cache spared, and what was made anew.
struct CacheUse {
    std::size_t recalled = 0, made = 0;
};

/// The name of an entry: its kind, and a digest of what makes such entries (the program, unless another maker is given)
/// and of all they are made from, in its order. Equal names stand for equal contents.
class EntryName {
  public:
    explicit EntryName(std::string kind, std::string_view maker = program_identity());
    EntryName& add(std::string_view part);
    std::string text() const;  ///< "calls/" and 32 digits

  private:
    std::string kind_;
    DigestStream parts_;
};

/// The one store of what is kept between runs: $XDG_CACHE_HOME/dynlab, else ~/.cache/dynlab. Entries are bytes, or
/// files in a folder; they appear whole and may be deleted at any time. When what was written since the last look
/// exceeds a sixteenth of `limit_bytes`, the least recently used are dropped until all fit the limit, but none that was
/// used within the last minute. With DYNLAB_NO_CACHE set, or where no such folder can be made, the store is private
/// and goes with the process. What is graded is made without.
class Cache {
  public:
    explicit Cache(std::uint64_t limit_bytes = 512u << 20);

    /// Whether later runs will find anything; where not, names for what is to last need not be made.
    bool lasting() const { return lasting_; }
    const std::filesystem::path& root() const { return root_; }

    /// Bytes under a name. Whatever happens to the disk, work goes on: what cannot be kept is not kept, what is spoilt
    /// is not recalled and is forgotten. The later of two writers wins.
    std::optional<std::string> recall(const std::string& name) const;
    void remember(const std::string& name, std::string_view bytes) const;

    /// Files under a name: the entry's folder if it is there, which marks it as just used.
    std::optional<std::filesystem::path> find(const std::string& name) const;
    /// Makes an empty folder to be filled; commit() moves it into place (the first of two writers wins). Both throw
    /// EnvironmentError.
    std::filesystem::path prepare() const;
    std::filesystem::path commit(const std::filesystem::path& prepared, const std::string& name) const;

    void forget(const std::string& name) const;

  private:
    void write(const std::string& name, std::string_view bytes) const;
    void add_growth(std::uint64_t bytes) const;
    void drop_beyond_limit() const;

    std::filesystem::path root_;
    std::uint64_t limit_bytes_;
    bool lasting_ = true;
};

}  // namespace dynlab::inline platform
