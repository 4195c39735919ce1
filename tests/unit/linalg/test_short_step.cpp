#include "numerics/linalg/short_step.h"

#include <gtest/gtest.h>

#include "numerics/linalg/polynomial.h"
#include "numerics/linalg/types.h"

namespace test_short_step {

using namespace dynlab;

using Long = long double;
using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;

/// exp(A h) - I, h phi_1(hA) and h phi_2(hA) by their series in 80 bits.
struct Expected {
    LongMatrix E, W, R;

    Expected(const Matrix& A, double h) {
        const Index n = A.rows();
        const LongMatrix Z = static_cast<Long>(h) * A.cast<Long>();
        LongMatrix power = LongMatrix::Identity(n, n);  // Z^k/k!
        E = W = R = LongMatrix::Zero(n, n);
        for (int k = 0; k < 80; ++k) {
            if (k > 0) E += power;
            W += static_cast<Long>(h) / (k + 1) * power;
            R += static_cast<Long>(h) / ((k + 1) * (k + 2)) * power;
            power = (Z * power / (k + 1)).eval();
        }
    }
};

template <int capacity>
void expect_step(const Matrix& A, double h) {
    const int n = static_cast<int>(A.rows());
    StateMatrix<capacity> small;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) small(i, j) = A(i, j);
    const auto step = short_step(small, n, h);
    ASSERT_TRUE(step);
    const Expected expected(A, h);
    const auto expect = [&](const StateMatrix<capacity>& found, const LongMatrix& expected_value, const char* what) {
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                EXPECT_NEAR(found(i, j), static_cast<double>(expected_value(i, j)),
                            1e-14 * static_cast<double>(expected_value.row(i).cwiseAbs().maxCoeff()))
                    << what << ", " << n << " states, step " << h;
    };
    expect(step->E, expected.E, "E");
    expect(step->W, expected.W, "W");
    expect(step->R, expected.R, "R");
}

Matrix companion_of(int n) {
    return companion(power(Eigen::Vector2d(1, 0.6), n));
}

// oracle: definition, the series in 80 bits; E keeps its digits however short the step
TEST(short_step, is_the_series_in_80_bits) {
    for (const double h : {1e-9, 0.01, 0.3, 0.9}) {
        for (int n = 1; n <= 4; ++n) expect_step<4>(companion_of(n), h / n);
        for (int n = 1; n <= 8; ++n) expect_step<8>(companion_of(n), h / n);
    }
}

TEST(short_step, a_long_step_and_one_of_which_nothing_is_known_are_refused) {
    StateMatrix<4> A;
    A(0, 0) = -1;
    EXPECT_TRUE(short_step(A, 1, 3.9));
    EXPECT_FALSE(short_step(A, 1, 4.1));
    A(0, 0) = kNaN;
    EXPECT_FALSE(short_step(A, 1, 0.1));
    A(0, 0) = kInfinity;
    EXPECT_FALSE(short_step(A, 1, 0.1));
}

}  // namespace test_short_step
