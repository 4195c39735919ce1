// Oracles: the equations written out sample by sample and solved by Eigen, the system that made the data.
#include "numerics/validation/arx_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "base/reader.h"
#include "numerics/signals/random.h"
#include "support/thrown_message.h"

namespace test_arx_selection {

using namespace dynlab;

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// y(k) = 1.5 y(k-1) - 0.7 y(k-2) + u(k-2) + 0.5 u(k-3) + 0.3 e(k)
Experiment experiment(std::uint32_t seed, Index samples) {
    RandomStream random(seed);
    const Vector u = random.normal(samples), e = random.normal(samples);
    Vector y = Vector::Zero(samples);
    for (Index k = 3; k < samples; ++k) y[k] = 1.5 * y[k - 1] - 0.7 * y[k - 2] + u[k - 2] + 0.5 * u[k - 3] + 0.3 * e[k];
    Experiment one;
    one.y = y;
    one.u = u;
    return one;
}

IdData simulated_data(std::uint32_t seed, Index samples = 600) {
    const Experiment one = experiment(seed, samples);
    return IdData(one.y, one.u, 1);
}

struct Equations {
    Matrix Phi;
    Vector y;
};

Equations written_out(const IdData& data, int na, int nb, int nk, Index past) {
    std::vector<Vector> rows;
    std::vector<double> outputs;
    for (const Experiment& one : data.experiments)
        for (Index k = past; k < one.y.rows(); ++k) {
            Vector row(na + nb);
            for (int i = 0; i < na; ++i) row[i] = -one.y(k - 1 - i, 0);
            for (int j = 0; j < nb; ++j) row[na + j] = one.u(k - nk - j, 0);
            rows.push_back(row);
            outputs.push_back(one.y(k, 0));
        }
    Equations all{Matrix(static_cast<Index>(rows.size()), na + nb), Vector(static_cast<Index>(rows.size()))};
    for (std::size_t k = 0; k < rows.size(); ++k) {
        all.Phi.row(static_cast<Index>(k)) = rows[k].transpose();
        all.y[static_cast<Index>(k)] = outputs[k];
    }
    return all;
}

TEST(arx_selection, losses_are_those_of_the_equations_written_out) {
    IdData data = simulated_data(1);
    data.experiments.push_back(experiment(2, 200));
    const IdData unseen = simulated_data(3, 300);
    const ArxRanges ranges{{0, 3}, {1, 3}, {1, 3}};
    const Index past = 3 + 3 - 1;
    const ArxSelection selection = select_arx(data, ranges, &unseen);
    ASSERT_EQ(selection.candidates.size(), 4u * 3 * 3);
    EXPECT_EQ(selection.equations, 800 - 2 * past);
    for (const ArxCandidate& candidate : selection.candidates) {
        SCOPED_TRACE(testing::Message() << candidate.na << candidate.nb << candidate.nk);
        const Equations own = written_out(data, candidate.na, candidate.nb, candidate.nk, past),
                        other = written_out(unseen, candidate.na, candidate.nb, candidate.nk, past);
        const Vector theta = own.Phi.colPivHouseholderQr().solve(own.y);
        const double V = (own.y - own.Phi * theta).squaredNorm() / static_cast<double>(own.y.size());
        EXPECT_NEAR(candidate.loss, V, 1e-10 * V);
        const double unseen_loss = (other.y - other.Phi * theta).squaredNorm() / static_cast<double>(other.y.size());
        EXPECT_NEAR(candidate.validation_loss.value(), unseen_loss, 1e-9 * unseen_loss);
        const double N = static_cast<double>(own.y.size()), d = candidate.na + candidate.nb;
        EXPECT_NEAR(candidate.aic, std::log(V) + 2 * d / N, 1e-9);
        EXPECT_NEAR(candidate.bic, std::log(V) + d * std::log(N) / N, 1e-9);
        EXPECT_TRUE(candidate.determined);
    }
}

ArxCandidate chosen(const ArxSelection& selection, ArxCriterion criterion) {
    return selection.candidates[choose_arx(selection, criterion).place];
}

TEST(arx_selection, finds_the_orders_that_made_the_record) {
    for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
        const ArxCandidate best =
            chosen(select_arx(simulated_data(seed), {{1, 4}, {1, 4}, {1, 3}}), ArxCriterion::kBic);
        EXPECT_EQ(best.na, 2) << seed;
        EXPECT_EQ(best.nb, 2) << seed;
        EXPECT_EQ(best.nk, 2) << seed;
    }
}

