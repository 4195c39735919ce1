#include "platform/files/ends_with_program.h"

#include <fcntl.h>
#include <linux/limits.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace dynlab::inline platform {
namespace {

/// Nothing that a signal's handler reads is ever given back: it may come between any two steps.
struct Slot {
    std::atomic<bool> taken{false}, known{false};
    pid_t owner = 0, group = 0;
    char path[PATH_MAX] = {};
};

constexpr int kSlots = 128;

std::array<Slot, kSlots> slots;

int free_slot() {
    for (int i = 0; i < kSlots; ++i)
        if (bool taken = false; slots[static_cast<std::size_t>(i)].taken.compare_exchange_strong(taken, true)) return i;
    return -1;
}

constexpr int kDeepest = 32;

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
    if (::unlinkat(folder, name, 0) == 0 || depth > kDeepest) return;
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
    Slot& slot = slots[static_cast<std::size_t>(slot_)];
    std::copy_n(path.c_str(), path.size() + 1, slot.path);
    slot.owner = ::getpid(), slot.group = 0;
    slot.known = true;
}

EndsWithProgram EndsWithProgram::of_group(pid_t group) {
    EndsWithProgram ends;
    if ((ends.slot_ = free_slot()) < 0) return ends;
    Slot& slot = slots[static_cast<std::size_t>(ends.slot_)];
    slot.owner = ::getpid(), slot.group = group;
    slot.known = true;
    return ends;
}

EndsWithProgram::~EndsWithProgram() {
    if (slot_ < 0) return;
    Slot& slot = slots[static_cast<std::size_t>(slot_)];
    slot.known = false;
    slot.taken = false;
}

EndsWithProgram::EndsWithProgram(EndsWithProgram&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}

EndsWithProgram& EndsWithProgram::operator=(EndsWithProgram&& other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
}

void end_what_ends_with_program() {
    for (const Slot& slot : slots)
        if (slot.known && slot.owner == ::getpid() && slot.group > 0) ::kill(-slot.group, SIGKILL);
    for (const Slot& slot : slots)
        if (slot.known && slot.owner == ::getpid() && slot.group == 0) remove_all_of(AT_FDCWD, slot.path, 0);
}

}  // namespace dynlab::inline platform
