#pragma once
#include <concepts>
#include <tuple>
#include <type_traits>
#include <utility>

namespace dynlab::inline scripting {

/// members(object) ties the members of a class that an archive holds, to be read or written, for each class in a line
/// of its own. A structured binding must name them all, so that a member added to a class and not to its line does not
/// compile.
template <class T, class Class>
concept Is = std::same_as<std::remove_const_t<T>, Class>;

template <class A, class B>
auto members(std::pair<A, B>& x) {
    return std::tie(x.first, x.second);
}
template <class A, class B>
auto members(const std::pair<A, B>& x) {
    return std::tie(x.first, x.second);
}

}  // namespace dynlab::inline scripting
