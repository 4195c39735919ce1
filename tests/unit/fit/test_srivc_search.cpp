#include "numerics/fit/srivc_search.h"

#include <gtest/gtest.h>

#include "numerics/estimators/srivc.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/transfer_cases.h"

namespace test_srivc_search {

using namespace dynlab;
using namespace dynlab::test;

const TransferStructure kCourse = TransferStructure::single(2, 0);

// oracle: nested models; with its third pole far away the larger one is the smaller one
TEST(srivc_search, superfluous_poles_do_not_spoil_the_model) {
    const TransferFunction truth(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3));
    const Vector u = prbs(7, 8);
    const Vector x = lsim(truth, u, 0.05);
    for (const std::uint32_t seed : {1, 2, 3}) {
        const IdData data(x + 0.1 * RandomStream(seed).normal(x.size()), u, 0.05);
        for (const int poles : {3, 4}) {
            const Fit large = srivc(data, TransferStructure::single(poles, 0));
            EXPECT_LT(large.loss, 1.01 * srivc(data, kCourse).loss) << poles << ": " << large.message;
        }
    }
}

// oracle: nested models
TEST(srivc_search, passes_that_settle_in_a_bad_minimum_are_seen_by_their_errors) {
    const TransferFunction G(values({-6400, 1600}), values({1, 5, 408, 416, 1600}));
    constexpr double kTs = 0.05;
    const Vector u = prbs(8, 3), x = lsim(G, u, kTs);
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        const Vector y = x + 0.35 * RandomStream(seed).normal(x.size());
        const IdData data{Matrix(y), Matrix(u), kTs};
        const Fit two = srivc(data, TransferStructure::single(2, 0)),
                  three = srivc(data, TransferStructure::single(3, 0));
        EXPECT_LE(three.loss, two.loss) << seed;
    }
}

// oracle: the passes' own end; an estimate that is good is given back as it is
TEST(srivc_search, good_passes_are_not_searched_further) {
    const TransferFunction truth(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3));
    const Vector u = prbs(7, 8);
    const Vector x = lsim(truth, u, 0.05);
    const IdData data(x + 0.1 * RandomStream(1).normal(x.size()), u, 0.05);
    const Fit passes = srivc_by_passes(data, kCourse, {});
    EXPECT_EQ(search_where_passes_fail(passes, data, {}, {}).theta, passes.theta);
}

// oracle: the same minimum by the passes
TEST(srivc_search, the_search_alone_ends_where_good_passes_end) {
    const TransferFunction truth(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3));
    const Vector u = prbs(7, 8);
    const Vector x = lsim(truth, u, 0.05);
    const IdData data(x + 0.1 * RandomStream(2).normal(x.size()), u, 0.05);
    FitOptions options;
    options.tolerance = 1e-10;
    const Fit passes = srivc_by_passes(data, kCourse, options), searched = search_transfer("srivc", data, kCourse, options);
    EXPECT_LT((searched.theta - passes.theta).norm(), 1e-6 * passes.theta.norm());
}

}  // namespace test_srivc_search
