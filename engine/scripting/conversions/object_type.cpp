#include "scripting/conversions/object_type.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "platform/spelling.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/kind_phrases.h"
#include "scripting/runtime/matlab_hints.h"
#include "scripting/runtime/sandbox.h"

namespace dynlab::inline scripting {
namespace {

char type_key;  // its address is the key of the type in its metatable

void push_members(lua_State* L, std::span<const Member> members) {
    lua_createtable(L, 0, static_cast<int>(members.size()));
    for (const Member& member : members) {
        lua_pushlightuserdata(L, const_cast<char*>(member.name));
        lua_pushcclosure(L, member.function, 1);
        lua_setfield(L, -2, member.name);
    }
}

bool is_library_function(lua_State* L, const std::string& name) {
    push_library(L);
    lua_pushstring(L, name.c_str());
    const bool found = lua_rawget(L, -2) == LUA_TFUNCTION;
    lua_pop(L, 2);
    return found;
}

Message unknown_member_of(lua_State* L, const TypeEntry& members, const std::string& key) {
    const ObjectType& type = *members.type;
    std::vector<std::string> names;
    for (const Member& member : members.fields) names.emplace_back(member.name);
    for (const Member& member : members.methods) names.emplace_back(member.name);
    const auto near = nearest_word(key, names);
    const Message object = with_article(type.name);
    const std::string singular = key.ends_with('s') ? key.substr(0, key.size() - 1) : key;
    const auto with_hint = [&](const Message& hint) {
        return Message("{} has no field or method '{}'; {}", object, key, hint);
    };
    const auto as_function = [&](const std::string& name) {
        return with_hint(Message("call the function {}(...)", name));
    };
    if (is_library_function(L, key)) return as_function(key);
    if (const Message* const hint = foreign_member_hint(type.name, key)) return with_hint(*hint);
    if (near) return Message("{} has no field or method '{}'; did you mean '{}'?", object, key, *near);
    if (is_library_function(L, singular)) return as_function(singular);
    if (const Message* const hint = matlab_name_hint(key)) return with_hint(*hint);
    return names.empty() ? Message("{} has no field or method '{}'", object, key)
                         : Message("{} has no field or method '{}'; it has {}", object, key, listed(names));
}

/// The help page that lists the members of an object of this kind.
std::string_view page_of(std::string_view kind) {
    using KindPage = std::pair<std::string_view, std::string_view>;
    static constexpr std::array kPages = {KindPage{"complex number", "pole"},
                                          KindPage{"grey-box estimate", "greyest"},
                                          KindPage{"grey-box model", "idgrey"},
                                          KindPage{"model", "tf"},
                                          KindPage{"Monte Carlo study", "montecarlo"},
                                          KindPage{"process structure", "idproc"},
                                          KindPage{"regression", "lsq"},
                                          KindPage{"simulated model", "narx"},
                                          KindPage{"state-space model", "ss"},
                                          KindPage{"table of ARX orders", "arxstruc"},
                                          KindPage{"table of orders", "srivcstruc"}};
    const auto found = std::ranges::find(kPages, kind, &KindPage::first);
    return found == kPages.end() ? kind : found->second;
}

Message no_elements(const ObjectType& type) {
    if (std::string_view(type.name) == "figure")
        return Message(
            "a figure has no elements; help(\"figure\") lists its fields, and bode_values(G, w), freqresp(G, w) and "
            "lsim(G, u, t) return numbers");
    return Message("{} has no elements; help(\"{}\") lists its fields", with_article(type.name), page_of(type.name));
}

/// __index; upvalues: methods, fields, the entry of the type.
int read_member(lua_State* L) {
    const auto& entry = *static_cast<const TypeEntry*>(lua_touserdata(L, lua_upvalueindex(3)));
    if (lua_type(L, 2) != LUA_TSTRING && entry.element != nullptr) return entry.element(L);
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(1)) != LUA_TNIL) return 1;
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) {
        lua_pushvalue(L, 1);
        lua_call(L, 1, 1);
        return 1;
    }
    lua_settop(L, 2);
    if (lua_type(L, 2) != LUA_TSTRING) raise_error(L, no_elements(*entry.type));
    if (luaL_getmetafield(L, 1, "__named") !=
        LUA_TNIL) {  // names that only the object knows; raises for others, or nil
        lua_pushvalue(L, 1);
        lua_pushvalue(L, 2);
        lua_call(L, 2, 1);
        if (!lua_isnil(L, -1)) return 1;
        lua_settop(L, 2);
    }
    raise_error(L, unknown_member_of(L, entry, lua_tostring(L, 2)));
}

