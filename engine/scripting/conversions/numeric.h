#pragma once
#include <cstdint>
#include <lua.hpp>
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/linalg/types.h"
#include "scripting/conversions/object_type.h"

namespace dynlab::inline scripting {

using VectorMap = Eigen::Map<const Vector>;
using MatrixMap = Eigen::Map<const Matrix>;

/// Numbers that lie inside the userdata itself, so that the collector and the memory limit see them. A vector has one
/// column and the metatable of vectors; column-major doubles follow this header at the next multiple of kAlignment:
/// sums are vectorised from the first aligned number on, and would otherwise round differently from place to place.
struct NumericBlock {
    static constexpr std::size_t kAlignment = 64;  ///< bytes, of the widest registers
    Index rows, columns;
    double* data() {
        const auto behind = reinterpret_cast<std::uintptr_t>(this + 1);
        return reinterpret_cast<double*>((behind + kAlignment - 1) / kAlignment * kAlignment);
    }
    Eigen::Map<Matrix> matrix() { return {data(), rows, columns}; }
    Eigen::Map<Vector> vector() { return {data(), rows * columns}; }
};

/// One truth value per element of the vector it was made from.
struct MaskBlock {
    Index size;
    bool* data() { return reinterpret_cast<bool*>(this + 1); }
};

/// A whole number as an index. An Index has 32 bits in a browser: numbers beyond half of its range, where no vector has
/// elements, become that half, so that sums of two are indices, too.
Index index_of_whole(double whole);

/// New objects on top of the stack, not filled. They throw InvalidArgument when the memory limit cannot hold them.
NumericBlock& push_vector(lua_State* L, Index size);
NumericBlock& push_matrix(lua_State* L, Index rows, Index columns);
MaskBlock& push_mask(lua_State* L, Index size);

/// Before a signal of `count` values is calculated outside: throws InvalidArgument when the memory limit cannot hold
/// it, with the two others that are there meanwhile.
void require_memory_for_signal(lua_State* L, double count);

/// The block at a stack index, nullptr when something else is there.
NumericBlock* to_vector(lua_State* L, int index);
NumericBlock* to_matrix(lua_State* L, int index);
MaskBlock* to_mask(lua_State* L, int index);

/// Which numbers of elements, rows or the like there are: "there are 1 to 3", "there is 1 only".
Message numbered_from_one(Index count);
/// "a vector of 5 values", "a 2 x 3 matrix"
Message vector_shape(Index size);
Message matrix_shape(Index rows, Index columns);

/// Pushes a vector whose values can be read by these names, too: v.k1.
void push_named_vector(lua_State* L, const Vector& values, const std::vector<std::string>& names);

inline constexpr ObjectType kVectorType{"vector"}, kMatrixType{"matrix"}, kMaskType{"mask"};

/// Replaces a table of numbers at stack index `index` by a vector; entries may also be vectors, which are joined.
/// `label` names the table in messages.
void make_vector_of_table(lua_State* L, int index, const Message& label);

/// Replaces a table at `index` by a matrix: plain tables of numbers are its rows, vectors its columns.
void make_matrix_of_table(lua_State* L, int index, const Message& label);

}  // namespace dynlab::inline scripting
