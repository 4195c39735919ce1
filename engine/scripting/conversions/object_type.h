#pragma once
#include <lua.hpp>
#include <span>
#include <string>

namespace dynlab::inline scripting {

struct Member {
    const char* name;
    lua_CFunction function;  ///< guarded<...>; a field is read by calling it with the object
};

/// A kind of object that scripts hold: its name in messages, what it computes on reading, its methods and operators.
struct ObjectType {
    const char* name;                   ///< "vector", "tf", "iddata", ...
    std::span<const Member> fields;     ///< v.name
    std::span<const Member> methods;    ///< v:name(...)
    std::span<const Member> operators;  ///< "__add", "__len", ...
    lua_CFunction element = nullptr;    ///< v[key] for keys that are not names
};

/// Pushes the type's metatable, made on first use and locked against scripts.
void push_metatable(lua_State* L, const ObjectType& type);
/// Whether the value at `index` is a userdata of this type.
bool is_object(lua_State* L, int index, const ObjectType& type);
/// Type of the object at `index`; nullptr for anything else.
const ObjectType* object_type(lua_State* L, int index);
/// Name of the object at `index` ("vector"); empty for anything else.
std::string object_name(lua_State* L, int index);

}  // namespace dynlab::inline scripting
