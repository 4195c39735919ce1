#pragma once
#include "data_io/values/described.h"

namespace dynlab::inline data_io {

/// How described.h's functions for writing are made of the pieces of value_stream.h.
class MemberWriter {
  public:
    explicit MemberWriter(ValueWriter& writer) : writer_(writer) {}
    template <class M>
    void operator()(const char* name, const M& member) {
        if constexpr (value_kinds::Maybe<M>) {
            if (!member) return;
        }
        writer_.member(name);
        write_value(writer_, member);
    }
    template <class M>
    void kept(const char* name, const M& member) {
        if (writer_.keeps_all()) (*this)(name, member);
    }
    template <class M>
    void unless_empty(const char* name, const M& member) {
        if (!member.empty()) (*this)(name, member);
    }
    template <class M>
    void null_if_empty(const char* name, const M& member) {
        writer_.member(name);
        if (member == M{})
            writer_.nothing();
        else
            write_value(writer_, member);
    }

  private:
    ValueWriter& writer_;
};

template <class T>
void write_members(ValueWriter& writer, const T& value) {
    MemberWriter member(writer);
    describe(value, member);
}

template <class T>
void write_value(ValueWriter& writer, const T& value) {
    if constexpr (value_kinds::Custom<T>) {
        write_whole_value(writer, value);
    } else if constexpr (value_kinds::StoredAsOther<T>) {
        write_value(writer, StoredAs<T>::form(value));
    } else if constexpr (std::same_as<T, bool>) {
        writer.truth(value);
    } else if constexpr (std::integral<T>) {
        writer.whole(static_cast<std::int64_t>(value));
    } else if constexpr (std::floating_point<T>) {
        writer.number(value);
    } else if constexpr (value_kinds::NamedEnum<T>) {
        writer.text(names_of(T{}).at(static_cast<std::size_t>(value)));
    } else if constexpr (std::same_as<T, std::string>) {
        writer.text(value);
    } else if constexpr (value_kinds::Maybe<T>) {
        if (value)
            write_value(writer, *value);
        else
            writer.nothing();
    } else if constexpr (value_kinds::Pair<T>) {
        writer.begin_list(2);
        write_value(writer, value.first);
        write_value(writer, value.second);
        writer.end_list();
    } else if constexpr (value_kinds::Map<T>) {
        writer.begin_map(value.size());
        for (const auto& [key, entry] : value) {
            writer.key(key);
            write_value(writer, entry);
        }
        writer.end_map();
    } else if constexpr (value_kinds::List<T>) {
        writer.begin_list(value.size());
        for (const auto& element : value) write_value(writer, static_cast<const typename T::value_type&>(element));
        writer.end_list();
    } else {
        writer.begin_object();
        write_members(writer, value);
        writer.end_object();
    }
}

}  // namespace dynlab::inline data_io
