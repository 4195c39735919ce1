#pragma once
#include <chrono>
#include <lua.hpp>
#include <optional>
#include <string>

#include "platform/cache.h"

namespace dynlab::inline scripting {

class Call;

/// Calls `body`, or gives what an equal call of the same function gave that took long: the values, what it printed, the
/// figures it made. Calls are equal when all their arguments are, by content; those with functions of the script among
/// their arguments are created again, and so are all without RunOptions::call_cache.
int run_memoized_call(Call& call, int (*body)(Call&));

/// A binding of which this is worth it: `guarded<memoized_call<body>>`. What it does must follow from its arguments
/// alone, and it must leave what they hold as it is.
template <int (*kBody)(Call&)>
int memoized_call(Call& call) {
    return run_memoized_call(call, kBody);
}

/// Cache for results of slow calls. The shape of a call (its text with the size of large arguments instead of their
/// content) determines whether a cached result is possible. Without an entry for the shape the content of arguments is
/// not read.
class CallCache {
  public:
    using Duration = std::chrono::steady_clock::duration;
    /// Far more than it takes to read a result back.
    static constexpr Duration kMinDuration = std::chrono::milliseconds(10);

    /// Calls that take less than `min_duration` are not kept. `cache` must outlive it.
    explicit CallCache(const Cache& cache, Duration min_duration = kMinDuration)
        : cache_(cache), min_duration_(min_duration) {}

    bool worth_keeping(Duration taken) const { return taken >= min_duration_; }

    bool lasting() const { return cache_.lasting(); }
    /// Whether a call of this shape took long once and was kept.
    bool knows(const std::string& shape) const;
    /// The result of an equal call, as it was kept.
    std::optional<std::string> load_entry(const std::string& call) const;
    void save_entry(const std::string& shape, const std::string& call, std::string_view result) const;
    /// Removes the entry of a shape whose calls turned out to be fast.
    void erase_entry(const std::string& shape) const;
    /// Removes a cached result that cannot be read.
    void clear_result(const std::string& call) const;
    /// Counts a cache hit, or a slow call that was computed.
    void count_from_cache() { ++use_.from_cache; }
    void count_computed() { ++use_.made; }

    CacheUse use() const { return use_; }

  private:
    const Cache& cache_;
    Duration min_duration_;
    CacheUse use_;
};

/// Content of large arguments in the text of a call: kind and size, which is fast, or a digest of the content. Small
/// arguments are always included by value.
enum class LargeArguments { kBySize, kByContent };

/// A call as text: the function and its arguments, `first` to `last` on the stack, tables with all they hold. Equal
/// texts are equal calls. Nothing when an argument has no lasting content (see put_value) - by size, only some of those
/// are found.
std::optional<std::string> call_text(lua_State* L, const char* function, int first, int last, LargeArguments large);

}  // namespace dynlab::inline scripting
