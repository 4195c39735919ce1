#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "base/reader.h"
#include "numerics/estimators/n4sid.h"
#include "support/hair_dryer.h"

namespace test_n4sid_reference {

using namespace dynlab;
using namespace dynlab::test;

// Oracle: the state matrix that the example program of SLICOT's IB01BD prints for the same data (four digits; order 4,
// 15 block rows, means kept): A from the shift of the subspace, as here.
TEST(n4sid_reference, hair_dryer_eigenvalues) {
    const Matrix printed{{0.8924, 0.3887, 0.1285, 0.1716},
                         {-0.0837, 0.6186, -0.6273, -0.4582},
                         {0.0052, 0.1307, 0.6685, -0.6755},
                         {0.0055, 0.0734, -0.2148, 0.4788}};
    SubspaceOptions options;
    options.block_rows = 15;
    const SubspaceFit found = n4sid(hair_dryer(), 4, options);
    const ComplexVector eigenvalues = found.system.A.eigenvalues();
    for (const Complex& value : ComplexVector(printed.eigenvalues()))
        EXPECT_LT((eigenvalues.array() - value).abs().minCoeff(), 1e-3) << value;
    EXPECT_EQ(found.block_rows, 15);
    EXPECT_TRUE(found.fit.warnings.empty()) << message_text(found.fit.full_message());
}

}  // namespace test_n4sid_reference
