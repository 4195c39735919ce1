#include "numerics/estimators/frequency/frequency_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "numerics/criteria/frequency_output.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/frequency_start.h"
#include "numerics/fit/output_error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/simulation/sampled_response.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kStartPasses = 20, kGridPasses = 5, kRoughIterations = 15, kMaxIterations = 500;
constexpr double kRoughTolerance = 1e-3;
constexpr std::size_t kBestDelays = 3;
constexpr double kClearlyBetter = 0.98;  // of the loss, for an unstable model

struct Start {
    Vector coefficients;
    double delay = 0;  // s
};

void check_fit(const std::string& method, const FrequencyData& data, const TransferStructure& structure) {
    structure.validate();
    check_frequency_data(method, data);
    if (!structure.single_channel())
        throw InvalidArgument("{}: a frequency response has one input and one output, but the model has {} and {}",
                              method, structure.inputs, structure.outputs);
    if (data.w.size() < structure.parameter_count())
        throw InvalidArgument("{}: the response must have at least as many frequencies as parameters ({}), but has {}",
                              method, structure.parameter_count(), data.w.size());
}

Index pole_count(const TransferStructure& structure) {
    return structure.poles.front();
}
Index zero_count(const TransferStructure& structure) {
    return structure.channels.front().zeros;
}

/// Frequencies in the middle of the response's weighted power, rad/s.
double middle_frequency(const FrequencyData& data) {
    const Vector power = response_weights(data).cwiseProduct(data.response.cwiseAbs()).cwiseAbs2();
    return std::sqrt(power.dot(data.w.cwiseAbs2()) / power.sum());
}

DelayRange range_of_delays(const FrequencyData& data, const FitOptions& options) {
    if (options.largest_delay) return {options.least_delay, *options.largest_delay};
    constexpr double kQuarter = std::numbers::pi / 2, kMaxQuarters = 50;
    double nearest = data.w[0];
    for (Index k = 1; k < data.w.size(); ++k) nearest = std::min(nearest, data.w[k] - data.w[k - 1]);
    const double distinguishable = kQuarter / nearest, worth_it = kMaxQuarters * kQuarter / middle_frequency(data);
    return {options.least_delay, std::max(options.least_delay, std::min(distinguishable, worth_it))};
}

FrequencyStart start_at(const FrequencyData& data, const TransferStructure& structure, double delay, int passes) {
    return sanathanan_koerner(equation_lines(data, delay), pole_count(structure), zero_count(structure), passes);
}

/// The best local minima of the error over a grid of delays, s.
std::vector<double> promising_delays(const FrequencyData& data, const TransferStructure& structure,
                                     const DelayRange& range, const FitOptions& options, Fit& reported) {
    const int count = range.largest > range.least ? std::max(options.delay_count, 2) : 1;
    reported.delay_grid = Vector::LinSpaced(count, range.least, range.largest);
    reported.delay_loss.resize(count);
    for (Index i = 0; i < count; ++i)
        reported.delay_loss[i] = start_at(data, structure, reported.delay_grid[i], kGridPasses).squares /
                                 static_cast<double>(2 * data.w.size());
    const auto loss = [&](Index i) { return i < 0 || i >= count ? kInfinity : reported.delay_loss[i]; };
    std::vector<Index> minima;
    for (Index i = 0; i < count; ++i)
        if (loss(i) <= loss(i - 1) && loss(i) <= loss(i + 1)) minima.push_back(i);
    std::sort(minima.begin(), minima.end(), [&](Index a, Index b) { return loss(a) < loss(b); });
    if (minima.size() > kBestDelays) minima.resize(kBestDelays);
    std::vector<double> delays;
    for (const Index i : minima) delays.push_back(reported.delay_grid[i]);
    if (delays.empty()) delays.push_back(range.least);
    return delays;
}

