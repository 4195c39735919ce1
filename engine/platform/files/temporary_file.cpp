#include "platform/files/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <string_view>

#include "platform/hash.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemporaryMark = ".dynlab-";

bool is_number(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether a process on this machine made a temporary file of this name: ".NAME.dynlab-MACHINE-PID-N".
bool is_temporary_name(std::string_view name) {
    const std::size_t mark = name.rfind(kTemporaryMark);
    if (!name.starts_with('.') || mark == std::string_view::npos) return false;
    std::string_view rest = name.substr(mark + kTemporaryMark.size());
    if (!rest.starts_with(machine_in_names() + '-')) return false;
    rest.remove_prefix(machine_in_names().size() + 1);
    const std::size_t dash = rest.find('-');
    return dash != std::string_view::npos && is_number(rest.substr(0, dash)) && is_number(rest.substr(dash + 1));
}

/// Network file systems lock for writing only where the file is open for writing.
FileDescriptor open_leftover(const fs::path& file) {
    constexpr int kPlainFile = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY;
    FileDescriptor opened(::open(file.c_str(), O_RDWR | kPlainFile));
    if (!opened) opened = FileDescriptor(::open(file.c_str(), O_RDONLY | kPlainFile));
    return opened;
}

void remove_leftovers_once(const fs::path& folder) {
    static std::mutex mutex;
    static auto* const cleaned = new std::set<fs::path>;  // outlives every other object
    std::error_code none;
    fs::path place = fs::absolute(folder, none);
    {
        const std::lock_guard lock(mutex);
        if (none || !cleaned->insert(std::move(place)).second) return;
    }
    remove_leftover_files(folder);
}

}  // namespace

std::string machine_in_names(const std::string& machine) {
    constexpr std::size_t kMaxLetters = 24, kLettersOfHash = 12;
    std::string name = machine;
    for (char& c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        if (!plain) c = '_';
    }
    if (name == machine && name.size() <= kMaxLetters) return name;
    return name.substr(0, kMaxLetters - kLettersOfHash) + sha256_of(machine).substr(0, kLettersOfHash);
}

const std::string& machine_in_names() {
    static const std::string machine = [] {
        char name[256] = {};
        return machine_in_names(::gethostname(name, sizeof name - 1) == 0 ? name : "unnamed");
    }();
    return machine;
}

bool lock_as_in_use(int descriptor, const fs::path& path) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
    struct stat locked {
    }, present{};
    return ::fstat(descriptor, &locked) == 0 && ::lstat(path.c_str(), &present) == 0 &&
           locked.st_dev == present.st_dev && locked.st_ino == present.st_ino;
}

bool lock_leftover(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && status.st_uid == ::geteuid() &&
           ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

/// Not mkstemp: its files are private, while a new file here gets the permissions that the user's umask grants.
TemporaryFile make_temporary_file(const fs::path& folder, const std::string& name, mode_t mode) {
    constexpr std::size_t kMaxNameBytes = 160;
    static std::atomic<unsigned> counter{0};
    remove_leftovers_once(folder.empty() ? fs::path(".") : folder);
    for (;;) {
        TemporaryFile made;
        made.path = folder / fmt::format(".{}{}{}-{}-{}", name.substr(0, kMaxNameBytes), kTemporaryMark,
                                         machine_in_names(), ::getpid(), counter++);
        made.file = FileDescriptor(::open(made.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
        if (!made.file && errno == EEXIST) continue;
        if (!made.file || lock_as_in_use(made.file.get(), made.path)) return made;
        ::unlink(made.path.c_str());
    }
}

std::vector<fs::path> remove_leftover_files(const fs::path& folder) {
    std::vector<fs::path> removed;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (!is_temporary_name(entry->path().filename().string())) continue;
        const FileDescriptor leftover = open_leftover(entry->path());
        std::error_code none;
        const bool plain = fs::symlink_status(entry->path(), none).type() == fs::file_type::regular;
        if (leftover && plain && lock_leftover(leftover.get()) && ::unlink(entry->path().c_str()) == 0)
            removed.push_back(entry->path());
    }
    return removed;
}

}  // namespace dynlab::inline platform