TEST(arx_selection, own_loss_falls_with_every_parameter_and_the_choice_says_so) {  // oracle: nested least squares
    const ArxSelection alone = select_arx(simulated_data(1), {{1, 4}, {2, 2}, {2, 2}});
    for (std::size_t i = 1; i < alone.candidates.size(); ++i)
        EXPECT_LE(alone.candidates[i].loss, alone.candidates[i - 1].loss);
    const OrderChoice choice = choose_arx(alone, ArxCriterion::kLoss);
    EXPECT_EQ(choice.place, 3u);
    EXPECT_THAT(message_text(choice.explanation),
                HasSubstr("{na, nb, nk} = {4, 2, 2} has the smallest loss. On the estimation data, the loss decreases "
                          "with every additional parameter"));
    EXPECT_THAT(message_text(choice.explanation),
                HasSubstr("With 4 parameters instead of 6, {2, 2, 2} has a loss that is at most 1 %"));
    EXPECT_EQ(usual_criterion(alone), ArxCriterion::kBic);
    const IdData unseen = simulated_data(2, 5000);
    const ArxSelection both = select_arx(simulated_data(1), {{1, 4}, {2, 2}, {2, 2}}, &unseen);
    EXPECT_EQ(usual_criterion(both), ArxCriterion::kLoss);
    EXPECT_THAT(message_text(choose_arx(both, ArxCriterion::kLoss).explanation), HasSubstr("on the validation data"));
    EXPECT_THAT(message_text(choose_arx(both, ArxCriterion::kAic).explanation), Not(HasSubstr("record")));
}

TEST(arx_selection, a_poor_input_chooses_what_it_determines) {  // oracle: a constant determines one coefficient
    IdData data = simulated_data(1);
    data.experiments[0].u.setOnes();
    data.experiments[0].y = RandomStream(3).normal(600);
    const ArxSelection selection = select_arx(data, {{1, 1}, {1, 2}, {1, 1}});
    EXPECT_TRUE(selection.candidates[0].determined);
    EXPECT_FALSE(selection.candidates[1].determined);
    EXPECT_EQ(chosen(selection, ArxCriterion::kLoss).nb, 1);
}

TEST(arx_selection, says_what_is_wrong) {
    const IdData data = simulated_data(1, 60);
    const auto complaint = [&](const ArxRanges& ranges) { return thrown_message([&] { select_arx(data, ranges); }); };
    EXPECT_THAT(complaint({{2, 1}, {1, 1}, {1, 1}}), HasSubstr("na must be a number or a range"));
    EXPECT_THAT(complaint({{1, 1}, {0, 1}, {1, 1}}), HasSubstr("nb must be"));
    EXPECT_THAT(complaint({{1, 1}, {0, 0}, {1, 1}}), EndsWith("starting at 1 or higher, but it is 0"));
    EXPECT_THAT(complaint({{2, 1}, {1, 1}, {1, 1}}), EndsWith("or higher, but it is {2, 1}"));
    EXPECT_THAT(complaint({{1, 1}, {1, 1}, {-1, 1}}), HasSubstr("nk must be"));
    EXPECT_THAT(complaint({{1, 50}, {1, 50}, {0, 50}}), HasSubstr("more than 2000"));
    EXPECT_THAT(complaint({{1, 30}, {1, 30}, {1, 1}}),
                HasSubstr("arxstruc estimates 60 parameters and needs more equations than parameters"));
    IdData two = data;
    two.experiments[0].u.conservativeResize(Eigen::NoChange, 2);
    two.input_names = {"u1", "u2"};
    EXPECT_THAT(thrown_message([&] { select_arx(two, {}); }), HasSubstr("must have one input"));
}

}  // namespace test_arx_selection