std::vector<Start> starts_of(const FrequencyData& data, const TransferStructure& structure,
                             const std::vector<double>& delays, bool stable_alone) {
    std::vector<Start> starts;
    for (const double delay : delays) {
        const Vector found = start_at(data, structure, delay, kStartPasses).coefficients;
        if (found.size() == 0) continue;
        const bool stable = is_hurwitz(monic(found.head(pole_count(structure))));
        if (!stable) starts.push_back({with_stable_poles(found, pole_count(structure)), delay});
        if (stable || !stable_alone) starts.push_back({found, delay});
    }
    if (starts.empty())
        throw InvalidArgument(
            "the response does not determine a model with {}, because the equations have no solution. Use fewer poles",
            plural(pole_count(structure), "{} pole", "{} poles"));
    return starts;
}

bool has_realization_variance(const FrequencyData& data) {
    return data.realized.cols() > 1 && data.variance.size() > 0;
}

/// The covariance of theta; `plain` is that of errors that are independent between frequencies. Errors of nonlinear
/// distortion are uncorrelated but not independent: a gain common to all frequencies changes with the realization
/// (Schoukens and Pintelon 2010, IEEE Trans. Instrum. Meas. 59, 3159-3167). The changes of theta by each realization
/// estimate their covariance. This estimate has the weight of distortion in the variance; `plain` counts as one more
/// realization.
Matrix covariance_with_distortion(const FrequencyData& data, const Matrix& plain, const Matrix& changes) {
    constexpr double kPlainRealizations = 1, kMostlyDistortion = 0.5;
    const auto M = static_cast<double>(changes.cols());
    double distortion = 1;  // its share of the variance, at the most informative frequencies
    if (data.noise_variance.size() > 0) {
        const Vector counts = data.response.cwiseAbs2().cwiseQuotient(data.variance);
        const double noise = counts.dot(data.noise_variance.cwiseQuotient(data.variance)) / counts.sum();
        distortion -= std::min(1.0, noise);
    }
    const double weight = std::min(1.0, distortion / kMostlyDistortion) * (M - 1) / (M - 1 + kPlainRealizations);
    return (1 - weight) * plain + weight / (M * (M - 1)) * changes * changes.transpose();
}

/// A search with its end in seconds, and where another one would begin.
struct Searched {
    Fit fit;
    Start end;
};

class FrequencySearch {
  public:
    FrequencySearch(const FrequencyData& data, const TransferStructure& structure, const DelayRange& range,
                    const FitOptions& options)
        : data_(data), structure_(structure), range_(range), options_(options) {}

    Searched from(const std::vector<Start>& starts, bool stable_alone) const {
        std::optional<Searched> best;
        for (const Start& start : starts) {
            Searched found = once(start, options_.rough(kRoughIterations, kRoughTolerance), stable_alone);
            if (!best || found.fit.loss < best->fit.loss) best = std::move(found);
        }
        Searched end = continued(*best, options_, stable_alone);
        if (end.fit.termination == Termination::kIterationLimit && options_.extend_iterations)
            end = continued(end, options_.limited(kMaxIterations, options_.tolerance), stable_alone);
        return end;
    }

    /// What each realization of the response would change of theta, a column each; `plain`: (J'J)^-1 of theta.
    Matrix changes_by_realization(const Searched& found, const Matrix& plain) const {
        const FrequencyOutput model(data_, structure_, found.end.coefficients, range_.least, range_.largest);
        Vector output;
        Matrix J, changes(plain.rows(), data_.realized.cols());
        model.simulate(model.parameters(found.end.coefficients, found.end.delay / model.time_unit()), output, &J);
        const Matrix slopes = solve_by_lu(model.theta_derivatives().transpose(), J.transpose()).x;
        for (Index m = 0; m < changes.cols(); ++m)
            changes.col(m) = plain * (slopes * model.stacked(data_.realized.col(m) - data_.response));
        return changes;
    }

  private:
    Searched continued(const Searched& before, const FitOptions& options, bool stable_alone) const {
        Searched end = once(before.end, options, stable_alone);
        end.fit.trace.insert(end.fit.trace.begin(), before.fit.trace.begin(), before.fit.trace.end());
        return end;
    }

