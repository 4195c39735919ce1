#include "platform/cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/system_call.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr char kUnfinished[] = ".new-";
constexpr char kDropped[] = ".old-";
constexpr char kText[] = "text";
constexpr auto kInUse = 1min;    // an entry used so lately may be open in another process
constexpr auto kAbandoned = 1h;  // an unfinished entry this old belongs to a process that died

fs::path folder_of_caches() {
    if (const char* cache_home = std::getenv("XDG_CACHE_HOME"); cache_home && *cache_home == '/') {
        return fs::path(cache_home) / "dynlab";
    }
    if (const char* home = std::getenv("HOME"); home && *home == '/') return fs::path(home) / ".cache/dynlab";
    return {};
}

fs::path private_folder() {
    static const TemporaryFolder folder;
    return folder.path();
}

bool can_be_written(const fs::path& folder) {
    return ::access(folder.c_str(), R_OK | W_OK | X_OK) == 0;
}

/// A cache that cannot be kept must not stop the work: it then lives as long as this process.
fs::path make_root(const std::string& name) {
    std::error_code error;
    const fs::path caches = std::getenv("DYNLAB_NO_CACHE") ? fs::path() : folder_of_caches();
    if (!caches.empty()) {
        fs::create_directories(caches / name, error);
        if (!error && can_be_written(caches / name)) return caches / name;
    }
    fs::create_directories(private_folder() / name, error);
    if (error) {
        throw EnvironmentError("cannot make a cache folder in " + private_folder().string() + ": " + error.message());
    }
    return private_folder() / name;
}

fs::path new_folder(const fs::path& root, const std::string& beginning) {
    std::string pattern = root / (beginning + "XXXXXX");
    if (!::mkdtemp(pattern.data())) {
        throw EnvironmentError("cannot make a folder in " + root.string() + ": " + system_reason(errno));
    }
    return pattern;
}

void check_key(const std::string& key) {
    if (key.empty() || key.front() == '.' || key.find('/') != std::string::npos) {
        throw std::invalid_argument("a cache key must be a plain file name, not \"" + key + "\"");
    }
}

void mark_as_used(const fs::path& folder) {
    ::utimensat(AT_FDCWD, folder.c_str(), nullptr, 0);
}

bool begins_with(const fs::path& entry, const char* beginning) {
    return entry.filename().string().rfind(beginning, 0) == 0;
}

std::uint64_t bytes_in(const fs::path& folder) {
    std::uint64_t total = 0;
    std::error_code error;  // entries may vanish meanwhile
    for (auto at = fs::recursive_directory_iterator(folder, error); !error && at != fs::end(at); at.increment(error)) {
        std::error_code not_a_file;
        const std::uintmax_t size = at->file_size(not_a_file);
        if (!not_a_file) total += size;
    }
    return total;
}

/// Out of sight in one step, so that nobody finds half an entry; then deleted.
void drop(const fs::path& root, const fs::path& entry) {
    std::error_code error;
    const fs::path aside = new_folder(root, kDropped);
    fs::rename(entry, aside, error);
    fs::remove_all(aside, error);
}

}  // namespace

Cache::Cache(const std::string& name, std::uint64_t limit_bytes)
    : limit_bytes_(limit_bytes), unseen_bytes_(limit_bytes) {
    check_key(name);
    root_ = make_root(name);
}

std::optional<fs::path> Cache::find(const std::string& key) const {
    check_key(key);
    std::error_code error;
    const fs::path folder = root_ / key;
    if (!fs::is_directory(folder, error)) return std::nullopt;
    mark_as_used(folder);
    return folder;
}

fs::path Cache::prepare() const {
    std::error_code error;
    fs::create_directories(root_, error);  // somebody may have deleted the whole cache
    return new_folder(root_, kUnfinished);
}

fs::path Cache::commit(const fs::path& prepared, const std::string& key) const {
    check_key(key);
    std::error_code error;
    const fs::path folder = root_ / key;
    fs::rename(prepared, folder, error);
    if (error && fs::is_directory(folder)) {
        fs::remove_all(prepared, error);
    } else if (error) {
        throw EnvironmentError("cannot keep " + folder.string() + ": " + error.message());
    }
    mark_as_used(folder);
    unseen_bytes_ += bytes_in(folder);
    if (unseen_bytes_ > limit_bytes_ / 16) drop_beyond_limit();
    return folder;
}

void Cache::forget(const std::string& key) const {
    check_key(key);
    drop(root_, root_ / key);
}

void Cache::store(const std::string& key, const std::string& text) const {
    if (const auto folder = find(key)) return write_file_atomically(*folder / kText, text);
    const fs::path folder = prepare();
    write_file_atomically(folder / kText, text);
    commit(folder, key);
}

std::optional<std::string> Cache::recall(const std::string& key) const {
    const auto folder = find(key);
    if (!folder || !fs::exists(*folder / kText)) return std::nullopt;
    return read_file(*folder / kText);
}

void Cache::drop_beyond_limit() const {
    struct Entry {
        fs::path folder;
        fs::file_time_type used;
        std::uint64_t bytes;
    };
    unseen_bytes_ = 0;
    const auto now = fs::file_time_type::clock::now();
    std::vector<Entry> entries;
    std::uint64_t total = 0;
    std::error_code error;
    for (auto at = fs::directory_iterator(root_, error); !error && at != fs::end(at); at.increment(error)) {
        std::error_code vanished;
        const auto used = fs::last_write_time(*at, vanished);
        if (vanished) continue;
        if (begins_with(*at, kUnfinished) || begins_with(*at, kDropped)) {
            if (now - used > kAbandoned) fs::remove_all(*at, vanished);
            continue;
        }
        entries.push_back({at->path(), used, bytes_in(at->path())});
        total += entries.back().bytes;
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
    for (const Entry& entry : entries) {
        if (total <= limit_bytes_ || now - entry.used < kInUse) return;
        drop(root_, entry.folder);
        total -= entry.bytes;
    }
}

}  // namespace dynlab::inline platform
