#include "platform/cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <stdexcept>
#include <vector>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/files/temporary_file.h"
#include "platform/locks/in_use.h"
#include "platform/system_call.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr char kUnfinished[] = ".new-";
constexpr char kDropped[] = ".old-";
constexpr char kGrowth[] = ".growth";  // bytes written since the entries were looked through
constexpr auto kInUseTime = 1min;      // an entry used so lately may be open in another process
constexpr auto kAbandonedAge = 1h;     // an unfinished entry of another machine this old belongs to a process that died
constexpr std::size_t kDigestDigits = 32;

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

/// Nothing where a cache cannot last: that must not stop the work.
std::optional<fs::path> lasting_root() {
    const fs::path folder = std::getenv("DYNLAB_NO_CACHE") ? fs::path() : folder_of_caches();
    if (folder.empty()) return {};
    std::error_code error;
    fs::create_directories(folder, error);
    return !error && can_be_written(folder) ? std::optional(folder) : std::nullopt;
}

/// With a lock, until it is released: the next run removes what a killed one left.
fs::path new_folder(const fs::path& root, const char* beginning) {
    const fs::path folder = make_folder_in_use(root, prefix_in_use(beginning));
    if (folder.empty()) throw EnvironmentError("cannot create a folder in {}: {}", root.string(), system_reason(errno));
    return folder;
}

/// Once a process for each root.
void remove_leftovers_of_killed_runs(const fs::path& root) {
    static std::mutex mutex;
    static std::set<fs::path> cleaned;
    {
        const std::lock_guard lock(mutex);
        if (!cleaned.insert(root).second) return;
    }
    for (const char* beginning : {kUnfinished, kDropped})
        remove_unused(root, prefix_in_use(beginning), Leftovers::kFilesAndFolders);
}

bool is_plain(std::string_view name) {
    return !name.empty() && name.front() != '.' && name.find('/') == std::string_view::npos;
}

void check_name(std::string_view name) {
    const std::size_t slash = name.find('/');
    if (slash == std::string_view::npos || !is_plain(name.substr(0, slash)) || !is_plain(name.substr(slash + 1)))
        throw std::invalid_argument("the name of an entry is KIND/NAME, two plain file names, not \"" +
                                    std::string(name) + "\"");
}

/// False when the entry is not there.
bool mark_as_used(const fs::path& entry) {
    return ::utimensat(AT_FDCWD, entry.c_str(), nullptr, 0) == 0;
}

bool begins_with(const fs::path& entry, const char* beginning) {
    return entry.filename().string().starts_with(beginning);
}

std::uint64_t bytes_in(const fs::path& entry) {
    std::error_code error;  // entries may vanish meanwhile
    const auto size = [](const fs::directory_entry& file) {
        std::error_code not_a_file;
        const std::uintmax_t bytes = file.file_size(not_a_file);
        return not_a_file ? 0 : bytes;
    };
    if (!fs::is_directory(entry, error)) return size(fs::directory_entry(entry, error));
    std::uint64_t total = 0;
    for (auto at = fs::recursive_directory_iterator(entry, error); !error && at != fs::end(at); at.increment(error))
        total += size(*at);
    return total;
}

/// Moves the entry out of sight in one step, so that no process finds an incomplete entry; then deletes it.
void drop(const fs::path& root, const fs::path& entry) {
    std::error_code error;
    if (!fs::is_directory(entry, error)) {
        fs::remove(entry, error);
        return;
    }
    const fs::path aside = new_folder(root, kDropped);
    fs::rename(entry, aside, error);
    fs::remove_all(aside, error);
    release_folder_in_use(aside);
}

/// A file that is written, with its lock.
struct UnfinishedFile {
    fs::path path;
    FileDescriptor file;
};

/// A file of the digest, followed by the bytes. No caller waits for the disk: a file that a power failure truncated
/// does not match its digest.
UnfinishedFile write_unfinished(const fs::path& root, std::string_view bytes) {
    for (;;) {
        std::string path = root / (prefix_in_use(kUnfinished) + "XXXXXX");
        FileDescriptor file(::mkostemp(path.data(), O_CLOEXEC));
        if (file && !lock_as_in_use(file.get(), path)) continue;  // taken for a leftover, before it had its lock
        const std::string digest = digest_of(bytes).hex();
        if (file && write_all(file.get(), digest.data(), digest.size()) &&
            write_all(file.get(), bytes.data(), bytes.size()))
            return {path, std::move(file)};
        const std::string reason = system_reason(errno);
        std::error_code ignored;
        if (file) fs::remove(path, ignored);
        throw EnvironmentError("cannot write {}: {}", path, reason);
    }
}

struct Entry {
    fs::path path;
    fs::file_time_type used;
    std::uint64_t bytes;
};