    Searched once(const Start& start, const FitOptions& options, bool stable_alone) const {
        FrequencyOutput model(data_, structure_, start.coefficients, range_.least, range_.largest);
        if (stable_alone) model.keep_stable();
        const double unit = model.time_unit();
        Searched found{minimize_output_error(model, model.target(),
                                             model.parameters(start.coefficients, start.delay / unit), options),
                       {}};
        const Index count = start.coefficients.size();
        const Vector end = found.fit.theta;
        const Matrix derivatives = model.theta_derivatives();
        found.end = {model.coefficients(end), structure_.free_delays ? end[count] * unit : start.delay};
        found.fit.theta = model.theta(end);
        found.fit.covariance = derivatives * found.fit.covariance * derivatives.transpose();
        for (FitIteration& iteration : found.fit.trace) iteration.theta = model.theta(iteration.theta);
        return found;
    }

    const FrequencyData& data_;
    const TransferStructure& structure_;
    const DelayRange& range_;
    const FitOptions& options_;
};

/// Weighted errors, and the weighted response about its weighted mean.
double fit_percent_of(const FrequencyData& data, const TransferFunction& G) {
    const Vector weights = response_weights(data).cwiseAbs2();
    const ComplexVector model = response_between_samples(G, data.w, data.Ts, data.inter_sample);
    const Complex mean = data.response.cwiseProduct(weights.cast<Complex>()).sum() / weights.sum();
    return fit_percent_of_sums(weights.dot((data.response - model).cwiseAbs2()),
                               weights.dot((data.response.array() - mean).abs2().matrix()));
}

void warn_of_misfit(Fit& fit, const FrequencyData& data, Index values) {
    constexpr double kChance = 0.001, kWorthTelling = 1.1;
    const auto degrees = static_cast<double>(2 * data.w.size() - values);
    if (data.variance.size() == 0 || data.neighbors_share_errors || degrees < 1) return;
    if (fit.noise_variance[0] < kWorthTelling) return;
    if (chi_squared_upper_tail(fit.noise_variance[0] * degrees, degrees) < kChance)
        fit.warnings.push_back(
            Message("The model deviates from the response by more than the variance explains (mean square {}, expected "
                    "1). The model needs more poles or zeros, or the variance and the standard errors are too small.",
                    significant(fit.noise_variance[0], 3)));
}

void describe(Fit& fit, const FrequencyData& data) {
    describe_models(fit);
    fit.fit_percent = Vector::Constant(1, fit_percent_of(data, fit.models.front()));
    fit.offsets = Matrix::Zero(1, 1);
    if (data.neighbors_share_errors)
        fit.warnings.push_back(
            Message("The errors of neighboring values of a smoothed response are correlated. The standard errors are "
                    "too small, and the damping of narrow peaks is overestimated."));
}

}  // namespace

Fit frequency_fit(const std::string& method, const FrequencyData& data, const TransferStructure& structure,
                  const FitOptions& options) {
    options.validate();
    check_fit(method, data, structure);
    const DelayRange range = range_of_delays(data, options);
    Fit reported;
    const std::vector<double> delays = structure.free_delays
                                           ? promising_delays(data, structure, range, options, reported)
                                           : std::vector<double>{structure.channels.front().delay};
    const bool stable_alone = options.stable.value_or(false);
    const FrequencySearch search(data, structure, range, options);
    const std::vector<Start> starts = starts_of(data, structure, delays, stable_alone);
    Searched found = search.from(starts, stable_alone);
    if (!options.stable && has_unstable_pole(structure.models(found.fit.theta).front())) {
        Searched other = search.from(starts_of(data, structure, delays, true), true);
        if (kClearlyBetter * other.fit.loss <= found.fit.loss) found = std::move(other);
    }
    Fit& fit = found.fit;
    fit.structure = structure;
    fit.delay_grid = reported.delay_grid, fit.delay_loss = reported.delay_loss;
    if (data.variance.size() > 0) fit.covariance /= fit.noise_variance[0];
    if (has_realization_variance(data))
        fit.covariance =
            covariance_with_distortion(data, fit.covariance, search.changes_by_realization(found, fit.covariance));
    warn_of_search(fit, options);
    describe(fit, data);
    warn_of_misfit(fit, data, fit.theta.size());
    if (data.variance.size() == 0) fit.loss *= 2, fit.noise_variance *= 2;  // of both parts
    if (structure.free_delays) warn_of_delay(fit, fit.models.front().delay(), range);
    fit.message =
        has_settled(fit)
            ? Message("The fit to the frequency response converged after {}: fit {} % (response at {} frequencies).",
                      iteration_count(fit), significant(fit.fit_percent[0], 4), data.w.size())
            : Message("The fit to the frequency response stopped after {}: fit {} % (response at {} frequencies).",
                      iteration_count(fit), significant(fit.fit_percent[0], 4), data.w.size());
    return fit;
}

