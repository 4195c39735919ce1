#include "scripting/memoized_calls/memoized_call.h"

#include <chrono>

#include "scripting/memoized_calls/call_cache.h"
#include "scripting/memoized_calls/call_text.h"
#include "scripting/memoized_calls/value_archive.h"

namespace dynlab::inline scripting {
namespace {

using Clock = std::chrono::steady_clock;

/// Pushes the values of an archived result, prints its text and returns their number. Nothing, and nothing is done, for
/// bytes that hold no result.
std::optional<int> give_again(const Call& call, const std::string& bytes) {
    constexpr int kMostResults = 100;
    const int top = lua_gettop(call.state());
    luaL_checkstack(call.state(), kMostResults, "too many results");
    try {
        CborReader archive(bytes);
        const std::string printed = archive.text();
        const auto count = static_cast<int>(archive.whole(0, kMostResults));
        std::vector<FigurePointer> figures;
        for (int i = 0; i < count; ++i) push_archived_value(call, archive, figures);
        archive.expect_end();
        if (!printed.empty()) call.print(printed);
        for (const FigurePointer& figure : figures) call.context().recorder.add_figure(figure);
        return count;
    } catch (const ValueError&) {
        lua_settop(call.state(), top);
        return {};
    }
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
    CborWriter archive;
    archive.text(printed);
    archive.whole(count);
    const int top = lua_gettop(call.state());
    for (int i = top - count + 1; i <= top; ++i)
        if (!put_value(call.state(), i, archive)) return {};
    return archive.bytes();
}

/// Holds the arguments as the script gave them: a binding may put what it read in their places.
class KeptArguments {
  public:
    explicit KeptArguments(const Call& call) : L_(call.state()), count_(call.count()) {
        lua_createtable(L_, count_, 0);
        for (int i = 1; i <= count_; ++i) {
            lua_pushvalue(L_, i);
            lua_rawseti(L_, -2, i);
        }
        reference_ = luaL_ref(L_, LUA_REGISTRYINDEX);
    }
    ~KeptArguments() { luaL_unref(L_, LUA_REGISTRYINDEX, reference_); }
    KeptArguments(const KeptArguments&) = delete;
    KeptArguments& operator=(const KeptArguments&) = delete;

    std::optional<std::string> text(const char* function) const {
        luaL_checkstack(L_, count_ + 1, "too many arguments");
        const int top = lua_gettop(L_);
        lua_rawgeti(L_, LUA_REGISTRYINDEX, reference_);
        for (int i = 1; i <= count_; ++i) lua_rawgeti(L_, top + 1, i);
        auto result = call_text(L_, function, top + 2, top + 1 + count_, LargeArguments::kByContent);
        lua_settop(L_, top);
        return result;
    }

  private:
    lua_State* L_;
    int count_, reference_;
};

/// A call that is made now, watched for whether it is worth keeping.
class WatchedCall {
  public:
    WatchedCall(Call& call, CallCache& cache) : call_(call), cache_(cache) {}

    int run(Binding body) {
        const char* const function = call_.function_name();
        std::optional<std::string> shape, text;
        if (cache_.lasting()) shape = call_text(call_.state(), function, 1, call_.count(), LargeArguments::kBySize);
        const bool known = shape && cache_.knows(*shape);
        if (known) text = call_text(call_.state(), function, 1, call_.count(), LargeArguments::kByContent);
        if (const auto count = text ? recalled(*text) : std::nullopt) return *count;
        std::optional<KeptArguments> arguments;
        if (shape && !text) arguments.emplace(call_);
        const int count = compute(body);
        if (!cache_.worth_keeping(taken_) && known) cache_.forget(*shape);
        if (!cache_.worth_keeping(taken_) || call_.cancel()()) return count;
        if (arguments) text = arguments->text(function);
        if (text || !cache_.lasting()) cache_.count_computed();
        if (text) keep(*shape, *text, count);
        return count;
    }

  private:
    std::optional<int> recalled(const std::string& text) {
        const auto result = cache_.recall(text);
        if (!result) return {};
        const auto count = give_again(call_, *result);
        if (count)
            cache_.count_recalled();
        else
            cache_.forget_result(text);
        return count;
    }

    int compute(Binding body) {
        const PrintedText printed(call_.context());
        const auto start = Clock::now();
        const int count = body(call_);
        taken_ = Clock::now() - start;
        printed_ = printed.text();
        return count;
    }

    void keep(const std::string& shape, const std::string& text, int count) {
        if (const auto result = archive_of(call_, printed_, count)) cache_.remember(shape, text, *result);
    }

    Call& call_;
    CallCache& cache_;
    Clock::duration taken_{};
    std::string printed_;
};

}  // namespace

int run_memoized_call(Call& call, Binding body) {
    CallCache* const cache = call.context().options.call_cache;
    return cache ? WatchedCall(call, *cache).run(body) : body(call);
}

}  // namespace dynlab::inline scripting