/// All entries, those that are dropped or unfinished aside; of these the abandoned ones are deleted.
std::vector<Entry> entries_below(const fs::path& root) {
    const auto now = fs::file_time_type::clock::now();
    std::vector<Entry> entries;
    std::error_code error;
    for (auto kind = fs::directory_iterator(root, error); !error && kind != fs::end(kind); kind.increment(error)) {
        std::error_code vanished;
        if (begins_with(*kind, kUnfinished) || begins_with(*kind, kDropped)) {
            const auto used = fs::last_write_time(*kind, vanished);
            if (!vanished && now - used > kAbandonedAge) fs::remove_all(*kind, vanished);
            continue;
        }
        for (auto at = fs::directory_iterator(*kind, vanished); !vanished && at != fs::end(at);
             at.increment(vanished)) {
            std::error_code gone;
            const auto used = fs::last_write_time(*at, gone);
            if (!gone) entries.push_back({at->path(), used, bytes_in(at->path())});
        }
    }
    return entries;
}

}  // namespace

EntryName::EntryName(std::string kind, std::string_view maker) : kind_(std::move(kind)) {
    add(maker);
}

EntryName& EntryName::add(std::string_view part) {
    parts_.add_part(part);
    return *this;
}

std::string EntryName::text() const {
    return kind_ + "/" + parts_.digest().hex();
}

Cache::Cache(std::uint64_t limit_bytes) : limit_bytes_(limit_bytes) {
    const auto lasting = lasting_root();
    lasting_ = lasting.has_value();
    root_ = lasting ? *lasting : private_folder();
    if (lasting_) remove_leftovers_of_killed_runs(root_);
}

std::optional<std::string> Cache::load_entry(const std::string& name) const {
    check_name(name);
    try {
        if (!mark_as_used(root_ / name)) return {};
        const std::string content = read_file(root_ / name);
        const std::string_view bytes = std::string_view(content).substr(std::min(kDigestDigits, content.size()));
        if (content.substr(0, kDigestDigits) == digest_of(bytes).hex()) return std::string(bytes);
        erase_entry(name);
    } catch (const std::exception&) {  // deleted meanwhile, or not to be read: then it is created again
    }
    return {};
}

void Cache::save_entry(const std::string& name, std::string_view bytes) const {
    check_name(name);
    try {
        write(name, bytes);
    } catch (const std::exception&) {  // a full disk, say: the next run does without
    }
}

void Cache::write(const std::string& name, std::string_view bytes) const {
    const fs::path entry = root_ / name;
    fs::create_directories(entry.parent_path());
    const UnfinishedFile unfinished = write_unfinished(root_, bytes);
    std::error_code error;
    if (fs::is_directory(entry, error)) drop(root_, entry);
    fs::rename(unfinished.path, entry, error);
    if (error) {
        fs::remove(unfinished.path, error);
        return;
    }
    add_growth(kDigestDigits + bytes.size());
}

std::optional<fs::path> Cache::find(const std::string& name) const {
    check_name(name);
    std::error_code error;
    const fs::path folder = root_ / name;
    if (!fs::is_directory(folder, error)) return std::nullopt;
    mark_as_used(folder);
    return folder;
}

fs::path Cache::prepare() const {
    std::error_code error;
    fs::create_directories(root_, error);  // the user may have deleted the whole cache
    return new_folder(root_, kUnfinished);
}

fs::path Cache::commit(const fs::path& prepared, const std::string& name) const {
    check_name(name);
    std::error_code error;
    const fs::path folder = root_ / name;
    fs::create_directories(folder.parent_path(), error);
    fs::rename(prepared, folder, error);
    release_folder_in_use(prepared);
    if (error && fs::is_directory(folder)) {
        fs::remove_all(prepared, error);
    } else if (error) {
        throw EnvironmentError("cannot store {} in the cache: {}", folder.string(), error.message());
    }
    mark_as_used(folder);
    add_growth(bytes_in(folder));
    return folder;
}

void Cache::erase_entry(const std::string& name) const {
    check_name(name);
    drop(root_, root_ / name);
}

/// Two processes at once may lose what one of them added; the next look comes a little later then.
void Cache::add_growth(std::uint64_t bytes) const {
    std::uint64_t growth = limit_bytes_;  // used before the first check of the size
    std::ifstream(root_ / kGrowth) >> growth;
    growth = std::min(growth, limit_bytes_) + bytes;
    if (growth > limit_bytes_ / 16) {
        drop_beyond_limit();
        growth = 0;
    }
    std::ofstream(root_ / kGrowth) << growth;
}

void Cache::drop_beyond_limit() const {
    std::vector<Entry> entries = entries_below(root_);
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
    const auto now = fs::file_time_type::clock::now();
    std::uint64_t total = 0;
    for (const Entry& entry : entries) total += entry.bytes;
    for (const Entry& entry : entries) {
        if (total <= limit_bytes_ || now - entry.used < kInUseTime) break;
        drop(root_, entry.path);
        total -= entry.bytes;
    }
}

}  // namespace dynlab::inline platform
