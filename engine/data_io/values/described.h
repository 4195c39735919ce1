#pragma once
#include <array>
#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>
#include <concepts>
#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "data_io/values/value_stream.h"

namespace dynlab::inline data_io {

/// Describes a class that is stored or sent. The description is made once, in the class's namespace or a later layer's,
/// and lists the members in their order. Members are stored under their names:
///
///     DYNLAB_DESCRIBE(Level, value, from, to)
///
/// expands to
///
///     template <Is<Level> T, class V>
///     void describe(T& object, V& member) {
///         auto& [value, from, to] = object;
///         member("value", value), member("from", from), member("to", to);
///     }
///
/// Write out this function if a stored name differs from the member's name, or for one of the variants below. A
/// structured binding must name all members, so that a member that is added only to the class does not compile.
/// `member.kept(...)` is for programs only (CBOR): JSON, which people read, leaves it out. `member.unless_empty(...)`
/// is left out if it is empty, or for an optional member without a value. `member.null_if_empty(...)` writes null then,
/// for texts and numbers (0) of files in which every member is always present. After reading, `check_value(object,
/// limits)`, if it exists, throws std::exception for inconsistent members.
template <class T, class Class>
concept Is = std::same_as<std::remove_const_t<T>, Class>;

#define DYNLAB_STORE_MEMBER(_, stream, name) stream(BOOST_PP_STRINGIZE(name), name);
#define DYNLAB_DESCRIBE(Class, ...)                                                               \
    template <Is<Class> T, class V>                                                               \
    void describe(T& object, V& member) {                                                         \
        auto& [__VA_ARGS__] = object;                                                             \
        BOOST_PP_SEQ_FOR_EACH(DYNLAB_STORE_MEMBER, member, BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__)) \
    }

/// A class that is stored as another: Form is the other, form() makes it, value() makes the class of it again.
template <class T>
struct StoredAs;

template <>
struct StoredAs<std::filesystem::path> {
    using Form = std::string;
    static std::string form(const std::filesystem::path& path) { return path.string(); }
    static std::filesystem::path value(std::string&& text) { return std::move(text); }
};

/// A value to be filled; classes that cannot be empty specialize it.
template <class T>
T blank() {
    return T{};
}

namespace value_kinds {

/// An enumeration with values 0, 1, ... has `names_of(E)`, an array of their names.
template <class T>
concept NamedEnum = std::is_enum_v<T> && requires {
    names_of(T{});
};

template <class T>
concept StoredAsOther = requires {
    typename StoredAs<T>::Form;
};
template <class T>
concept Maybe = !std::is_arithmetic_v<T> && requires(const T& value) {
    *value;
    static_cast<bool>(value);
};
template <class T>
concept Pair = requires {
    typename T::first_type;
    typename T::second_type;
};
template <class T>
concept Map = requires {
    typename T::mapped_type;
};
template <class T>
concept List = !std::same_as<T, std::string> && !Map<T> && requires(T & value) {
    value.emplace_back();
};
/// Written and read by specific functions, write_whole_value and read_whole_value; those of vectors and matrices are in
/// array_descriptions.h.
template <class T>
concept Custom = requires(ValueWriter& writer, const T& value) {
    write_whole_value(writer, value);
};

}  // namespace value_kinds

template <class T>
void write_value(ValueWriter& writer, const T& value);
template <class T>
void read_value(ValueReader& reader, T& value);
/// The members alone, within an object that the caller begins and ends.
template <class T>
void write_members(ValueWriter& writer, const T& value);
template <class T>
void read_members(ValueReader& reader, T& value);

}  // namespace dynlab::inline data_io

#include "data_io/values/described_reading.h"
#include "data_io/values/described_writing.h"
