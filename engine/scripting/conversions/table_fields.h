#pragma once
#include <concepts>
#include <functional>
#include <iterator>
#include <optional>
#include <string>

#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {

/// Pushes a table of what `push(item)` pushes for each item.
template <class Items, class Push>
int give_list(const Call& call, const Items& items, const Push& push) {
    lua_createtable(call.state(), static_cast<int>(std::size(items)), 0);
    lua_Integer index = 0;
    for (const auto& item : items) {
        push(item);
        lua_rawseti(call.state(), -2, ++index);
    }
    return 1;
}

/// Pushes what a script sees of a value: a number, true or false, a text, a vector or a matrix, an object, a table of
/// the values of a list.
template <class T>
int give_value(const Call& call, const T& value) {
    if constexpr (std::same_as<T, bool> || std::floating_point<T>)
        return call.give(value);
    else if constexpr (std::integral<T>)
        return call.give_integer(value);
    else if constexpr (std::convertible_to<const T&, std::string>)
        return call.give(std::string(value));
    else if constexpr (requires { Userdata<T>::type; })
        return push_object(call.state(), value), 1;
    else if constexpr (requires { requires T::ColsAtCompileTime == 1; })
        return call.give_vector(value);
    else if constexpr (requires { T::ColsAtCompileTime; })
        return call.give_matrix(value);
    else
        return give_list(call, value, [&](const auto& item) { give_value(call, item); });
}

/// One column as a vector, several as a matrix.
inline int give_columns(const Call& call, const Matrix& columns) {
    return columns.cols() == 1 ? call.give_vector(columns.col(0)) : call.give_matrix(columns);
}

/// Sets fields of the table on top of the stack, which stays there: name, value, name, value, ... An empty optional
/// sets none.
template <class T, class... More>
void set_field(const Call& call, const char* name, const T& value, const More&... more) {
    if constexpr (requires { value.has_value(); }) {
        if (value) set_field(call, name, *value);
    } else {
        give_value(call, value);
        lua_setfield(call.state(), -2, name);
    }
    if constexpr (sizeof...(more) > 0) set_field(call, more...);
}
/// Pushes a table with such fields.
template <class... Fields>
int give_table(const Call& call, const Fields&... fields) {
    lua_createtable(call.state(), 0, static_cast<int>(sizeof...(fields) / 2));
    set_field(call, fields...);
    return 1;
}

template <class T, auto kGet>
int give_field(Call& call) {
    return give_value(call, std::invoke(kGet, object_itself<T>(call)));
}
/// A field that scripts read of a T: kGet(object), or the member that kGet points to.
template <class T, auto kGet>
constexpr lua_CFunction field = guarded<give_field<T, kGet>>;

/// From now on reading a field that the table on top of the stack has not is an error that lists those it has; `name`
/// is that of the data.
void refuse_unknown_fields(lua_State* L, const std::string& name);
/// Gives the data table below the table on top of the stack, which is taken off, that one's fields: they are read like
/// its own and not listed.
void add_hidden_fields(lua_State* L);
/// The name of the data in the table at `index`, when refuse_unknown_fields() was called for it.
std::optional<std::string> name_of_refusing_table(lua_State* L, int index);

}  // namespace dynlab::inline scripting
