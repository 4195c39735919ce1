#pragma once
#include "data_io/values/described_writing.h"

namespace dynlab::inline data_io {

/// How described.h's functions for reading are made of the pieces of value_stream.h.
class MemberReader {
  public:
    explicit MemberReader(ValueReader& reader) : reader_(reader) {}
    template <class M>
    void operator()(const char* name, M& member) {
        if (reader_.member(name))
            read_value(reader_, member);
        else if constexpr (value_kinds::Maybe<M>)
            member.reset();
        else
            reader_.lacks(name);
    }
    template <class M>
    void kept(const char* name, M& member) {
        if (reader_.keeps_all()) (*this)(name, member);
    }
    template <class M>
    void unless_empty(const char* name, M& member) {
        if (reader_.member(name)) read_value(reader_, member);
    }
    template <class M>
    void null_if_empty(const char* name, M& member) {
        member = M{};
        if (!reader_.member(name)) reader_.lacks(name);
        if (reader_.next() == ValueReader::Kind::kNothing) return reader_.nothing();
        read_value(reader_, member);
    }

  private:
    ValueReader& reader_;
};

/// An error of `make` as a ValueError that begins with the location.
template <class Make>
auto with_location(const ValueReader& reader, const Make& make) {
    try {
        return make();
    } catch (const ValueError&) {
        throw;
    } catch (const std::exception& error) {
        reader.refuse(message_of(error));
    }
}

template <class T>
void read_members(ValueReader& reader, T& value) {
    MemberReader member(reader);
    describe(value, member);
    reader.end_members();
    if constexpr (requires { check_value(value, reader.limits()); })
        if (reader.limits().checked) with_location(reader, [&] { check_value(value, reader.limits()); });
}

template <class T>
T read_fresh(ValueReader& reader) {
    T value = blank<T>();
    read_value(reader, value);
    return value;
}

template <class T>
void read_maybe(ValueReader& reader, T& value) {
    using Content = std::remove_cvref_t<decltype(*value)>;
    value.reset();
    if (reader.next() == ValueReader::Kind::kNothing) return reader.nothing();
    if constexpr (std::same_as<T, std::optional<Content>>)
        value = read_fresh<Content>(reader);
    else
        value = std::make_shared<Content>(read_fresh<Content>(reader));
}

template <class T>
void read_list(ValueReader& reader, T& value) {
    const std::size_t count = reader.begin_list(sizeof(typename T::value_type));
    value.clear();
    value.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        reader.element();
        value.push_back(read_fresh<typename T::value_type>(reader));
    }
    reader.end_list();
}

template <class T>
void read_map(ValueReader& reader, T& value) {
    value.clear();
    for (std::size_t left = reader.begin_map(sizeof(typename T::mapped_type)); left > 0; --left) {
        const std::string key = reader.key();
        value.insert_or_assign(key, read_fresh<typename T::mapped_type>(reader));
    }
    reader.end_map();
}

template <class T>
void read_pair(ValueReader& reader, T& value) {
    if (reader.begin_list(0) != 2) reader.refuse(Message("expected two values"));
    reader.element();
    read_value(reader, value.first);
    reader.element();
    read_value(reader, value.second);
    reader.end_list();
}

template <class T>
void read_value(ValueReader& reader, T& value) {
    if constexpr (value_kinds::Custom<T>) {
        read_whole_value(reader, value);
    } else if constexpr (value_kinds::StoredAsOther<T>) {
        auto form = read_fresh<typename StoredAs<T>::Form>(reader);
        value = with_location(reader, [&] { return StoredAs<T>::value(std::move(form)); });
    } else if constexpr (std::same_as<T, bool>) {
        value = reader.truth();
    } else if constexpr (std::integral<T>) {
        using Limits = std::numeric_limits<T>;
        constexpr auto kMaxInteger = std::numeric_limits<std::int64_t>::max();
        const auto high = std::cmp_greater(Limits::max(), kMaxInteger) ? kMaxInteger : std::int64_t(Limits::max());
        value = static_cast<T>(reader.whole(std::int64_t(Limits::min()), high));
    } else if constexpr (std::floating_point<T>) {
        value = reader.number();
    } else if constexpr (value_kinds::NamedEnum<T>) {
        value = static_cast<T>(reader.one_of(names_of(T{})));
    } else if constexpr (std::same_as<T, std::string>) {
        value = reader.text();
    } else if constexpr (value_kinds::Maybe<T>) {
        read_maybe(reader, value);
    } else if constexpr (value_kinds::Pair<T>) {
        read_pair(reader, value);
    } else if constexpr (value_kinds::Map<T>) {
        read_map(reader, value);
    } else if constexpr (value_kinds::List<T>) {
        read_list(reader, value);
    } else {
        reader.begin_object();
        read_members(reader, value);
        reader.end_object();
    }
}

}  // namespace dynlab::inline data_io
