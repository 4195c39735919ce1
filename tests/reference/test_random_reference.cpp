#include <gtest/gtest.h>

#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "support/reference_data.h"

namespace test_random_reference {

using namespace dynlab;

Vector column(const std::string& file, const std::string& name) {
    const auto columns = test::reference_columns(file);
    const std::vector<double>& values = columns.at(name);
    return Vector::Map(values.data(), static_cast<Index>(values.size()));
}

TEST(random_reference, noise_of_a_whole_record) {  // oracle: reference data, y = x + 0.2 e with seed 1
    const Vector noise = column("sys2_s0.2_seed1.csv", "y") - column("sys2_noisefree.csv", "y");
    // Outputs of size one were rounded to doubles twice.
    EXPECT_LT((noise - 0.2 * RandomStream(1).normal(1500)).lpNorm<Eigen::Infinity>(), 5e-16);
}

TEST(random_reference, binary_sequences_of_three_experiments) {  // oracle: reference data
    EXPECT_EQ(column("sys2_noisefree.csv", "u"), prbs(4, 100));
    EXPECT_EQ(column("rg_noisefree.csv", "u"), prbs(10, 7));
    EXPECT_EQ(column("P1D_noisefree.csv", "u"), prbs(7, 12));
}

}  // namespace test_random_reference
