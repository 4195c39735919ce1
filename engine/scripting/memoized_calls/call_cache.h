#pragma once
#include <optional>
#include <string>

#include "platform/cache.h"

namespace dynlab::inline scripting {

/// Results of calls that took long, kept between runs. Which calls may be among them is known by their shapes (the call
/// with its large arguments by size), so that where nothing is kept no content is looked at.
class CallCache {
  public:
    explicit CallCache(const Cache& cache) : cache_(cache) {}  ///< `cache` must outlive it

    bool lasting() const { return cache_.lasting(); }
    /// Whether a call of this shape took long once and was kept.
    bool knows(const std::string& shape) const;
    /// The result of an equal call, as it was kept.
    std::optional<std::string> recall(const std::string& call) const;
    void remember(const std::string& shape, const std::string& call, std::string_view result) const;
    /// Calls of this shape are quick after all.
    void forget(const std::string& shape) const;
    /// What was kept of this call cannot be read.
    void forget_result(const std::string& call) const;
    /// One more was spared, or computed that takes long.
    void count_recalled() { ++use_.recalled; }
    void count_computed() { ++use_.made; }

    CacheUse use() const { return use_; }

  private:
    const Cache& cache_;
    CacheUse use_;
};

}  // namespace dynlab::inline scripting
