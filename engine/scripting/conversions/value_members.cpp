#include "scripting/conversions/value_members.h"

#include "scripting/conversions/object_type.h"
#include "scripting/runtime/prompt_variables.h"
#include "scripting/runtime/sandbox.h"

namespace dynlab::inline scripting {
namespace {

constexpr int kMaxIndexChain = 10;

/// Replaces the table on top by its __index table; false, with nothing left of it, when there is none.
bool step_to_index_table(lua_State* L) {
    if (!lua_getmetatable(L, -1)) {
        lua_pop(L, 1);
        return false;
    }
    lua_pushliteral(L, "__index");
    lua_rawget(L, -2);
    lua_replace(L, -3);
    lua_pop(L, 1);
    if (lua_istable(L, -1)) return true;
    lua_pop(L, 1);
    return false;
}

/// Replaces the table on top by its member `name`; false, with nothing left of it, when there is none.
bool step_into_table(lua_State* L, std::string_view name) {
    for (int i = 0; i < kMaxIndexChain; ++i) {
        lua_pushlstring(L, name.data(), name.size());
        if (lua_rawget(L, -2) != LUA_TNIL) {
            lua_replace(L, -2);
            return true;
        }
        lua_pop(L, 1);
        if (!step_to_index_table(L)) return false;
    }
    lua_pop(L, 1);
    return false;
}

/// The same for an object: a field is computed by its own function, whose refusal counts as missing.
bool step_into_object(lua_State* L, std::string_view name) {
    const ObjectType* type = object_type(L, -1);
    for (const Member& member : type != nullptr ? members_of(L, *type).fields : std::span<const Member>()) {
        if (member.name != name) continue;
        lua_pushlightuserdata(L, const_cast<char*>(member.name));
        lua_pushcclosure(L, member.function, 1);
        lua_insert(L, -2);
        if (lua_pcall(L, 1, 1, 0) == LUA_OK) return true;
        break;
    }
    lua_pop(L, 1);
    return false;
}

bool step_into(lua_State* L, std::string_view name) {
    if (lua_istable(L, -1)) return step_into_table(L, name);
    return step_into_object(L, name);
}

/// Pushes the tables in which a statement's names are looked up, first to last, and returns their number.
int push_scopes(lua_State* L) {
    push_prompt_variables(L);
    const bool has_variables = lua_istable(L, -1);
    if (!has_variables) lua_pop(L, 1);
    lua_pushglobaltable(L);
    push_library(L);
    return has_variables ? 3 : 2;
}

}  // namespace

bool push_value_of(lua_State* L, const std::vector<std::string_view>& chain) {
    luaL_checkstack(L, 10, nullptr);
    const int top = lua_gettop(L);
    const int scopes = push_scopes(L);
    bool found = false;
    for (int i = 1; i <= scopes && !found; ++i) {
        lua_pushlstring(L, chain.front().data(), chain.front().size());
        found = lua_rawget(L, top + i) != LUA_TNIL;
        if (!found) lua_pop(L, 1);
    }
    for (std::size_t i = 1; i < chain.size() && found; ++i) found = step_into(L, chain[i]);
    if (found) lua_replace(L, top + 1);
    lua_settop(L, found ? top + 1 : top);
    return found;
}

std::vector<std::string> member_names(lua_State* L, MemberKind kind) {
    std::vector<std::string> names;
    const int top = lua_gettop(L);
    if (const ObjectType* type = object_type(L, -1)) {
        const int object = lua_gettop(L);
        const TypeEntry& members = members_of(L, *type);
        for (const Member& member : kind == MemberKind::kField ? members.fields : members.methods) {
            lua_pushvalue(L, object);
            if (kind == MemberKind::kMethod || step_into_object(L, member.name)) names.emplace_back(member.name);
            lua_settop(L, object);
        }
        return names;
    }
    lua_pushvalue(L, -1);
    if (lua_isstring(L, -1) && kind == MemberKind::kMethod) {
        push_library(L);
        lua_pushliteral(L, "string");
        lua_rawget(L, -2);
        lua_replace(L, top + 1);
        lua_settop(L, top + 1);
    }
    for (int i = 0; i < kMaxIndexChain && lua_istable(L, -1); ++i) {
        collect_text_keys(L, -1, names);
        if (!step_to_index_table(L)) break;
    }
    lua_settop(L, top);
    return names;
}

std::vector<std::string> visible_names(lua_State* L) {
    luaL_checkstack(L, 10, nullptr);
    const int top = lua_gettop(L);
    std::vector<std::string> names;
    for (int i = 1, scopes = push_scopes(L); i <= scopes; ++i) collect_text_keys(L, top + i, names);
    lua_settop(L, top);
    return names;
}

}  // namespace dynlab::inline scripting
