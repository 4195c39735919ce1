#pragma once
#include <chrono>
#include <optional>
#include <string>

#include "platform/cache.h"

namespace dynlab::inline scripting {

/// Results of calls that took long, kept between runs. Which calls may be among them is known by their shapes (the call
/// with its large arguments by size), so that where nothing is kept no content is looked at.
class CallCache {
  public:
    using Duration = std::chrono::steady_clock::duration;
    /// Far more than it takes to read a result back.
    static constexpr Duration kShortest = std::chrono::milliseconds(10);

    /// Calls that take less than `shortest` are not kept. `cache` must outlive it.
    explicit CallCache(const Cache& cache, Duration shortest = kShortest) : cache_(cache), shortest_(shortest) {}

    bool worth_keeping(Duration taken) const { return taken >= shortest_; }

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
    Duration shortest_;
    CacheUse use_;
};

}  // namespace dynlab::inline scripting
