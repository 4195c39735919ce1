#pragma once
#include <concepts>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "scripting/memoized_calls/figure_members.h"
#include "scripting/memoized_calls/model_members.h"
#include "scripting/memoized_calls/study_members.h"

namespace dynlab::inline scripting {

/// Values as bytes of this machine: every number bit by bit, NaN and infinity too, so that equal bytes are equal values
/// and a value that was read back is the one that was written. Classes are written member by member (class_members.h).
class ArchiveWriter {
  public:
    template <class T>
    void put(const T& value);
    const std::string& bytes() const { return bytes_; }

  private:
    void put_raw(const void* first, std::size_t size) { bytes_.append(static_cast<const char*>(first), size); }
    std::string bytes_;
};

/// Reads what an ArchiveWriter of the same program wrote; throws std::out_of_range where the bytes end too early.
class ArchiveReader {
  public:
    explicit ArchiveReader(std::string_view bytes) : rest_(bytes) {}
    template <class T>
    T get() {
        T value = blank<T>();
        read(value);
        return value;
    }
    bool at_end() const { return rest_.empty(); }

  private:
    template <class T>
    void read(T& value);
    std::string_view take(std::size_t size) {
        if (size > rest_.size()) throw std::out_of_range("an archive ends too early");
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }
    /// A number of elements that the rest can hold: each takes a byte at least.
    std::size_t count() {
        const auto wanted = get<std::uint64_t>();
        if (wanted > rest_.size()) throw std::out_of_range("an archive ends too early");
        return static_cast<std::size_t>(wanted);
    }
    std::string_view rest_;
};

namespace archived {

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::same_as<T, Complex>;
template <class T>
concept Text = std::same_as<T, std::string>;
template <class T>
concept Dense = std::derived_from<T, Eigen::PlainObjectBase<T>>;
template <class T>
concept Maybe = requires(const T& value) {
    *value;
    static_cast<bool>(value);
};
template <class T>
concept List = !Text<T> && !Dense<T> && requires(T & value) {
    value.emplace_back();
};

}  // namespace archived

template <class T>
void ArchiveWriter::put(const T& value) {
    if constexpr (archived::Plain<T>) {
        put_raw(&value, sizeof value);
    } else if constexpr (archived::Text<T>) {
        put(std::uint64_t{value.size()});
        put_raw(value.data(), value.size());
    } else if constexpr (archived::Dense<T>) {
        put(value.rows());
        put(value.cols());
        put_raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
    } else if constexpr (archived::Maybe<T>) {
        put(static_cast<bool>(value));
        if (value) put(*value);
    } else if constexpr (archived::List<T>) {
        put(std::uint64_t{value.size()});
        for (const auto& element : value) put(element);
    } else {
        std::apply([this](const auto&... member) { (put(member), ...); }, members(value));
    }
}

template <class T>
void ArchiveReader::read(T& value) {
    if constexpr (archived::Plain<T>) {
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
    } else if constexpr (archived::Text<T>) {
        value = take(count());
    } else if constexpr (archived::Dense<T>) {
        const auto rows = get<Index>(), columns = get<Index>();
        const std::string_view numbers = take(static_cast<std::size_t>(rows * columns) * sizeof(typename T::Scalar));
        value.resize(rows, columns);
        if (!numbers.empty()) std::memcpy(value.data(), numbers.data(), numbers.size());
    } else if constexpr (archived::Maybe<T>) {
        using Content = std::remove_const_t<std::remove_reference_t<decltype(*value)>>;
        if (!get<bool>()) return;
        if constexpr (std::same_as<T, std::optional<Content>>)
            value = get<Content>();
        else
            value = std::make_shared<Content>(get<Content>());
    } else if constexpr (archived::List<T>) {
        value.clear();
        for (std::size_t left = count(); left > 0; --left) value.push_back(get<typename T::value_type>());
    } else if constexpr (std::same_as<T, TransferFunction>) {
        const auto num = get<Vector>(), den = get<Vector>();
        const auto Ts = get<double>();
        value = TransferFunction(num, den, Ts, get<double>());
    } else {
        std::apply([this](auto&... member) { (read(member), ...); }, members(value));
    }
}

}  // namespace dynlab::inline scripting
