#include "scripting/conversions/numeric_operators.h"

#include <cmath>

#include "scripting/conversions/numeric.h"

namespace dynlab::inline scripting {
namespace {

/// One side of an operator: a number, or the values of a vector or matrix.
struct Operand {
    NumericBlock* block = nullptr;
    double number = 0;
    bool is_vector = false;
};

Message shape_of(const Operand& operand) {
    if (operand.block == nullptr) return Message("a number");
    return operand.is_vector ? vector_shape(operand.block->rows)
                             : matrix_shape(operand.block->rows, operand.block->columns);
}

Operand operand(const Call& call, int index, const char* sign) {
    lua_State* L = call.state();
    if (call.type(index) == LUA_TNUMBER) return {nullptr, lua_tonumber(L, index), false};
    if (call.type(index) == LUA_TTABLE) make_vector_of_table(L, index, Message("x {} y: the table", sign));
    if (NumericBlock* vector = to_vector(L, index)) return {vector, 0, true};
    if (NumericBlock* matrix = to_matrix(L, index)) return {matrix, 0, false};
    throw InvalidArgument("x {} y is not defined for {}", sign, given_value(L, index));
}

/// Room for a result shaped like `model`, on top of the stack.
NumericBlock& push_like(const Call& call, const Operand& model) {
    return model.is_vector ? push_vector(call.state(), model.block->rows)
                           : push_matrix(call.state(), model.block->rows, model.block->columns);
}

void check_equal_shape(const Operand& a, const Operand& b, const char* sign) {
    if (a.is_vector == b.is_vector && a.block->rows == b.block->rows && a.block->columns == b.block->columns) return;
    throw InvalidArgument("x {} y needs equal sizes, but x is {} and y is {}", sign, shape_of(a), shape_of(b));
}

/// Applies `function` element by element, numbers being used for every element.
template <class Function>
int elementwise(const Call& call, const char* sign, Function function) {
    const Operand a = operand(call, 1, sign), b = operand(call, 2, sign);
    if (a.block != nullptr && b.block != nullptr) check_equal_shape(a, b, sign);
    NumericBlock& result = push_like(call, a.block != nullptr ? a : b);
    auto values = result.vector().array();
    if (a.block == nullptr) {
        values = b.block->vector().array().unaryExpr([&](double y) { return function(a.number, y); });
    } else if (b.block == nullptr) {
        values = a.block->vector().array().unaryExpr([&](double x) { return function(x, b.number); });
    } else {
        values = a.block->vector().array().binaryExpr(b.block->vector().array(), function);
    }
    return 1;
}

int matrix_product(const Call& call, const Operand& a, const Operand& b) {
    if (a.is_vector)
        throw InvalidArgument("x * y is the matrix product, but x is {} and y is {}; write A*v, or A:t()*v",
                              shape_of(a), shape_of(b));
    if (a.block->columns != b.block->rows)
        throw InvalidArgument("A * B needs as many columns in A as rows in B, but A is {} and B is {}", shape_of(a),
                              shape_of(b));
    NumericBlock& result = b.is_vector ? push_vector(call.state(), a.block->rows)
                                       : push_matrix(call.state(), a.block->rows, b.block->columns);
    result.matrix().noalias() = a.block->matrix() * b.block->matrix();
    return 1;
}

}  // namespace

int numeric_add(Call& call) {
    return elementwise(call, "+", [](double x, double y) { return x + y; });
}
int numeric_subtract(Call& call) {
    return elementwise(call, "-", [](double x, double y) { return x - y; });
}

int numeric_multiply(Call& call) {
    const Operand a = operand(call, 1, "*"), b = operand(call, 2, "*");
    const bool product = a.block != nullptr && b.block != nullptr && !(a.is_vector && b.is_vector);
    if (product) return matrix_product(call, a, b);
    return elementwise(call, "*", [](double x, double y) { return x * y; });
}

int numeric_divide(Call& call) {
    const Operand b = operand(call, 2, "/");
    if (b.block != nullptr && !b.is_vector)
        throw InvalidArgument(call.type(1) == LUA_TNUMBER
                                  ? Message("x / A is not defined for a matrix A; write inv(A) for the inverse of A")
                                  : Message("x / A is not defined for a matrix A; write solve(A, b) for A\\b"));
    return elementwise(call, "/", [](double x, double y) { return x / y; });
}

int numeric_power(Call& call) {
    const Operand a = operand(call, 1, "^"), b = operand(call, 2, "^");
    if ((a.block != nullptr && !a.is_vector) || (b.block != nullptr && !b.is_vector))
        throw InvalidArgument(
            "A ^ x is not defined for a matrix A; write A*A for the matrix product, or A:times(A) for the element-wise "
            "product");
    if (b.block == nullptr && b.number == 2) return elementwise(call, "^", [](double x, double) { return x * x; });
    return elementwise(call, "^", [](double x, double y) { return std::pow(x, y); });
}

int numeric_negate(Call& call) {
    const Operand a = operand(call, 1, "-");
    push_like(call, a).vector() = -a.block->vector();
    return 1;
}

int numeric_times(Call& call) {
    call.at_most(2);
    return elementwise(call, "times", [](double x, double y) { return x * y; });
}

int refuse_comparison(Call&) {
    throw InvalidArgument(
        "for an element-wise comparison of vectors, use gt(x, y), lt, ge, le or eq, which return a mask. x < y would "
        "return a single true or false");
}

}  // namespace dynlab::inline scripting
