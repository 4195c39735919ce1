#include <gtest/gtest.h>

#include <Eigen/Core>

#include "numerics/linalg/tall_gram.h"

namespace test_tall_gram {

using namespace dynlab;

TEST(tall_gram, is_the_product_for_any_size) {  // oracle: the definition, each sum separately
    for (const Index rows : {0, 1, 255, 256, 257, 1000})
        for (const Index columns : {0, 1, 3, 4, 7, 17}) {
            Matrix M = Matrix::Random(rows, columns + 1);
            const Matrix gram = tall_gram(M.leftCols(columns), M.col(columns));
            ASSERT_EQ(gram.rows(), columns + 1);
            ASSERT_EQ(gram.cols(), columns + 1);
            for (Index i = 0; i <= columns; ++i)
                for (Index j = 0; j <= columns; ++j)
                    EXPECT_NEAR(gram(i, j), M.col(i).dot(M.col(j)), 1e-13 * static_cast<double>(rows + 1))
                        << rows << " rows, " << columns << " columns, place " << i << ", " << j;
        }
}

}  // namespace test_tall_gram
