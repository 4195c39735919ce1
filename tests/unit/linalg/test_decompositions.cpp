#include "numerics/linalg/decompositions.h"

#include <gtest/gtest.h>

namespace test_decompositions {

using namespace dynlab;

// oracle: tr A, |A|^2 and b'A b do not change with the basis
TEST(decompositions, tridiagonal_form_keeps_traces_and_quadratic_forms) {
    for (const Index n : {1, 2, 7, 30}) {
        Matrix A = Matrix::Random(n, n);
        A = (A + A.transpose()).eval();
        const Vector b = Vector::Random(n);
        const TridiagonalForm form = tridiagonal_form(A, b);
        Matrix T = form.diagonal.asDiagonal();
        for (Index i = 0; i + 1 < n; ++i) T(i, i + 1) = T(i + 1, i) = form.beside[i];
        EXPECT_NEAR(T.trace(), A.trace(), 1e-12 * n);
        EXPECT_NEAR(T.norm(), A.norm(), 1e-12 * n);
        EXPECT_NEAR(form.rotated.norm(), b.norm(), 1e-12);
        EXPECT_NEAR(form.rotated.dot(T * form.rotated), b.dot(A * b), 1e-11 * n);
        EXPECT_NEAR((T * form.rotated).squaredNorm(), (A * b).squaredNorm(), 1e-10 * n);
    }
}

}  // namespace test_decompositions
