#include "numerics/signals/butterworth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/signals/random.h"
#include "support/thrown_message.h"

namespace test_butterworth {

using namespace dynlab;
using testing::HasSubstr;

constexpr double kTs = 0.1, kInfinity = std::numeric_limits<double>::infinity();
const double kEnd = std::numbers::pi / kTs;

/// The analytic squared magnitude, after the bilinear transform's w -> tan(w Ts/2).
double squared_magnitude(const PassBand& band, int order, bool stop, double w) {
    const auto warped = [](double frequency) { return std::tan(frequency * kTs / 2); };
    double v = 0;
    if (band.low == 0) {
        v = warped(w) / warped(band.high);
    } else if (std::isinf(band.high)) {
        v = warped(band.low) / warped(w);
    } else {
        const double low = warped(band.low), high = warped(band.high), W = warped(w);
        v = std::abs(W * W - low * high) / ((high - low) * W);
    }
    if (stop) v = 1 / v;
    return 1 / (1 + std::pow(v, 2 * order));
}

FilterOptions of_order(int order, bool stop = false) {
    FilterOptions options;
    options.order = order;
    options.stop = stop;
    return options;
}

Vector impulse_at(Index place, Index count) {
    return Vector::Unit(count, place);
}

TEST(butterworth, has_the_analytic_magnitude) {  // oracle: |H|^2 = 1/(1 + v^(2n))
    const Vector w = Vector::LinSpaced(200, 0.001, 0.999) * kEnd;
    for (const PassBand& band :
         {PassBand{0, 3}, PassBand{0, 25}, PassBand{5, kInfinity}, PassBand{2, 6}, PassBand{1, 28}})
        for (const bool stop : {false, true})
            for (const int order : {1, 2, 3, 5, 8}) {
                const ComplexVector H = response(butterworth(band, kTs, of_order(order, stop)), w, kTs);
                for (Index i = 0; i < w.size(); ++i) {
                    // a stop band below or above one edge is the pass band beyond it
                    const double expected = squared_magnitude(band, order, stop, w[i]);
                    EXPECT_NEAR(std::norm(H[i]), expected, 1e-9)
                        << band.low << " " << band.high << " " << order << stop;
                }
            }
}

TEST(butterworth, edges_lie_at_minus_3_db) {  // oracle: definition
    const FilterSections band = butterworth({2, 6}, kTs, of_order(4));
    const ComplexVector H = response(band, Vector{{2.0, 6.0}}, kTs);
    EXPECT_NEAR(std::norm(H[0]), 0.5, 1e-12);
    EXPECT_NEAR(std::norm(H[1]), 0.5, 1e-12);
}

TEST(butterworth, filtering_follows_the_frequency_response) {  // oracle: a sine after the transient
    for (const PassBand& band : {PassBand{0, 4}, PassBand{3, kInfinity}, PassBand{2, 7}}) {
        const FilterSections sections = butterworth(band, kTs, of_order(3));
        const double w = 3.7;
        const Complex H = response(sections, Vector{{w}}, kTs)[0];
        Vector x(2000);
        for (Index k = 0; k < x.size(); ++k) x[k] = std::sin(w * kTs * static_cast<double>(k));
        const Vector y = filter_signal(sections, x);
        for (Index k = 1500; k < 2000; ++k)
            EXPECT_NEAR(y[k], std::abs(H) * std::sin(w * kTs * static_cast<double>(k) + std::arg(H)), 1e-10);
    }
}

TEST(butterworth, energy_of_the_impulse_response_is_the_mean_of_the_squared_magnitude) {  // oracle: Parseval
    const FilterSections sections = butterworth({1.5, 9}, kTs, of_order(4));
    const double energy = filter_signal(sections, impulse_at(0, 4000)).squaredNorm();
    const Index points = 8192;  // the trapezoidal rule is exact for a periodic analytic function
    const Vector w = (Vector::LinSpaced(points, 0, static_cast<double>(points - 1)).array() + 0.5) *
                     (kEnd / static_cast<double>(points));
    EXPECT_NEAR(energy, response(sections, w, kTs).cwiseAbs2().mean(), 1e-10);
}

TEST(butterworth, both_directions_give_a_symmetric_response_of_squared_magnitude) {  // oracle: zero phase by definition
    const FilterSections sections = butterworth({0, 6}, kTs, of_order(5));
    const Index half = 600;
    const Vector h = filter_zero_phase(sections, impulse_at(half, 2 * half + 1));
    EXPECT_LT((h - h.reverse()).cwiseAbs().maxCoeff(), 1e-12);
    for (const double w : {0.0, 2.0, 6.0, 15.0}) {
        double sum = 0;
        for (Index k = -half; k <= half; ++k) sum += h[k + half] * std::cos(w * kTs * static_cast<double>(k));
        EXPECT_NEAR(sum, std::norm(response(sections, Vector{{w}}, kTs)[0]), 1e-10) << w;
    }
}

TEST(butterworth, both_directions_keep_levels_and_slopes_up_to_the_ends) {  // oracle: a line passes a low-pass filter
    Vector line(300);
    for (Index k = 0; k < line.size(); ++k) line[k] = 20 - 0.3 * static_cast<double>(k);
    EXPECT_LT((filter_zero_phase(butterworth({0, 2}, kTs), line) - line).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_EQ(filter_zero_phase(butterworth({0, 2}, kTs), Vector{{4.0}})[0], 4);
}

TEST(butterworth, the_past_is_zero_or_the_first_sample) {  // oracle: definition
    const Vector level = Vector::Constant(50, 7.0);
    for (const PassBand& band : {PassBand{0, 2}, PassBand{2, kInfinity}, PassBand{1, 2}}) {
        const FilterSections sections = butterworth(band, kTs, of_order(3));
        const double gain = response(sections, Vector{{0.0}}, kTs)[0].real();
        EXPECT_LT((filter_signal(sections, level, true).array() - 7 * gain).abs().maxCoeff(), 1e-12);
        const Vector from_zero = filter_signal(sections, level);
        EXPECT_NEAR(from_zero[0], 7 * filter_signal(sections, impulse_at(0, 1))[0], 1e-15);
    }
}

TEST(butterworth, the_relation_between_input_and_output_survives) {  // oracle: filters commute
    RandomStream random(4);
    const Vector u = random.normal(400);
    const FilterSections plant = butterworth({0, 5}, kTs, of_order(2));
    const IdData data(Matrix(filter_signal(plant, u)), Matrix(u), kTs);
    const IdData filtered = filter_data(data, {0, 12}, of_order(4));
    const Vector again = filter_signal(plant, filtered.experiments[0].u.col(0));
    EXPECT_LT((filtered.experiments[0].y.col(0) - again).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(butterworth, very_low_edges_stay_accurate) {  // oracle: the analytic magnitude, at 1/3000 of the sampling rate
    const FilterSections sections = butterworth({0, 2e-3 * kEnd}, kTs, of_order(8));
    const double w = 1e-3 * kEnd;
    EXPECT_NEAR(std::norm(response(sections, Vector{{w}}, kTs)[0]), squared_magnitude({0, 2e-3 * kEnd}, 8, false, w),
                1e-6);
    const Vector y = filter_signal(sections, Vector::Ones(20000));
    EXPECT_NEAR(y[19999], 1, 1e-6);
}

TEST(butterworth, refuses_bands_that_are_none) {
    const auto message = [](double low, double high) { return thrown_message([&] { butterworth({low, high}, kTs); }); };
    for (const auto& [low, high] : std::vector<std::pair<double, double>>{
             {0, kInfinity}, {-1, 3}, {4, 4}, {5, 4}, {40, 50}, {0, 0}, {0, 32}, {std::nan(""), 3}, {0, std::nan("")}})
        EXPECT_THAT(message(low, high), HasSubstr("must have an edge between 0 and pi/Ts = 31.416"))
            << low << " " << high;
    EXPECT_THROW(butterworth({0, 3}, kTs, of_order(0)), InvalidArgument);
    EXPECT_THROW(butterworth({0, 3}, kTs, of_order(21)), InvalidArgument);
    const IdData irregular(Matrix(Vector{{1, 2, 3}}), Matrix(), Vector{{0, 1, 3}});
    EXPECT_THROW(filter_data(irregular, {0, 1}), InvalidArgument);
}

}  // namespace test_butterworth
