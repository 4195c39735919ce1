#include "scripting/interpreter/restricted_library.h"

#include <algorithm>
#include <vector>

#include "scripting/conversions/arguments.h"
#include "scripting/runtime/sandbox.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

constexpr lua_Integer kMaxTableLength = 100'000'000;

/// Calls the library function kept in upvalue 1 with all arguments.
int call_original(lua_State* L) {
    const int count = lua_gettop(L);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, count, LUA_MULTRET);
    return lua_gettop(L);
}

/// Functions that walk a table in C: its length, which __len can claim at will, must be one a table can have.
int call_with_checked_length(lua_State* L) {
    luaL_checkany(L, 1);
    if (luaL_getmetafield(L, 1, "__len") != LUA_TNIL) {
        lua_pop(L, 1);
        if (luaL_len(L, 1) > kMaxTableLength)
            raise_error(L, Message("the field __len of the table returns more elements than a table can have"));
    }
    return call_original(L);
}

/// table.move(a, first, last, ...) and table.concat(t, sep, first, last), unpack(t, first, last)
template <int kFirst>
int call_with_checked_range(lua_State* L) {
    const lua_Integer first = luaL_optinteger(L, kFirst, 1);
    if (!lua_isnoneornil(L, kFirst + 1)) {
        const lua_Integer last = luaL_checkinteger(L, kFirst + 1);
        const bool far_apart = last > first && static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first) >
                                                   static_cast<lua_Unsigned>(kMaxTableLength);
        if (far_apart)
            raise_error(L,
                        Message("the range from {} to {} contains more elements than a table can have", first, last));
    }
    return call_with_checked_length(L);
}

/// string.rep(s, n, sep), refused before the work when the memory limit cannot hold the result.
int repeat_string(lua_State* L) {
    std::size_t length = 0, separator = 0;
    luaL_checklstring(L, 1, &length);
    const lua_Integer count = luaL_checkinteger(L, 2);
    luaL_optlstring(L, 3, "", &separator);
    if (count <= 0 || length + separator == 0) {
        lua_pushliteral(L, "");
        return 1;
    }
    const double bytes = static_cast<double>(length + separator) * static_cast<double>(count);
    const MemoryAccount& memory = context_of(L).memory;
    if (bytes > static_cast<double>(memory.limit()))
        raise_error(L, Message("{}: {}", "rep",
                               Message("the string would require {} of memory, but the limit of the script is {}",
                                       size_phrase(bytes), size_phrase(static_cast<double>(memory.limit())))));
    return call_original(L);
}

int script_setmetatable(lua_State* L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    if (lua_istable(L, 2)) {
        lua_pushliteral(L, "__gc");
        if (lua_rawget(L, 2) != LUA_TNIL)
            raise_error(L, Message("{}: {}", "setmetatable",
                                   Message("the field __gc (finalizers) is not available to scripts")));
        lua_pop(L, 1);
    }
    return call_original(L);
}

int script_print(lua_State* L) {
    std::string line;
    for (int i = 1; i <= lua_gettop(L); ++i) line += (i == 1 ? "" : "\t") + text_for_reading(L, i);
    Call(L).print_lines(line + '\n');
    return 0;
}

