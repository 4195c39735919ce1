#include "bench/bench.h"
#include "bench/peers.h"
#include "numerics/estimators/grey_box/greyest.h"
#include "numerics/plants/crane_experiments.h"
#include "support/grey_cases.h"

namespace dynlab::bench {
namespace {

constexpr double kSecondsOfAFit = 0.5;

Vector twice(const Vector& u) {
    Vector both(2 * u.size());
    both << u, u;
    return both;
}

}  // namespace

/// The crane's estimation data, 4 states, 7 parameters, against scipy's least_squares and solve_ivp.
void measure_grey_box(Report& report) {
    const CraneData crane = simulate_crane({}, {}, 1).front();
    Matrix y(crane.u.size(), 2);
    y << crane.x.array() - crane.x[0], crane.theta;
    const IdData data(y, Matrix(crane.u), 0.02);
    const GreyModel model = test::crane_model();
    GreyOptions options;
    options.output_weights = Vector{{1 / 0.005, 1 / 0.01}};
    const auto fit = [&] { return greyest(data, model, options).fit.theta; };
    const std::string what = "grey box of the crane, N = 1574 (s)";
    Vector theta;
    report.results.push_back({what, "half a second", median_seconds(5, [&] { theta = fit(); }), kSecondsOfAFit, 1, 0});
    constexpr double kTolerance = 2e-3;  // scipy stops where its differences end
    compare_with_peer({what, Peer::kNumpy, "grey_box", 1.0 / 20, 0, 5, 1, kTolerance},
                      {twice(crane.u), Vector(y.reshaped())}, fit, report);
}

}  // namespace dynlab::bench
