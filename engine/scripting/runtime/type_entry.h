#pragma once
#include <lua.hpp>
#include <span>

namespace dynlab::inline scripting {

/// A kind of object that scripts hold, known by its address.
struct ObjectType {
    const char* name;  ///< "vector", "tf", "iddata", ... in messages
};

struct Member {
    const char* name;
    lua_CFunction function;  ///< guarded<...>; a field is read by calling it with the object
};

/// What objects of a kind compute on reading, their methods and operators. The bindings make one for each kind, and the
/// interpreter hands them to every runtime (RuntimeContext::types).
struct TypeEntry {
    const ObjectType* type;
    std::span<const Member> fields;     ///< v.name
    std::span<const Member> methods;    ///< v:name(...)
    std::span<const Member> operators;  ///< "__add", "__len", ...
    lua_CFunction element = nullptr;    ///< v[key] for keys that are not names
};

using TypeEntries = std::span<const TypeEntry>;

}  // namespace dynlab::inline scripting
