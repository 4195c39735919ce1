#pragma once
#include <lua.hpp>
#include <string>

#include "scripting/runtime/type_entry.h"

namespace dynlab::inline scripting {

/// Pushes the type's metatable, made on first use and locked against scripts.
void push_metatable(lua_State* L, const ObjectType& type);
/// Whether the value at `index` is a userdata of this type.
bool is_object(lua_State* L, int index, const ObjectType& type);
/// Type of the object at `index`; nullptr for anything else.
const ObjectType* object_type(lua_State* L, int index);
/// What objects of the type can do.
const TypeEntry& members_of(lua_State* L, const ObjectType& type);
/// Name of the object at `index` ("vector"); empty for anything else.
std::string object_name(lua_State* L, int index);

}  // namespace dynlab::inline scripting