Fit frequency_lssvf(const FrequencyData& data, const TransferStructure& structure, const SvfOptions& options) {
    options.validate();
    check_carx("lssvf", structure);
    check_fit("lssvf", data, structure);
    const Index n = pole_count(structure), m = zero_count(structure), d = n + m + 1;
    const EquationLines lines = equation_lines(data, structure.channels.front().delay);
    const double unit = frequency_time_unit(data);
    const ComplexVector shifted = lines.s.array() + options.lambda * unit;
    const Vector sizes = shifted.cwiseAbs().array().pow(static_cast<double>(n));
    const Vector coefficients = equation_solution(lines, sizes, n, m);

    const FrequencyOutput scaled(data, structure, coefficients);
    const Vector F = monic(coefficients.head(n));
    Eigen::MatrixXcd regressors(lines.s.size(), d);
    ComplexVector error(lines.s.size());  // of each equation, that one of the response makes
    for (Index k = 0; k < lines.s.size(); ++k) {
        const double weight = lines.weights[k] / sizes[k];
        for (Index i = 0; i < n; ++i)
            regressors(k, i) = -weight * lines.response[k] * std::pow(lines.s[k], static_cast<double>(n - 1 - i));
        for (Index j = 0; j <= m; ++j) regressors(k, n + j) = weight * std::pow(lines.s[k], static_cast<double>(m - j));
        // without hold and delay the lines are turned, and scaled as their weights are not
        const Complex turned = lines.weights[k] * lines.response[k] / data.response[k];
        error[k] = turned * evaluate(F, lines.s[k]) / sizes[k];
    }
    Matrix rows(2 * lines.s.size(), d);
    rows << regressors.real(), regressors.imag();
    const LeastSquares equations = solve_least_squares(rows, Vector::Zero(rows.rows()));
    const Vector sizes_of_errors = error.cwiseAbs().cwiseQuotient(response_weights(data).head(error.size()));
    Vector spread(rows.rows());
    spread << sizes_of_errors, sizes_of_errors;
    const Matrix terms = spread.asDiagonal() * rows * equations.inverse_gram;

    Fit fit;
    fit.structure = structure;
    fit.theta = scaled.seconds().cwiseProduct(coefficients);
    const ComplexVector model =
        response_between_samples(structure.models(fit.theta).front(), data.w, data.Ts, data.inter_sample);
    fit.loss = response_weights(data).cwiseAbs2().dot((data.response - model).cwiseAbs2()) /
               static_cast<double>(2 * data.w.size());
    fit.noise_variance = Vector::Constant(
        1, fit.loss * static_cast<double>(2 * data.w.size()) / static_cast<double>(2 * data.w.size() - d));
    fit.condition_number = equations.condition_number;
    fit.covariance = scaled.seconds().asDiagonal() * (terms.transpose() * terms) * scaled.seconds().asDiagonal();
    if (has_realization_variance(data)) {
        Matrix changes(d, data.realized.cols());
        Vector errors(rows.rows());
        for (Index j = 0; j < changes.cols(); ++j) {
            const ComplexVector own = error.cwiseProduct((data.realized.col(j) - data.response).head(error.size()));
            errors << own.real(), own.imag();
            changes.col(j) = scaled.seconds().cwiseProduct(equations.inverse_gram * (rows.transpose() * errors));
        }
        fit.covariance = covariance_with_distortion(data, fit.covariance, changes);
    }
    if (data.variance.size() == 0) fit.covariance *= fit.noise_variance[0], fit.loss *= 2, fit.noise_variance *= 2;
    describe(fit, data);
    warn_of_cutoff(fit, options.lambda);
    fit.message = Message("Least squares on the filtered frequency response: fit {} % (response at {} frequencies).",
                          significant(fit.fit_percent[0], 4), data.w.size());
    return fit;
}

}  // namespace dynlab::inline numerics
