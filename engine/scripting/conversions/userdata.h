#pragma once
#include <concepts>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "platform/hash.h"
#include "scripting/conversions/arguments.h"
#include "scripting/conversions/object_type.h"
#include "scripting/runtime/kind_phrases.h"

namespace dynlab::inline scripting {

/// Each C++ class in a userdata states its object type (its members are a TypeEntry) and how many bytes it holds
/// outside Lua:
///   template <> struct Userdata<IdData> { static constexpr ObjectType type{"iddata"};
///                                         static std::size_t outside_bytes(const IdData&); };
/// A class of large objects that never change after they are pushed may also declare `static Digest digest(const T&)`,
/// of all its content: its objects are then passed on as constant, and the digest of each is computed once. Such
/// objects can be shared with C++ beyond the life of the userdata (shared_object).
template <class T>
struct Userdata;

template <class T>
concept KeepsDigest = requires(const T& object) {
    { Userdata<T>::digest(object) } -> std::same_as<Digest>;
};
template <class T>
using Access = std::conditional_t<KeepsDigest<T>, const T, T>;

/// A C++ object inside a userdata, with the bytes it was charged for.
template <class T>
struct UserdataObject {
    T object;
    std::size_t outside_bytes;

    UserdataObject(T given, std::size_t bytes) : object(std::move(given)), outside_bytes(bytes) {}
    T& get() { return object; }
};
template <KeepsDigest T>
struct UserdataObject<T> {
    std::shared_ptr<const T> object;
    std::size_t outside_bytes;
    std::optional<Digest> digest = {};  ///< computed at the first request

    UserdataObject(T given, std::size_t bytes)
        : object(std::make_shared<const T>(std::move(given))), outside_bytes(bytes) {}
    const T& get() { return *object; }
};

template <class T>
int destroy_userdata(lua_State* L) {
    auto* userdata = static_cast<UserdataObject<T>*>(lua_touserdata(L, 1));
    context_of(L).memory.remove_outside(userdata->outside_bytes);
    userdata->~UserdataObject<T>();
    return 0;
}

template <class T>
void push_userdata_metatable(lua_State* L) {
    push_metatable(L, Userdata<T>::type);
    lua_pushliteral(L, "__gc");
    if (lua_rawget(L, -2) == LUA_TNIL) {
        lua_pushliteral(L, "__gc");
        lua_pushcfunction(L, destroy_userdata<T>);
        lua_rawset(L, -4);
    }
    lua_pop(L, 1);
}

void charge_outside_bytes(lua_State* L, std::size_t bytes, const char* what);

/// Pushes `object`; its outside bytes count against the memory limit and drive the collector.
/// Lua code cannot see the `user_values`, which keep other Lua objects alive.
template <class T>
Access<T>& push_object(lua_State* L, T object, int user_values = 0) {
    const std::size_t bytes = Userdata<T>::outside_bytes(object);
    charge_outside_bytes(L, bytes, Userdata<T>::type.name);
    void* memory = lua_newuserdatauv(L, sizeof(UserdataObject<T>), user_values);
    auto* userdata = new (memory) UserdataObject<T>(std::move(object), bytes);
    context_of(L).memory.add_outside(bytes);
    push_userdata_metatable<T>(L);
    lua_setmetatable(L, -2);
    return userdata->get();
}

/// The object at a stack index, nullptr when something else is there.
template <class T>
Access<T>* to_object(lua_State* L, int index) {
    if (!is_object(L, index, Userdata<T>::type)) return nullptr;
    return &static_cast<UserdataObject<T>*>(lua_touserdata(L, index))->get();
}

/// The object at a stack index, which is of this class, shared with Lua.
template <KeepsDigest T>
std::shared_ptr<const T> shared_object(lua_State* L, int index) {
    return static_cast<UserdataObject<T>*>(lua_touserdata(L, index))->object;
}

/// The digest of the object at a stack index, which is of this class.
template <KeepsDigest T>
Digest digest_of_object(lua_State* L, int index) {
    auto* userdata = static_cast<UserdataObject<T>*>(lua_touserdata(L, index));
    if (!userdata->digest) userdata->digest = Userdata<T>::digest(*userdata->object);
    return *userdata->digest;
}

/// The object of argument `index`; throws InvalidArgument naming argument and wanted kind.
template <class T>
Access<T>& object_argument(const Call& call, int index, ArgumentName what) {
    Access<T>* object = index <= call.count() ? to_object<T>(call.state(), index) : nullptr;
    if (object == nullptr) wrong_argument(call.state(), index, what, with_article(Userdata<T>::type.name));
    return *object;
}

/// The object whose field or operator is asked for; unlike object_argument() it takes any that there may be.
template <class T>
const T& object_itself(const Call& call) {
    const T* object = to_object<T>(call.state(), 1);
    if (object == nullptr)
        wrong_argument(call.state(), 1, Userdata<T>::type.name, with_article(Userdata<T>::type.name));
    return *object;
}

}  // namespace dynlab::inline scripting
