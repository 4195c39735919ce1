#include "scripting/memoized_calls/memoized_call.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "scripting/conversions/arguments.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/memoized_calls/value_archive.h"
#include "scripting/objects/data_object.h"

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
    return cache_.lasting() && cache_.load_entry(entry_of_shape(shape)).has_value();
}

std::optional<std::string> CallCache::load_entry(const std::string& call) const {
    return cache_.load_entry(entry_of_call(call));
}

void CallCache::save_entry(const std::string& shape, const std::string& call, std::string_view result) const {
    cache_.save_entry(entry_of_call(call), result);
    cache_.save_entry(entry_of_shape(shape), "");
}

void CallCache::erase_entry(const std::string& shape) const {
    cache_.erase_entry(entry_of_shape(shape));
}

void CallCache::clear_result(const std::string& call) const {
    cache_.erase_entry(entry_of_call(call));
}

namespace {

constexpr int kDeepestTableOfCall = 20;

/// Writes a sequence of values, each in a form from which its end is known.
class CallWriter {
  public:
    CallWriter(lua_State* L, LargeArguments large) : L_(L), by_content_(large == LargeArguments::kByContent) {}

    void put_text(std::string_view text) {
        put(text.size());
        text_ += text;
    }

    /// False, with something written, for what has no lasting content.
    bool put_value_at(int index, int depth = 0) {
        luaL_checkstack(L_, 8, "too many nested tables");
        const int type = lua_type(L_, index);
        put(type);
        switch (type) {
            case LUA_TNIL:
                return true;
            case LUA_TBOOLEAN:
                put(lua_toboolean(L_, index));
                return true;
            case LUA_TNUMBER:
                put_number(index);
                return true;
            case LUA_TSTRING: {
                std::size_t length = 0;
                const char* text = lua_tolstring(L_, index, &length);
                put_text({text, length});
                return true;
            }
            case LUA_TTABLE:
                return put_table_at(index, depth + 1);
            case LUA_TUSERDATA:
                return put_object_at(index);
            default:
                return false;
        }
    }

    std::string text() && { return std::move(text_); }

  private:
    template <class T>
    void put(const T& value) {
        text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }

    void put_digest(const Digest& digest) {
        put(digest.high);
        put(digest.low);
    }

    void put_number(int index) {
        put(lua_isinteger(L_, index));
        if (lua_isinteger(L_, index))
            put(lua_tointeger(L_, index));
        else
            put(lua_tonumber(L_, index));
    }

    bool put_object_at(int index) {
        put_text(object_name(L_, index));
        for (NumericBlock* block : {to_vector(L_, index), to_matrix(L_, index)}) {
            if (block == nullptr) continue;
            put_numbers(*block);
            return true;
        }
        if (const IdData* data = to_object<IdData>(L_, index)) {
            put_data(*data, index);
            return true;
        }
        if (!by_content_) return true;
        CborWriter archive;
        if (!put_value(L_, index, archive)) return false;
        put_digest(digest_of(archive.bytes()));
        return true;
    }

    void put_numbers(NumericBlock& block) {
        put(block.rows);
        put(block.columns);
        const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(block.rows * block.columns);
        if (by_content_) put_digest(digest_of({reinterpret_cast<const char*>(block.data()), bytes}));
    }

    void put_data(const IdData& data, int index) {
        put(data.sample_count());
        put(data.experiments.size());
        put(data.input_count());
        put(data.output_count());
        if (by_content_) put_digest(digest_of_object<IdData>(L_, index));
    }

    bool has_metatable(int index) {
        if (!lua_getmetatable(L_, index)) return false;
        lua_pop(L_, 1);
        return true;
    }

    /// The entries ordered by what their keys are written as: Lua's own order changes from run to run.
    bool put_table_at(int index, int depth) {
        const auto data_name = name_of_refusing_table(L_, index);
        if (depth > kDeepestTableOfCall || (!data_name && has_metatable(index))) return false;
        put_text(data_name.value_or(""));
        std::vector<std::pair<std::string, std::string>> entries;
        const LargeArguments large = by_content_ ? LargeArguments::kByContent : LargeArguments::kBySize;
        lua_pushnil(L_);
        while (lua_next(L_, index)) {
            CallWriter key(L_, large), value(L_, large);
            const int top = lua_gettop(L_);
            const bool known = key.put_value_at(top - 1, depth) && value.put_value_at(top, depth);
            lua_pop(L_, 1);
            if (!known) {
                lua_pop(L_, 1);
                return false;
            }
            entries.emplace_back(std::move(key).text(), std::move(value).text());
        }
        std::sort(entries.begin(), entries.end());
        put(entries.size());
        for (const auto& [key, value] : entries) {
            put_text(key);
            put_text(value);
        }
        return true;
    }

    lua_State* L_;
    bool by_content_;
    std::string text_;
};

}  // namespace

std::optional<std::string> call_text(lua_State* L, const char* function, int first, int last, LargeArguments large) {
    CallWriter writer(L, large);
    writer.put_text(function);
    if (const std::string language = context_of(L).services.language_code(); language != "en")
        writer.put_text(language);  // its result holds sentences
    for (int i = first; i <= last; ++i)
        if (!writer.put_value_at(i)) return {};
    return std::move(writer).text();
}

namespace {

using Clock = std::chrono::steady_clock;

/// Pushes the values of an archived result, prints its text and returns their number. Nothing, and nothing is done, for
/// bytes that hold no result.
std::optional<int> give_again(const Call& call, const std::string& bytes) {
    constexpr int kMaxResults = 100;
    const int top = lua_gettop(call.state());
    luaL_checkstack(call.state(), kMaxResults, "too many results");
    try {
        CborReader archive(bytes);
        const std::string printed = archive.text();
        const auto count = static_cast<int>(archive.whole(0, kMaxResults));
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
class SavedArguments {
  public:
    explicit SavedArguments(const Call& call) : L_(call.state()), count_(call.count()) {
        lua_createtable(L_, count_, 0);
        for (int i = 1; i <= count_; ++i) {
            lua_pushvalue(L_, i);
            lua_rawseti(L_, -2, i);
        }
        reference_ = luaL_ref(L_, LUA_REGISTRYINDEX);
    }
    ~SavedArguments() { luaL_unref(L_, LUA_REGISTRYINDEX, reference_); }
    SavedArguments(const SavedArguments&) = delete;
    SavedArguments& operator=(const SavedArguments&) = delete;

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
        if (const auto count = text ? from_cache(*text) : std::nullopt) return *count;
        std::optional<SavedArguments> arguments;
        if (shape && !text) arguments.emplace(call_);
        const int count = compute(body);
        if (!cache_.worth_keeping(taken_) && known) cache_.erase_entry(*shape);
        if (!cache_.worth_keeping(taken_) || call_.cancel()()) return count;
        if (arguments) text = arguments->text(function);
        if (text || !cache_.lasting()) cache_.count_computed();
        if (text) keep(*shape, *text, count);
        return count;
    }

  private:
    std::optional<int> from_cache(const std::string& text) {
        const auto result = cache_.load_entry(text);
        if (!result) return {};
        const auto count = give_again(call_, *result);
        if (count)
            cache_.count_from_cache();
        else
            cache_.clear_result(text);
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
        if (const auto result = archive_of(call_, printed_, count)) cache_.save_entry(shape, text, *result);
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