int script_tostring(lua_State* L) {
    luaL_checkany(L, 1);
    const std::string text = value_text(L, 1);
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

/// collectgarbage() and collectgarbage("count"); how the collector works is not a script's business.
int script_collectgarbage(lua_State* L) {
    static const char* const kChoices[] = {"collect", "count", nullptr};
    if (luaL_checkoption(L, 1, "collect", kChoices) == 0) {
        lua_gc(L, LUA_GCCOLLECT);
        lua_pushinteger(L, 0);
    } else {
        lua_pushnumber(L, static_cast<double>(context_of(L).memory.used()) / 1024);
    }
    return 1;
}

int script_random(lua_State* L) {
    RandomStream& random = context_of(L).random;
    const int count = lua_gettop(L);
    if (count == 0) {
        lua_pushnumber(L, random.uniform());
        return 1;
    }
    const lua_Integer low = count == 1 ? 1 : luaL_checkinteger(L, 1);
    const lua_Integer high = luaL_checkinteger(L, count == 1 ? 1 : 2);
    luaL_argcheck(L, low <= high, count == 1 ? 1 : 2, "interval is empty");
    const double width = static_cast<double>(high) - static_cast<double>(low) + 1;
    lua_pushinteger(L, std::min(high, low + static_cast<lua_Integer>(random.uniform() * width)));
    return 1;
}

/// Keys in a repeatable order: numbers ascending, texts in alphabetical order, others as they come.
std::vector<int> sorted_keys(lua_State* L, int keys, int count) {
    std::vector<int> order(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) order[static_cast<std::size_t>(i)] = i + 1;
    struct Key {
        int kind;
        double number;
        std::string_view text;
    };
    std::vector<Key> values(static_cast<std::size_t>(count) + 1);
    for (int i = 1; i <= count; ++i) {
        Key& key = values[static_cast<std::size_t>(i)];
        const int type = lua_rawgeti(L, keys, i);
        key.kind = type == LUA_TNUMBER ? 0 : type == LUA_TSTRING ? 1 : 2;
        if (type == LUA_TNUMBER) key.number = lua_tonumber(L, -1);
        if (type == LUA_TSTRING) {
            std::size_t length = 0;
            const char* text = lua_tolstring(L, -1, &length);
            key.text = {text, length};  // stays alive: the table of keys holds it
        }
        lua_pop(L, 1);
    }
    std::stable_sort(order.begin(), order.end(), [&](int left, int right) {
        const Key &a = values[static_cast<std::size_t>(left)], &b = values[static_cast<std::size_t>(right)];
        if (a.kind != b.kind) return a.kind < b.kind;
        return a.kind == 0 ? a.number < b.number : a.kind == 1 && a.text < b.text;
    });
    return order;
}

/// math.max and math.min, which would give back a vector that is their only argument.
int call_with_numbers(lua_State* L) {
    for (int i = 1; i <= lua_gettop(L); ++i) luaL_checknumber(L, i);
    return call_original(L);
}

/// Iterator of pairs: upvalues are the sorted keys and the index reached. Keys removed meanwhile are skipped.
int next_pair(lua_State* L) {
    lua_Integer index = lua_tointeger(L, lua_upvalueindex(2));
    for (;;) {
        ++index;
        if (lua_rawgeti(L, lua_upvalueindex(1), index) == LUA_TNIL) return 1;
        lua_pushvalue(L, -1);
        if (lua_rawget(L, 1) != LUA_TNIL) break;
        lua_pop(L, 2);
    }
    lua_pushinteger(L, index);
    lua_replace(L, lua_upvalueindex(2));
    return 2;
}

int script_pairs(lua_State* L) {
    luaL_checkany(L, 1);
    if (luaL_getmetafield(L, 1, "__pairs") != LUA_TNIL) {
        lua_pushvalue(L, 1);
        lua_call(L, 1, 3);
        return 3;
    }
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_settop(L, 1);
    lua_newtable(L);
    int count = 0;
    lua_pushnil(L);
    while (lua_next(L, 1)) {
        lua_pop(L, 1);
        lua_pushvalue(L, -1);
        lua_rawseti(L, 2, ++count);
    }
    lua_createtable(L, count, 0);
    int index = 0;
    for (int key : sorted_keys(L, 2, count)) {
        lua_rawgeti(L, 2, key);
        lua_rawseti(L, 3, ++index);
    }
    lua_pushinteger(L, 0);
    lua_pushcclosure(L, next_pair, 2);
    lua_pushvalue(L, 1);
    return 2;
}

int next_element(lua_State* L) {
    const lua_Integer index = luaL_checkinteger(L, 2) + 1;
    if (index > luaL_len(L, 1)) return 0;
    lua_pushinteger(L, index);
    lua_geti(L, 1, index);
    return 2;
}

int next_entry(lua_State* L) {
    const lua_Integer index = luaL_checkinteger(L, 2) + 1;
    lua_pushinteger(L, index);
    return lua_geti(L, 1, index) == LUA_TNIL ? 1 : 2;
}

/// ipairs of tables as in Lua, and of vectors, whose elements end at #v.
int script_ipairs(lua_State* L) {
    luaL_checkany(L, 1);
    lua_pushcfunction(L, lua_isuserdata(L, 1) ? next_element : next_entry);
    lua_pushvalue(L, 1);
    lua_pushinteger(L, 0);
    return 3;
}

/// Replaces a field of the table on top with `wrapper`, which has the field's old value as upvalue.
void wrap_field(lua_State* L, const char* name, lua_CFunction wrapper) {
    lua_getfield(L, -1, name);
    lua_pushcclosure(L, wrapper, 1);
    lua_setfield(L, -2, name);
}

}  // namespace

void add_restricted_functions(lua_State* L) {
    luaL_requiref(L, "_G", luaopen_base, 0);
    lua_getfield(L, -1, "setmetatable");
    lua_pushcclosure(L, script_setmetatable, 1);
    lua_setfield(L, -3, "setmetatable");
    lua_pop(L, 1);
    set_function(L, "print", script_print);
    set_function(L, "tostring", script_tostring);
    set_function(L, "pairs", script_pairs);
    set_function(L, "ipairs", script_ipairs);
    set_function(L, "collectgarbage", script_collectgarbage);

    lua_getfield(L, -1, "string");
    wrap_field(L, "rep", repeat_string);
    lua_pop(L, 1);
    lua_getfield(L, -1, "table");
    for (const char* name : {"insert", "remove", "sort"}) wrap_field(L, name, call_with_checked_length);
    wrap_field(L, "concat", call_with_checked_range<3>);
    wrap_field(L, "move", call_with_checked_range<2>);
    wrap_field(L, "unpack", call_with_checked_range<2>);
    lua_pop(L, 1);
    lua_getfield(L, -1, "math");
    set_function(L, "random", script_random);
    for (const char* name : {"max", "min"}) wrap_field(L, name, call_with_numbers);
    lua_pop(L, 1);
}

}  // namespace dynlab::inline scripting
