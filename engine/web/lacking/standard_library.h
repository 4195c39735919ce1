#pragma once
/// What engine/ uses of the C++20 library and Emscripten 3.1.6 (libc++ 13) lacks: constrained algorithms, numbers as
/// text, std::bit_cast. Each does what the standard says for the arguments that engine/ gives; read before every
/// source.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <system_error>
#include <utility>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

inline to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision) {
    char text[420];
    const int size = std::snprintf(text, sizeof text,
                                   format == chars_format::scientific ? "%.*e"
                                   : format == chars_format::fixed    ? "%.*f"
                                                                      : "%.*g",
                                   precision, value);
    if (size > last - first) {
        return {last, errc::value_too_large};
    }
    std::memcpy(first, text, static_cast<size_t>(size));
    return {first + size, errc{}};
}

/// Converts the leading decimal number of first..last: no blanks, no plus sign, no hexadecimal digits.
inline from_chars_result from_chars(const char* first, const char* last, double& value,
                                    chars_format = chars_format::general) {
    const char* at = first;
    const auto digits = [&] {
        const char* begin = at;
        while (at != last && *at >= '0' && *at <= '9') ++at;
        return at - begin;
    };
    const auto word = [&](const char* text) {
        const size_t n = std::strlen(text);
        if (static_cast<size_t>(last - at) < n) return false;
        for (size_t i = 0; i < n; ++i)
            if ((at[i] | 32) != text[i]) return false;
        at += n;
        return true;
    };
    if (at != last && *at == '-') ++at;
    if (!(word("infinity") || word("inf") || word("nan"))) {
        auto count = digits();
        if (at != last && *at == '.') {
            ++at;
            count += digits();
        }
        if (count == 0) return {first, errc::invalid_argument};
        if (at != last && (*at | 32) == 'e') {
            const char* before = at++;
            if (at != last && (*at == '-' || *at == '+')) ++at;
            if (digits() == 0) at = before;
        }
    }
    const std::string text(first, at);
    const double number = std::strtod(text.c_str(), nullptr);
    if ((number == HUGE_VAL || number == -HUGE_VAL) && text.find_first_of("nN") == std::string::npos)
        return {at, errc::result_out_of_range};
    value = number;
    return {at, errc{}};
}

namespace ranges {
struct find_fn {
    template <class R, class T, class P = identity>
    constexpr auto operator()(R&& r, const T& value, P p = {}) const {
        return std::find_if(std::begin(r), std::end(r), [&](auto&& x) -> bool { return std::invoke(p, x) == value; });
    }
};
inline constexpr find_fn find;
#define DYNLAB_WITH_PREDICATE(name)                                                                \
    struct name##_fn {                                                                             \
        template <class R, class F, class P = identity>                                            \
        constexpr auto operator()(R&& r, F f, P p = {}) const {                                    \
            return std::name(std::begin(r), std::end(r),                                           \
                             [&](auto&& x) -> bool { return std::invoke(f, std::invoke(p, x)); }); \
        }                                                                                          \
    };                                                                                             \
    inline constexpr name##_fn name;
DYNLAB_WITH_PREDICATE(find_if)
DYNLAB_WITH_PREDICATE(any_of)
DYNLAB_WITH_PREDICATE(all_of)
DYNLAB_WITH_PREDICATE(none_of)
DYNLAB_WITH_PREDICATE(count_if)
#undef DYNLAB_WITH_PREDICATE
#define DYNLAB_WITH_ORDER(name)                                                            \
    struct name##_fn {                                                                     \
        template <class R, class F = std::less<>, class P = identity>                      \
        constexpr auto operator()(R&& r, F f = {}, P p = {}) const {                       \
            return std::name(std::begin(r), std::end(r), [&](auto&& a, auto&& b) -> bool { \
                return std::invoke(f, std::invoke(p, a), std::invoke(p, b));               \
            });                                                                            \
        }                                                                                  \
    };                                                                                     \
    inline constexpr name##_fn name;
DYNLAB_WITH_ORDER(sort)
DYNLAB_WITH_ORDER(stable_sort)
DYNLAB_WITH_ORDER(min_element)
DYNLAB_WITH_ORDER(max_element)
DYNLAB_WITH_ORDER(is_sorted)
#undef DYNLAB_WITH_ORDER
struct count_fn {
    template <class R, class T, class P = identity>
    constexpr auto operator()(R&& r, const T& value, P p = {}) const {
        return std::count_if(std::begin(r), std::end(r), [&](auto&& x) -> bool { return std::invoke(p, x) == value; });
    }
};
inline constexpr count_fn count;
struct lower_bound_fn {
    template <class R, class T, class F = std::less<>, class P = identity>
    constexpr auto operator()(R&& r, const T& value, F f = {}, P p = {}) const {
        return std::lower_bound(std::begin(r), std::end(r), value,
                                [&](auto&& a, const T& b) -> bool { return std::invoke(f, std::invoke(p, a), b); });
    }
};
inline constexpr lower_bound_fn lower_bound;
struct upper_bound_fn {
    template <class R, class T, class F = std::less<>, class P = identity>
    constexpr auto operator()(R&& r, const T& value, F f = {}, P p = {}) const {
        return std::upper_bound(std::begin(r), std::end(r), value,
                                [&](const T& a, auto&& b) -> bool { return std::invoke(f, a, std::invoke(p, b)); });
    }
};
inline constexpr upper_bound_fn upper_bound;
struct binary_search_fn {
    template <class R, class T, class F = std::less<>, class P = identity>
    constexpr bool operator()(R&& r, const T& value, F f = {}, P p = {}) const {
        const auto at = lower_bound(r, value, f, p);
        return at != std::end(r) && !std::invoke(f, value, std::invoke(p, *at));
    }
};
inline constexpr binary_search_fn binary_search;
struct replace_fn {
    template <class R, class T>
    constexpr auto operator()(R&& r, const T& from, const T& to) const {
        std::replace(std::begin(r), std::end(r), from, to);
        return std::end(r);
    }
};
inline constexpr replace_fn replace;
}  // namespace ranges
}  // namespace std
