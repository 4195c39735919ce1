#include "platform/files/ends_with_program.h"

#include <fcntl.h>
#include <linux/limits.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace dynlab::inline platform {
namespace {

/// Nothing that a signal's handler reads is ever given back: it may come between any two steps, and while another
/// thread gives the slot up and takes it for another path. So the handler works on a copy, which counts only where
/// `changes` is odd before and the same behind it.
struct Slot {
    std::atomic<bool> taken{false};
    std::atomic<unsigned> changes{0};  ///< odd: what follows is whole
    std::atomic<pid_t> owner{0}, group{0};
    char path[PATH_MAX] = {};

    std::atomic_ref<char> letter(std::size_t i) { return std::atomic_ref(path[i]); }
};

constexpr int kSlots = 128;

std::array<Slot, kSlots> slots;

int free_slot() {
    for (int i = 0; i < kSlots; ++i)
        if (bool taken = false; slots[static_cast<std::size_t>(i)].taken.compare_exchange_strong(taken, true)) return i;
    return -1;
}

/// Into a slot that was taken: what a handler reads of it from here on is not older than that the slot was given up.
void fill(Slot& slot, std::string_view path, pid_t group) {
    std::atomic_thread_fence(std::memory_order_release);
    for (std::size_t i = 0; i < path.size(); ++i) slot.letter(i).store(path[i], std::memory_order_relaxed);
    slot.letter(path.size()).store('\0', std::memory_order_relaxed);
    slot.owner.store(::getpid(), std::memory_order_relaxed);
    slot.group.store(group, std::memory_order_relaxed);
    slot.changes.fetch_add(1, std::memory_order_release);
}

/// What ends with this process, as it stood at one moment.
struct Ending {
    pid_t group = 0;
    char path[PATH_MAX];
};

bool is_copied(Slot& slot, Ending& ending) {
    const unsigned changes = slot.changes.load(std::memory_order_acquire);
    if (changes % 2 == 0 || slot.owner.load(std::memory_order_relaxed) != ::getpid()) return false;
    ending.group = slot.group.load(std::memory_order_relaxed);
    std::size_t length = 0;
    while (length < PATH_MAX - 1 && (ending.path[length] = slot.letter(length).load(std::memory_order_relaxed)) != '\0')
        ++length;
    ending.path[length] = '\0';
    std::atomic_thread_fence(std::memory_order_acquire);
    return slot.changes.load(std::memory_order_relaxed) == changes;
}

constexpr int kMaxDepth = 32;

void remove_all_of(int folder, const char* name, int depth);

/// What getdents64 gives, entry by entry.
struct EntryHead {
    std::uint64_t inode;
    std::int64_t next;
    std::uint16_t size;
    std::uint8_t type;
};
constexpr std::size_t kNameAt = 19;

bool is_itself_or_parent(const char* name) {
    return std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0;
}

void empty_folder(int folder, int depth) {
    alignas(EntryHead) char block[2048];
    for (long bytes; (bytes = ::syscall(SYS_getdents64, folder, block, sizeof block)) > 0;)
        for (long at = 0; at < bytes;) {
            EntryHead entry;
            std::memcpy(&entry, block + at, sizeof entry);
            const char* const name = block + at + kNameAt;
            if (!is_itself_or_parent(name)) remove_all_of(folder, name, depth + 1);
            at += entry.size;
        }
}

void remove_all_of(int folder, const char* name, int depth) {
    if (::unlinkat(folder, name, 0) == 0 || depth > kMaxDepth) return;
    const int inside = ::openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (inside < 0) return;
    empty_folder(inside, depth);
    ::close(inside);
    ::unlinkat(folder, name, AT_REMOVEDIR);
}

}  // namespace

EndsWithProgram::EndsWithProgram(const std::filesystem::path& file_or_folder) {
    std::error_code error;
    const std::string path = std::filesystem::absolute(file_or_folder, error).string();
    if (error || path.size() >= PATH_MAX || (slot_ = free_slot()) < 0) return;
    fill(slots[static_cast<std::size_t>(slot_)], path, 0);
}

EndsWithProgram EndsWithProgram::of_group(pid_t group) {
    EndsWithProgram ends;
    if ((ends.slot_ = free_slot()) >= 0) fill(slots[static_cast<std::size_t>(ends.slot_)], "", group);
    return ends;
}

EndsWithProgram::~EndsWithProgram() {
    if (slot_ < 0) return;
    Slot& slot = slots[static_cast<std::size_t>(slot_)];
    slot.changes.fetch_add(1, std::memory_order_relaxed);
    slot.taken.store(false, std::memory_order_release);
}

EndsWithProgram::EndsWithProgram(EndsWithProgram&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}

EndsWithProgram& EndsWithProgram::operator=(EndsWithProgram&& other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
}

void end_what_ends_with_program() {
    Ending ending;
    for (Slot& slot : slots)
        if (is_copied(slot, ending) && ending.group > 0) ::kill(-ending.group, SIGKILL);
    for (Slot& slot : slots)
        if (is_copied(slot, ending) && ending.group == 0) remove_all_of(AT_FDCWD, ending.path, 0);
}

}  // namespace dynlab::inline platform
