#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace dynlab::inline numerics {

/// Makes the pieces `first`, `first` + 1, ... of a long computation, `count` of them, on this machine's cores.
template <class Piece>
using SomePieces = std::function<std::vector<Piece>(std::size_t first, std::size_t count)>;

/// Gives all pieces of a long computation in their order, having had parts of them made by the function that it is
/// given, on whatever machines. A piece depends on its number alone, so that any parts make the same whole.
template <class Piece>
using Elsewhere = std::function<std::vector<Piece>(std::size_t pieces, const SomePieces<Piece>& some)>;

}  // namespace dynlab::inline numerics
