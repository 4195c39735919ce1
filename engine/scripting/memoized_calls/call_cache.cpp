#include "scripting/memoized_calls/call_cache.h"

namespace dynlab::inline scripting {
namespace {

std::string entry_of_shape(const std::string& shape) {
    return EntryName("call-shapes").add(shape).text();
}
std::string entry_of_call(const std::string& call) {
    return EntryName("calls").add(call).text();
}

}  // namespace

bool CallCache::knows(const std::string& shape) const {
    return cache_.lasting() && cache_.recall(entry_of_shape(shape)).has_value();
}

std::optional<std::string> CallCache::recall(const std::string& call) const {
    return cache_.recall(entry_of_call(call));
}

void CallCache::remember(const std::string& shape, const std::string& call, std::string_view result) const {
    cache_.remember(entry_of_call(call), result);
    cache_.remember(entry_of_shape(shape), "");
}

void CallCache::forget(const std::string& shape) const {
    cache_.forget(entry_of_shape(shape));
}

void CallCache::forget_result(const std::string& call) const {
    cache_.forget(entry_of_call(call));
}

}  // namespace dynlab::inline scripting
