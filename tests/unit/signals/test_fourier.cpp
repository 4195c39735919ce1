#include "numerics/signals/fourier.h"

#include <gtest/gtest.h>

#include "numerics/signals/random.h"

namespace test_fourier {

using namespace dynlab;

TEST(fourier, of_two_signals_at_once_is_that_of_each) {  // second route: each transformed alone; lengths of both kinds
    RandomStream random(1);
    for (const Index N : {1, 2, 7, 60, 1009}) {
        const Vector x = random.normal(N), y = 1e-9 * random.normal(N);
        const TransformPair pair = fourier_transforms(x, y);
        EXPECT_LT((pair.first - fourier_transform(x)).norm(), 1e-12 * x.norm() * std::sqrt(N)) << N;
        EXPECT_LT((pair.second - fourier_transform(y)).norm(), 1e-12 * y.norm() * std::sqrt(N)) << N;
    }
    EXPECT_EQ(fourier_transforms(Vector::Zero(4), Vector::Zero(4)).second, ComplexVector::Zero(4));
}

}  // namespace test_fourier
