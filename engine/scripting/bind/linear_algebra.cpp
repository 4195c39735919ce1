
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/signals/fourier.h"
#include "scripting/bind/bindings.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

constexpr double kSingular = 1e-15;  // reciprocal condition number

MatrixMap square_matrix(Call& call) {
    call.at_most(1);
    const MatrixMap A = call.matrix(1, "A");
    if (A.rows() != A.cols())
        throw InvalidArgument("{} must be a square matrix, but it is {} x {}", argument_label(1, "A"), A.rows(),
                              A.cols());
    if (!A.allFinite())
        throw InvalidArgument("{} must have only finite elements, but it contains NaN or an infinite value",
                              argument_label(1, "A"));
    return A;
}

int solve(Call& call) {
    call.at_most(2);
    const MatrixMap A = call.matrix(1, "A"), b = call.matrix(2, "b");
    const bool vector = to_matrix(call.state(), 2) == nullptr;
    Matrix solution(A.cols(), b.cols());
    for (Index j = 0; j < b.cols(); ++j) solution.col(j) = solve_least_squares(A, b.col(j)).solution;
    return vector ? call.give_vector(solution.col(0)) : call.give_matrix(solution);
}

int inverse(Call& call) {
    const MatrixMap A = square_matrix(call);
    const SquareSolution solution = solve_by_lu(A, Matrix::Identity(A.rows(), A.rows()));
    if (A.rows() > 0 && !(solution.reciprocal_condition > kSingular))
        throw InvalidArgument("the matrix is singular to working precision (condition number {}), so it has no inverse",
                              significant(1 / solution.reciprocal_condition, 2));
    return call.give_matrix(solution.x);
}

int determinant(Call& call) {
    const MatrixMap A = square_matrix(call);
    return call.give(A.rows() == 0 ? 1 : eigenvalues(A).prod().real());
}

int give_eigenvalues(Call& call) {
    const MatrixMap A = square_matrix(call);
    if (A.rows() == 0)
        throw InvalidArgument("{} must have at least one element, but it is empty", argument_label(1, "A"));
    if (A == A.transpose()) return call.give_vector(symmetric_eigenvalues(A));
    push_object(call.state(), eigenvalues(A));
    return 1;
}

int fft(Call& call) {
    call.at_most(1);
    push_object(call.state(), fourier_transform(call.vector(1, "x")));
    return 1;
}

constexpr FunctionEntry kAlgebraFunctions[] = {
    {"solve", "vectors", "solve(A, b) -> x",
     "Solve the linear equations A x = b, or the least-squares problem if A has more rows than columns",
     guarded<solve>},
    {"inv", "vectors", "inv(A) -> B", "Inverse of a square matrix", guarded<inverse>},
    {"det", "vectors", "det(A) -> x", "Determinant of a square matrix", guarded<determinant>},
    {"eig", "vectors", "eig(A) -> v", "Eigenvalues of a square matrix", guarded<give_eigenvalues>},
    {"fft", "vectors", "fft(x) -> X", "Discrete Fourier transform", guarded<fft>},
};

}  // namespace

FunctionEntries linear_algebra() {
    return kAlgebraFunctions;
}

}  // namespace dynlab::inline scripting
