#include "scripting/memoized_calls/call_text.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "scripting/conversions/numeric.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/memoized_calls/value_archive.h"
#include "scripting/objects/data_object.h"

namespace dynlab::inline scripting {
namespace {

constexpr int kDeepestTableOfCall = 20;

/// Writes values one behind the other, each so that it tells where it ends.
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

}  // namespace dynlab::inline scripting
