#include <array>

#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/numeric_operators.h"
#include "scripting/conversions/userdata.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

NumericBlock& matrix_self(Call& call) {
    NumericBlock* A = to_matrix(call.state(), 1);
    if (A == nullptr)
        wrong_argument(call.state(), 1, "A", Message("a matrix; methods are called with a colon, A:name(...)"));
    return *A;
}

Index index_argument(Call& call, int index, const char* what, Index size) {
    const Index value = call.integer(index, what);
    if (value < 1 || value > size)
        throw InvalidArgument("{} {} does not exist: {}", what, value, numbered_from_one(size));
    return value - 1;
}

int matrix_at(Call& call) {
    call.at_most(3);
    NumericBlock& A = matrix_self(call);
    const Index i = index_argument(call, 2, "row", A.rows), j = index_argument(call, 3, "column", A.columns);
    return call.give(A.matrix()(i, j));
}

int matrix_set(Call& call) {
    call.at_most(4);
    NumericBlock& A = matrix_self(call);
    const Index i = index_argument(call, 2, "row", A.rows), j = index_argument(call, 3, "column", A.columns);
    A.matrix()(i, j) = call.number(4, "value");
    return 0;
}

int matrix_row(Call& call) {
    call.at_most(2);
    NumericBlock& A = matrix_self(call);
    const Index i = index_argument(call, 2, "row", A.rows);
    return call.give_vector(A.matrix().row(i).transpose());
}

int matrix_column(Call& call) {
    call.at_most(2);
    NumericBlock& A = matrix_self(call);
    const Index j = index_argument(call, 2, "column", A.columns);
    return call.give_vector(A.matrix().col(j));
}

int matrix_transpose(Call& call) {
    return call.give_matrix(matrix_self(call).matrix().transpose());
}
int matrix_rows(Call& call) {
    return call.give_integer(matrix_self(call).rows);
}
int matrix_columns(Call& call) {
    return call.give_integer(matrix_self(call).columns);
}
int matrix_tostring(Call& call) {
    return call.give(matrix_text(matrix_self(call).matrix(), reader_of(call)));
}
int matrix_equal(Call& call) {
    NumericBlock *a = to_matrix(call.state(), 1), *b = to_matrix(call.state(), 2);
    return call.give(a != nullptr && b != nullptr && a->rows == b->rows && a->columns == b->columns &&
                     a->matrix() == b->matrix());
}

/// A[{i, j}]
int read_matrix_element(Call& call) {
    lua_State* L = call.state();
    if (call.type(2) != LUA_TTABLE || lua_rawlen(L, 2) != 2)
        throw InvalidArgument(
            "write an element of a matrix as A[{i, j}], a row as A:row(i), and a column as A:col(j), not as A[{}]",
            given_value(L, 2));
    lua_rawgeti(L, 2, 1);
    lua_rawgeti(L, 2, 2);
    lua_remove(L, 2);
    Call inner(L);
    return matrix_at(inner);
}

int write_matrix_element(Call& call) {
    lua_State* L = call.state();
    if (call.type(2) != LUA_TTABLE || lua_rawlen(L, 2) != 2)
        throw InvalidArgument("set an element of a matrix with A[{i, j}] = x or A:set(i, j, x)");
    lua_rawgeti(L, 2, 1);
    lua_rawgeti(L, 2, 2);
    lua_rotate(L, 3, 2);  // A, {i, j}, i, j, value
    lua_remove(L, 2);
    Call inner(L);
    return matrix_set(inner);
}

int refuse_length(Call&) {
    throw InvalidArgument("the operator # counts the elements of a vector; for a matrix, use A.rows and A.columns");
}

constexpr std::array kMatrixTypeFields = {Member{"rows", guarded<matrix_rows>},
                                          Member{"columns", guarded<matrix_columns>}};
constexpr std::array kMatrixTypeMethods = {
    Member{"at", guarded<matrix_at>},       Member{"set", guarded<matrix_set>},
    Member{"row", guarded<matrix_row>},     Member{"col", guarded<matrix_column>},
    Member{"t", guarded<matrix_transpose>}, Member{"times", guarded<numeric_times>}};
constexpr std::array kMatrixTypeOperators = {
    Member{"__add", guarded<numeric_add>},
    Member{"__sub", guarded<numeric_subtract>},
    Member{"__mul", guarded<numeric_multiply>},
    Member{"__div", guarded<numeric_divide>},
    Member{"__pow", guarded<numeric_power>},
    Member{"__unm", guarded<numeric_negate>},
    Member{"__tostring", guarded<matrix_tostring>},
    Member{"__eq", guarded<matrix_equal>},
    Member{"__lt", guarded<refuse_comparison>},
    Member{"__le", guarded<refuse_comparison>},
    Member{"__newindex", guarded<write_matrix_element>},
    Member{"__len", guarded<refuse_length>},
};

constexpr std::array kMatrixTypes = {
    TypeEntry{&kMatrixType, kMatrixTypeFields, kMatrixTypeMethods, kMatrixTypeOperators, guarded<read_matrix_element>}};

}  // namespace

TypeEntries matrix_types() {
    return kMatrixTypes;
}

}  // namespace dynlab::inline scripting
