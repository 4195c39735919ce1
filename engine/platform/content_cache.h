#pragma once
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "platform/cache.h"

namespace dynlab::inline platform {

/// Keeps what was expensive to make in one of the program's caches, under a key made of all it was made from. Whatever
/// happens to the disk, work goes on: what cannot be kept is not kept, what is spoilt is not recalled and is forgotten.
class ContentCache {
  public:
    explicit ContentCache(const std::string& name, std::uint64_t limit_bytes = 256u << 20);

    /// A key of all parts in their order, and of the running program.
    std::string key(std::initializer_list<std::string_view> parts) const;

    std::optional<std::string> recall(const std::string& key);
    void remember(const std::string& key, std::string_view bytes);

    std::size_t recalled() const { return recalled_; }
    std::size_t remembered() const { return remembered_; }  ///< made anew, whether they could be kept or not

  private:
    void keep(const std::string& key, std::string_view bytes) const;

    Cache cache_;
    std::string program_;
    std::size_t recalled_ = 0, remembered_ = 0;
};

}  // namespace dynlab::inline platform
