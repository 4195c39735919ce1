#include "scripting/runtime/memory_account.h"

#include <algorithm>
#include <cstdlib>

namespace dynlab::inline scripting {

void* MemoryAccount::allocate(void* account, void* block, std::size_t old_size, std::size_t new_size) {
    auto& self = *static_cast<MemoryAccount*>(account);
    if (block == nullptr) old_size = 0;  // Lua passes the kind of object here
    if (new_size == 0) {
        std::free(block);
        self.used_ -= old_size;
        return nullptr;
    }
    if (new_size > old_size && !self.fits(new_size - old_size)) {
        if (self.on_refusal) self.on_refusal();
        return nullptr;
    }
    void* result = std::realloc(block, new_size);
    if (result != nullptr) {
        self.used_ = self.used_ - old_size + new_size;
        self.peak_ = std::max(self.peak_, self.used_);
    }
    return result;
}

void MemoryAccount::add_outside(std::size_t bytes) {
    used_ += bytes;
    peak_ = std::max(peak_, used_);
}

Message size_phrase(double bytes) {
    return bytes >= 1e9 ? Message("{} GB", significant(bytes / 1e9, 3)) : Message("{} MB", significant(bytes / 1e6, 3));
}

}  // namespace dynlab::inline scripting
