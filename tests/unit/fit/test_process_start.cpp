#include <gtest/gtest.h>

#include "numerics/fit/process_start.h"
#include "support/process_cases.h"
#include "support/transfer_cases.h"

namespace test_process_start {

using namespace dynlab;
using namespace dynlab::test;

/// The mean square that a start leaves, simulated with lsim from rest.
double loss_at(const ProcessStructure& structure, const Vector& theta, const IdData& data) {
    const TransferFunction G = ProcessModel(structure, theta).transfer_function();
    const Experiment& data_set = data.experiments[0];
    return (data_set.y.col(0) - lsim(G, data_set.u.col(0), data.Ts, data.hold)).squaredNorm() /
           static_cast<double>(data.sample_count());
}

TEST(process_start, a_start_explains_most_of_the_output) {  // oracle: lsim at the start against the output's power
    Vector u = RandomStream(5).normal(900);
    for (Index k = 0; k < 900; ++k) u[k] = u[k - k % 12] > 0 ? 1 : -1;
    for (const ProcessModel& model : every_process(4.0)) {
        IdData data(Matrix(lsim(model.transfer_function(), u, 1, Hold::kFoh)), Matrix(u), 1);
        data.hold = Hold::kFoh;
        const ProcessStructure& structure = model.structure;
        const TransferOutput output(transfer_structure(structure), {InitialState::kZero, false}, data, 0, 20,
                                    at_rest(structure));
        const ProcessScan scan = scan_process_grid(structure, output, 21);
        ASSERT_FALSE(scan.starts.empty()) << structure.text();
        const double power = data.experiments[0].y.squaredNorm() / 900;
        EXPECT_LT(loss_at(structure, scan.starts[0], data), 0.1 * power) << structure.text();
        EXPECT_EQ(scan.delays.size(), structure.delay ? 21 : 0) << structure.text();
        EXPECT_EQ(scan.losses.size(), scan.delays.size());
    }
}

TEST(process_start, the_delay_shows_in_the_losses) {  // oracle: the simulated system
    const Vector u = prbs(8, 5, -1, 1);
    const ProcessStructure structure = ProcessStructure::parse("P1D");
    const Vector y = lsim(ProcessModel(structure, values({2, 6, 13})).transfer_function(), u, 1);
    const IdData data(Matrix(y), Matrix(u), 1);
    const TransferOutput output(transfer_structure(structure), {InitialState::kZero, false}, data, 0, 40,
                                at_rest(structure));
    const ProcessScan scan = scan_process_grid(structure, output, 41);
    Index best = 0;
    scan.losses.minCoeff(&best);
    EXPECT_NEAR(scan.delays[best], 13, 1);
    EXPECT_NEAR(scan.starts[0][0], 2, 0.4);
}

}  // namespace test_process_start
