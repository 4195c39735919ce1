#include "scripting/memoized_calls/memoized_call.h"

#include <chrono>

#include "platform/content_cache.h"
#include "scripting/memoized_calls/value_archive.h"

namespace dynlab::inline scripting {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kLong = 10ms;  // far more than it takes to read a result back
constexpr auto kQuick = 2ms;  // not even worth a look: a loop of estimations on records of one length, say

/// Nothing when an argument has no lasting content.
std::optional<std::string> archive_of_arguments(const Call& call) {
    ArchiveWriter arguments;
    for (int i = 1; i <= call.count(); ++i)
        if (!put_value(call.state(), i, arguments)) return {};
    return arguments.bytes();
}

/// Pushes the values of an archived result and returns their number.
int give_again(const Call& call, const std::string& bytes) {
    ArchiveReader archive(bytes);
    if (const auto printed = archive.get<std::string>(); !printed.empty()) call.print(printed);
    const int count = archive.get<int>();
    luaL_checkstack(call.state(), count, "too many results");
    for (int i = 0; i < count; ++i) push_archived_value(call, archive);
    return count;
}

/// What is printed while it lives.
class PrintedText {
  public:
    explicit PrintedText(RuntimeContext& context) : context_(context), before_(context.printed_by_call) {
        context.printed_by_call = &text_;
    }
    ~PrintedText() { context_.printed_by_call = before_; }
    PrintedText(const PrintedText&) = delete;
    PrintedText& operator=(const PrintedText&) = delete;
    const std::string& text() const { return text_; }

  private:
    RuntimeContext& context_;
    std::string* before_;
    std::string text_;
};

std::optional<std::string> archive_of(const Call& call, const std::string& printed, int count) {
    ArchiveWriter archive;
    archive.put(printed);
    archive.put(count);
    const int top = lua_gettop(call.state());
    for (int i = top - count + 1; i <= top; ++i)
        if (!put_value(call.state(), i, archive)) return {};
    return archive.bytes();
}

}  // namespace

int run_memoized_call(Call& call, Binding body) {
    ContentCache* memory = call.context().options.memoized_calls;
    const auto arguments = memory ? archive_of_arguments(call) : std::nullopt;
    if (!arguments) return body(call);
    auto& quick_calls = call.context().quick_calls;
    const std::pair<std::string, std::size_t> kind{call.function_name(), arguments->size()};
    if (quick_calls.count(kind)) return body(call);
    const std::string key = memory->key({kind.first, *arguments});
    if (const auto known = memory->recall(key)) return give_again(call, *known);
    const PrintedText printed(call.context());
    const auto start = Clock::now();
    const int count = body(call);
    const auto taken = Clock::now() - start;
    if (taken < kQuick) quick_calls.insert(kind);
    if (taken < kLong || call.cancel()()) return count;
    if (const auto result = archive_of(call, printed.text(), count)) memory->remember(key, *result);
    return count;
}

}  // namespace dynlab::inline scripting
