#pragma once
#include <cstddef>
#include <functional>

#include "base/message.h"

namespace dynlab::inline scripting {

/// Counts what a script holds: Lua's own blocks, and the outside bytes of C++ objects that userdata own. Refuses blocks
/// beyond the limit, so that a script cannot take the machine's memory.
class MemoryAccount {
  public:
    explicit MemoryAccount(std::size_t limit_bytes) : limit_(limit_bytes) {}

    /// lua_Alloc with the account as user data.
    static void* allocate(void* account, void* block, std::size_t old_size, std::size_t new_size);

    bool fits(std::size_t bytes) const { return bytes <= limit_ && used_ <= limit_ - bytes; }
    void add_outside(std::size_t bytes);
    void remove_outside(std::size_t bytes) { used_ -= bytes; }

    std::size_t limit() const { return limit_; }
    std::size_t used() const { return used_; }
    std::size_t peak() const { return peak_; }

    std::function<void()> on_refusal;  ///< called when a block is refused; must not allocate

  private:
    std::size_t limit_, used_ = 0, peak_ = 0;
};

/// "2.15 GB", "67.1 MB"
Message size_phrase(double bytes);

}  // namespace dynlab::inline scripting