int refuse_writing(lua_State* L) {
    const auto& type = *static_cast<const ObjectType*>(lua_touserdata(L, lua_upvalueindex(1)));
    raise_error(L, Message("the fields of {} cannot be assigned; use a method, or create a new object",
                           with_article(type.name)));
}

/// __concat: Lua would say "concatenate a userdata value".
int refuse_joining(lua_State* L) {
    const auto& type = *static_cast<const ObjectType*>(lua_touserdata(L, lua_upvalueindex(1)));
    raise_error(
        L, Message("the operator .. joins strings; convert {} to a string first: tostring(x)", with_the(type.name)));
}

void set_with_type(lua_State* L, const char* name, lua_CFunction function, const ObjectType& type) {
    lua_pushlightuserdata(L, const_cast<ObjectType*>(&type));
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, name);
}

void make_metatable(lua_State* L, const ObjectType& type) {
    const TypeEntry& members = members_of(L, type);
    lua_createtable(L, 0, static_cast<int>(members.operators.size()) + 5);
    lua_pushstring(L, type.name);
    lua_setfield(L, -2, "__name");
    lua_pushstring(L, type.name);
    lua_setfield(L, -2, "__metatable");
    set_with_type(L, "__newindex", refuse_writing, type);
    set_with_type(L, "__concat", refuse_joining, type);
    for (const Member& member : members.operators) {
        lua_pushlightuserdata(L, const_cast<char*>(member.name));
        lua_pushcclosure(L, member.function, 1);
        lua_setfield(L, -2, member.name);
    }
    lua_pushlightuserdata(L, const_cast<ObjectType*>(&type));
    lua_rawsetp(L, -2, &type_key);
    push_members(L, members.methods);
    push_members(L, members.fields);
    lua_pushlightuserdata(L, const_cast<TypeEntry*>(&members));
    lua_pushcclosure(L, read_member, 3);
    lua_setfield(L, -2, "__index");
}

}  // namespace

const TypeEntry& members_of(lua_State* L, const ObjectType& type) {
    return *context_of(L).types.at(&type);
}

void push_metatable(lua_State* L, const ObjectType& type) {
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &type) != LUA_TNIL) return;
    lua_pop(L, 1);
    make_metatable(L, type);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &type);
}

bool is_object(lua_State* L, int index, const ObjectType& type) {
    if (lua_type(L, index) != LUA_TUSERDATA || !lua_getmetatable(L, index)) return false;
    lua_rawgetp(L, LUA_REGISTRYINDEX, &type);
    const bool same = lua_rawequal(L, -1, -2) != 0;
    lua_pop(L, 2);
    return same;
}

const ObjectType* object_type(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TUSERDATA || !lua_getmetatable(L, index)) return nullptr;
    lua_rawgetp(L, -1, &type_key);
    const auto* type = static_cast<const ObjectType*>(lua_touserdata(L, -1));
    lua_pop(L, 2);
    return type;
}

std::string object_name(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TUSERDATA || luaL_getmetafield(L, index, "__name") != LUA_TSTRING) return {};
    std::string name = lua_tostring(L, -1);
    lua_pop(L, 1);
    return name;
}

}  // namespace dynlab::inline scripting
