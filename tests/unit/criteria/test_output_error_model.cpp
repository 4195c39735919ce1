#include <gtest/gtest.h>

#include "numerics/criteria/output_error_model.h"
#include "numerics/signals/random.h"

namespace test_output_error_model {

using namespace dynlab;

/// output = J theta for a given J, without bounds.
class LinearModel : public OutputErrorModel {
  public:
    explicit LinearModel(Matrix J) : J_(std::move(J)) { set_free(J_.cols()); }
    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override {
        output = J_ * theta;
        if (sensitivities != nullptr) *sensitivities = J_;
    }

  private:
    Matrix J_;
};

// Oracle: the sums term by term, in extended precision. 1100 rows are more than one block and no whole number of them.
TEST(output_error_model, products_are_the_sums_over_all_samples) {
    constexpr Index kRows = 1100, kColumns = 3;
    const Vector numbers = RandomStream(5).normal(kRows * (kColumns + 1));
    const Matrix J = Eigen::Map<const Matrix>(numbers.data(), kRows, kColumns);
    const Vector y = numbers.tail(kRows), theta{{0.3, -2, 1}};
    const OutputErrorProducts sums = LinearModel(J).products(theta, y);
    long double squares = 0;
    for (Index k = 0; k < kRows; ++k) {
        const long double e = y[k] - (J(k, 0) * theta[0] + J(k, 1) * theta[1] + J(k, 2) * theta[2]);
        squares += e * e;
    }
    EXPECT_NEAR(sums.squares, static_cast<double>(squares), 1e-12 * static_cast<double>(squares));
    for (Index i = 0; i < kColumns; ++i) {
        long double descent = 0;
        for (Index k = 0; k < kRows; ++k) descent += J(k, i) * (y[k] - J.row(k).dot(theta));
        EXPECT_NEAR(sums.descent[i], static_cast<double>(descent), 1e-9);
        for (Index j = 0; j < kColumns; ++j) {
            long double product = 0;
            for (Index k = 0; k < kRows; ++k) product += static_cast<long double>(J(k, i)) * J(k, j);
            EXPECT_NEAR(sums.gram(i, j), static_cast<double>(product), 1e-10);
        }
    }
}

}  // namespace test_output_error_model
