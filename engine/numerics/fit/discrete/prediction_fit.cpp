#include "numerics/fit/discrete/prediction_fit.h"

#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/output_error.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kPredictionRounding = 1e-24;  // of the output's mean square: smaller errors hold no noise

constexpr Index kStartSamples = 100000;  // of each experiment, on which starts are refined and compared

/// The experiments up to so many samples.
std::vector<SampledExperiment> first_samples(const std::vector<SampledExperiment>& experiments) {
    std::vector<SampledExperiment> brief;
    for (const SampledExperiment& one : experiments) {
        const Index count = std::min(kStartSamples, one.y.size());
        brief.push_back({one.u.topRows(count), one.y.head(count)});
    }
    return brief;
}

/// For long data: one start instead of many, the best one of the beginning, provided that it predicts all samples
/// better than all others.
std::vector<Vector> promising_starts(const PredictionModel& model, const StartCondition& condition,
                                     std::vector<Vector> starts, const FitOptions& options) {
    if (model.target().size() < 4 * kStartSamples) return starts;
    const std::vector<SampledExperiment> experiments = first_samples(model.experiments());
    const PredictionModel brief(model.orders(), condition, experiments);
    const Index d = model.orders().parameter_count();
    std::vector<Vector> own;
    for (const Vector& start : starts) own.push_back(brief.completed(start.head(d)));
    const Vector found = minimize_output_error(brief, brief.target(), own, options).theta;
    if (!found.allFinite()) return starts;
    const Vector whole = model.completed(found.head(d)), y = model.target();
    const double squares = model.products(whole, y).squares;
    for (const Vector& start : starts)
        if (!(squares <= model.products(start, y).squares)) return starts;
    return {whole};
}

/// Sum of squares about the mean of each experiment.
double variation_of(const Vector& y, const std::vector<Index>& lengths) {
    double sum = 0;
    Index first = 0;
    for (const Index length : lengths) {
        if (length == 0) continue;
        const auto part = y.segment(first, length);
        sum += (part.array() - part.mean()).square().sum();
        first += length;
    }
    return sum;
}

}  // namespace

double output_power(const IdData& data) {
    double squares = 0;
    for (const Experiment& experiment : data.experiments) squares += experiment.y.squaredNorm();
    return squares / static_cast<double>(data.sample_count() * data.output_count());
}

ArmaNoise start_noise(const std::vector<Vector>& errors, int nc, int nd, double output_power) {
    double squares = 0;
    Index count = 0;
    for (const Vector& data_set : errors) {
        squares += data_set.squaredNorm();
        count += data_set.size();
    }
    if (squares <= kPredictionRounding * output_power * static_cast<double>(count)) return ArmaNoise::white(nc, nd);
    std::vector<Vector> beginnings;
    for (const Vector& data_set : errors) beginnings.push_back(data_set.head(std::min(kStartSamples, data_set.size())));
    return estimate_arma(beginnings, nc, nd, 1e-3);
}

std::optional<UndeterminedRoot> undetermined_root(char letter, const Vector& p, Index samples) {
    const double few = letter == 'C' ? 64 : 32;  // a zero near the circle also forgets the unknown past slowly
    const double largest = p.tail(p.size() - 1).any() ? roots(p).cwiseAbs().maxCoeff() : 0;
    if (!((1 - largest) * static_cast<double>(samples) < few)) return std::nullopt;
    UndeterminedRoot found;
    for (Index i = 1; i < p.size(); ++i)
        found.names.push_back(std::string(1, letter == 'C' ? 'c' : 'd') + std::to_string(i));
    found.warning = Message(
        "A root of {} is so close to the unit circle (magnitude {}) that {} samples do not determine its distance from "
        "the circle. The standard errors of {} are not available.",
        std::string(1, letter), significant(largest, 4), samples, listed(found.names));
    return found;
}

Fit fit_prediction(const std::string& method, const PredictionModel& model, const StartCondition& start, double Ts,
                   const std::vector<Vector>& starts, const FitOptions& options) {
    const Vector y = model.target();
    if (y.size() <= model.parameter_count())
        throw InvalidArgument(
            "{} estimates {} and needs more samples than that, but only {} samples have all required past values. Use "
            "more data or lower orders",
            method, plural(model.parameter_count(), "{} value", "{} values"), y.size());
    std::vector<Vector> complete;
    for (const Vector& values : starts) complete.push_back(model.completed(values));
    complete = promising_starts(model, start, std::move(complete), options);
    Fit fit = minimize_output_error(model, y, complete, options);
    const Vector theta = fit.theta;
    make_polynomial(fit, model.orders(), Ts);
    const std::vector<Index> lengths = model.lengths();
    const double variation = variation_of(y, lengths);
    fit.prediction_fit_percent = fit_percent_of_sums(static_cast<double>(y.size()) * fit.loss, variation);
    fit.fit_percent = Vector::Constant(1, fit_percent_of_sums((y - model.simulated(theta)).squaredNorm(), variation));
    fit.start = start;
    fit.offsets = Matrix::Zero(static_cast<Index>(lengths.size()), 1);
    for (std::size_t e = 0; e < lengths.size() && start.offset; ++e)
        fit.offsets(static_cast<Index>(e), 0) = theta[model.offset_index(e)];
    warn_of_search(fit, options);
    for (const char letter : {'C', 'D'}) {
        const Vector& p = letter == 'C' ? fit.polynomial->C : fit.polynomial->D;
        if (const auto root = undetermined_root(letter, p, y.size())) {
            withdraw_errors(fit, root->names);
            fit.warnings.push_back(root->warning);
            if (letter == 'C' && model.orders().na > 0)  // the unknown errors before the data affect all
                fit.warnings.push_back(
                    Message("The standard errors of the other coefficients are up to 20 % too small."));
        }
    }
    warn_of_doubtful_parameters(fit);
    warn_of_unstable_polynomials(fit);
    const Number predicting = significant(fit.prediction_fit_percent, 4),
                 simulating = significant(fit.fit_percent[0], 4);
    fit.message = has_settled(fit)
                      ? Message("The search converged after {}: fit {} % for one-step prediction, {} % for simulation.",
                                iteration_count(fit), predicting, simulating)
                      : Message("The search stopped after {}: fit {} % for one-step prediction, {} % for simulation.",
                                iteration_count(fit), predicting, simulating);
    return fit;
}

}  // namespace dynlab::inline numerics
