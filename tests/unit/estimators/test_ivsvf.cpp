#include "numerics/estimators/ivsvf.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_ivsvf {

using namespace dynlab;
using namespace dynlab::test;

const TransferStructure kCourse = TransferStructure::single(2, 0);

SvfOptions cutoff(double lambda) {
    SvfOptions options;
    options.lambda = lambda;
    return options;
}

// oracle: residual of the definition, with stored columns from lsim
TEST(ivsvf, solves_the_equations_of_its_definition) {
    const IdData data = course_system_data(0.2, 3);
    const Vector y = data.experiments[0].y.col(0), u = data.experiments[0].u.col(0);
    for (const double delay : {0.0, 0.07, 0.0537}) {
        const TransferStructure structure = TransferStructure::single(2, 0, delay);
        const Vector first = lssvf(data, structure, cutoff(3)).theta;
        const Vector x = lsim(TransferFunction(values({first[2]}), values({1, first[0], first[1]}), 0, delay), u, 0.01);
        const Matrix y_f = state_variable_filter(y, 2, 3, 0.01, Hold::kFoh);
        const Matrix x_f = state_variable_filter(x, 2, 3, 0.01, Hold::kFoh);
        const Vector u_f = lsim(TransferFunction(values({1}), values({1, 6, 9}), 0, delay), u, 0.01);
        Matrix Z(x.size(), 3), Phi(x.size(), 3);
        Z << -x_f.col(1), -x_f.col(2), u_f;
        Phi << -y_f.col(1), -y_f.col(2), u_f;
        const Vector expected = (Z.transpose() * Phi).partialPivLu().solve(Z.transpose() * y_f.col(0));
        EXPECT_LT(relative_difference(ivsvf(data, structure, cutoff(3)).theta, expected), 1e-10) << delay;
    }
}

TEST(ivsvf, irregular_instants_that_are_regular_give_the_same) {  // oracle: second route
    const IdData data = course_system_data(0.2, 8);
    const IdData irregular(data.experiments[0].y, data.experiments[0].u, data.time());
    EXPECT_LT(relative_difference(ivsvf(irregular, kCourse, cutoff(3)).theta, ivsvf(data, kCourse, cutoff(3)).theta),
              1e-7);
}

TEST(ivsvf, refuses_what_lssvf_refuses) {  // oracle: the sentence names the method and the fault
    const IdData data = course_system_data(0.2, 1);
    EXPECT_NE(thrown_message([&] { ivsvf(data, kCourse, cutoff(-1)); }).find("lambda"), std::string::npos);
    const std::string message = thrown_message([&] { ivsvf(data.range(1, 4), kCourse, cutoff(3)); });
    EXPECT_EQ(message.find("ivsvf: "), 0u) << message;
}

}  // namespace test_ivsvf
