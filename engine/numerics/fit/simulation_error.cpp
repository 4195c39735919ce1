#include "numerics/fit/simulation_error.h"

#include <algorithm>
#include <cmath>

#include "numerics/criteria/denominator_group.h"
#include "numerics/criteria/transfer_output.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/signals/correlation.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kLagsOfErrors = 20;      // beyond the delay
constexpr Index kMaxLags = 200;          // the last ones, where the delay is long
constexpr double kFarBeyondChance = 4;   // standard deviations of chi-squared
constexpr double kFastChanges = 0.1;     // squares of the errors' differences, relative to those of the errors
constexpr double kMinInputPower = 1e-6;  // of the input's power

/// The errors of a fit, experiment by experiment.
struct FitErrors {
    FitErrors(const IdData& data, const Fit& fit)
        : model(fit.structure, fit.start, data, 0, shortest_experiment(data)) {
        all = model.target() - model.output_at(search_point(fit, model, model.seconds()));
    }

    auto of(std::size_t experiment) const { return all.segment(model.row(experiment, 0), model.rows(experiment)); }

    TransferOutput model;
    Vector all;
};

bool is_far_beyond_chance(double chi_squared, Index freedom) {
    const double count = static_cast<double>(freedom);
    return chi_squared > count + kFarBeyondChance * std::sqrt(2 * count);
}

bool follow_input(const FitErrors& errors, const IdData& data, double delay) {
    const Index max_lag = kLagsOfErrors + static_cast<Index>(std::ceil(delay / data.mean_step()));
    const Index lags = std::min(max_lag, kMaxLags);
    Vector with_errors = Vector::Zero(lags), with_itself = Vector::Zero(lags);
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
        const auto own = errors.of(e);
        if (own.size() <= 2 * max_lag) return false;
        const Vector u = data.experiments[e].u.col(0).array() - data.experiments[e].u.col(0).mean();
        // Entry i pairs u(k + L - i - most), L the entries' number, with the error at k; reversed, lags grow.
        with_errors += lagged_products(u, own, max_lag).segment(1, lags).reverse();
        with_itself += lagged_products(u, u, lags).segment(lags, lags);
    }
    Matrix gram(lags, lags);
    for (Index i = 0; i < lags; ++i)
        for (Index j = 0; j < lags; ++j) gram(i, j) = with_itself[std::abs(i - j)];
    gram.diagonal().array() += kMinInputPower * with_itself[0];
    const double variance = errors.all.squaredNorm() / static_cast<double>(errors.all.size());
    if (!(variance > 0 && with_itself[0] > 0)) return false;
    const double sum = with_errors.dot(solve_semidefinite(gram, with_errors)) / variance;
    return is_far_beyond_chance(sum, lags);
}

bool change_quickly(const FitErrors& errors, std::size_t experiments) {
    double changes = 0;
    for (std::size_t e = 0; e < experiments; ++e) {
        const auto own = errors.of(e);
        changes += (own.tail(own.size() - 1) - own.head(own.size() - 1)).squaredNorm();
    }
    return changes >= kFastChanges * errors.all.squaredNorm();
}

}  // namespace

double simulation_loss(const IdData& data, const TransferStructure& structure, const VectorView& theta) {
    if (!theta.allFinite()) return kInfinity;
    double squares = 0;
    for (Index output = 0; output < structure.outputs; ++output)
        squares += simulation_squares(data, structure, theta, output);
    const double loss = squares / static_cast<double>(data.sample_count() * structure.outputs);
    return std::isfinite(loss) ? loss : kInfinity;
}

void measure_simulation(Fit& fit, const IdData& data) {
    const TransferStructure& structure = fit.structure;
    const double N = static_cast<double>(data.sample_count()), outputs = static_cast<double>(structure.outputs);
    fit.offsets = Matrix::Zero(static_cast<Index>(data.experiments.size()), structure.outputs);
    fit.fit_percent.resize(structure.outputs);
    fit.noise_variance.resize(structure.outputs);
    fit.loss = 0;
    // Parameters of a common denominator are shared out evenly among the outputs they bear on.
    const double d = static_cast<double>(structure.parameter_count()) / outputs;
    const Vector variations = output_variations(data);
    for (Index output = 0; output < structure.outputs; ++output) {
        const double sum = simulation_squares(data, structure, fit.theta, output);
        const double squares = std::isfinite(sum) ? sum : kInfinity;
        fit.fit_percent[output] = fit_percent_of_sums(squares, variations[output]);
        fit.noise_variance[output] = squares / (N - d);
        fit.loss += squares / N / outputs;
    }
    if (std::isfinite(fit.loss)) return;
    fit.warnings.push_back(
        Message("The simulation of the model diverges on these data, so no fit can be computed. Check the data and the "
                "structure."));
}

bool errors_follow_input(const IdData& data, const Fit& fit) {
    const FitErrors errors(data, fit);
    return !errors.all.allFinite() || follow_input(errors, data, fit.structure.delay(fit.theta, 0, 0));
}

bool fast_errors_follow_input(const IdData& data, const Fit& fit) {
    const FitErrors errors(data, fit);
    return !errors.all.allFinite() || (change_quickly(errors, data.experiments.size()) &&
                                       follow_input(errors, data, fit.structure.delay(fit.theta, 0, 0)));
}

bool errors_are_colored(const IdData& data, const Fit& fit) {
    const FitErrors errors(data, fit);
    if (!errors.all.allFinite()) return true;
    Vector products = Vector::Zero(kLagsOfErrors + 1);
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
        const Vector own = errors.of(e);
        if (own.size() <= 2 * kLagsOfErrors) return false;
        products += lagged_products(own, own, kLagsOfErrors).tail(kLagsOfErrors + 1);
    }
    const double sum = static_cast<double>(errors.all.size()) * products.tail(kLagsOfErrors).squaredNorm();
    return is_far_beyond_chance(sum / (products[0] * products[0]), kLagsOfErrors);
}

}  // namespace dynlab::inline numerics
