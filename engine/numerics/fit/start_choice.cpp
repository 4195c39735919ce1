#include "numerics/fit/start_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "numerics/criteria/discrete_output.h"
#include "numerics/criteria/transfer_output.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/linalg/tall_gram.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kLookAheadSamples = 3000;  // samples
constexpr double kLostFit = 5;             // per cent, of a difference equation: too far away to look ahead from
constexpr double kStartRidge = 1e-9;       // of a sum of squares of sensitivities
constexpr double kStartEvidence = 2;       // of BIC
constexpr double kWorthATry = 100;         // of BIC, with all samples: then a fit decides what follows from its errors
constexpr double kLargestNeighbors = 0.999;
constexpr double kLowerStart = 1e-3;                                             // of the loss
constexpr double kStartRounding = 1e3 * std::numeric_limits<double>::epsilon();  // of the output: what is no error

using Columns = std::vector<Index>;

Columns columns_from(Index first, Index count) {
    Columns places(static_cast<std::size_t>(count));
    std::iota(places.begin(), places.end(), first);
    return places;
}

Columns both(const Columns& one, const Columns& other) {
    Columns all = one;
    all.insert(all.end(), other.begin(), other.end());
    return all;
}

/// Of errors from one sample to the next, between 0 and 1.
double neighbors_correlation(const Vector& errors, const std::vector<Index>& lengths) {
    double products = 0;
    Index first = 0;
    for (const Index length : lengths) {
        if (length > 1) products += errors.segment(first, length - 1).dot(errors.segment(first + 1, length - 1));
        first += length;
    }
    const double squares = errors.squaredNorm();
    return squares > 0 ? std::clamp(products / squares, 0.0, kLargestNeighbors) : 0;
}

double independent_samples(double samples, double correlation) {
    return std::max(2.0, samples * (1 - correlation) / (1 + correlation));
}

/// Sums of squares below `least` are rounding.
double start_evidence(double squares, double better, double least, double samples, Index values) {
    return samples * std::log(std::max(squares, least) / std::max(better, least)) -
           static_cast<double>(values) * std::log(samples);
}

double least_squares_of(const Vector& y) {
    return std::max(kStartRounding * kStartRounding * y.squaredNorm(), std::numeric_limits<double>::min());
}

/// Parameters among the columns of J, and what may come to them.
struct LinearModel {
    Matrix J;
    Vector errors;
    double least;                ///< sum of squares that is rounding
    std::vector<Index> lengths;  ///< of the experiments whose rows are stacked
    Columns own, motions, constants;
};

/// What one Gauss-Newton step gains with further values.
class StartLookAhead {
  public:
    /// Computes the scaled sums of products of the model's J and errors.
    explicit StartLookAhead(LinearModel model) : model_(std::move(model)) {
        const Index d = model_.J.cols();
        const Matrix sums = tall_gram(model_.J, model_.errors);
        squares_ = sums(d, d);
        descent_ = sums.col(d).head(d);
        scale_ = sums.diagonal().head(d).cwiseSqrt();
        for (double& value : scale_)
            if (!(value > 0)) value = 1;
        const auto scaling = scale_.cwiseInverse().asDiagonal();
        gram_ = scaling * sums.topLeftCorner(d, d) * scaling;
        gram_.diagonal().array() += kStartRidge;
        descent_ = scaling * descent_;
        usable_ = gram_.allFinite() && descent_.allFinite() && std::isfinite(squares_);
        if (usable_) own_gain_ = gain_of(model_.own);
    }

    bool usable() const { return usable_; }
    bool promises(bool may_start, bool may_offset) const {
        const Columns &motions = model_.motions, &constants = model_.constants;
        return (may_offset && promises(constants)) || (may_start && promises(motions)) ||
               (may_start && may_offset && promises(both(constants, motions)));
    }

  private:
    Vector step(const Columns& places) const { return solve_semidefinite(gram_(places, places), descent_(places)); }
    double gain_of(const Columns& places) const { return std::max(0.0, descent_(places).dot(step(places))); }

    bool promises(const Columns& more) const {
        const Columns all = both(model_.own, more);
        return counts(squares_ - own_gain_, squares_ - gain_of(all), all, static_cast<Index>(more.size()));
    }

    /// The errors that the step leaves are looked at only where it gains enough were they white, but not very much: far
    /// from the best fit one step leaves errors that say little.
    bool counts(double before, double after, const Columns& places, Index values) const {
        const auto samples = static_cast<double>(model_.errors.size());
        const double least = model_.least;
        const double at_most = start_evidence(before, after, least, samples, values);
        if (!(at_most > kStartEvidence) || at_most > kWorthATry) return at_most > kWorthATry;
        const Vector left =
            model_.errors - model_.J(Eigen::all, places) * step(places).cwiseQuotient(scale_(places)).matrix();
        const double r = neighbors_correlation(left, model_.lengths);
        return start_evidence(before, after, least, independent_samples(samples, r), values) > kStartEvidence;
    }

    LinearModel model_;
    double squares_ = 0, own_gain_ = 0;
    Matrix gram_;
    Vector descent_, scale_;
    bool usable_ = false;
};

bool may_start(const FitOptions& options) {
    return options.initial_state == InitialState::kAuto;
}
bool may_offset(const FitOptions& options) {
    return options.offset == Offset::kAuto;
}

std::vector<Index> lengths_of(const TransferOutput& model) {
    std::vector<Index> lengths;
    for (std::size_t e = 0; e < model.experiment_count(); ++e) lengths.push_back(model.rows(e));
    return lengths;
}

/// J, errors and what is rounding of them.
void set_errors(LinearModel& linear, const OutputErrorModel& model, const Vector& theta, const Vector& y) {
    model.simulate(theta, linear.errors, &linear.J);
    linear.errors = y - linear.errors;
    linear.least = least_squares_of(y);
}

/// Of one output.
bool output_promises(const IdData& data, const TransferStructure& structure, const Vector& theta,
                     const FitOptions& options) {
    const IdData part = data.sample_count() > kLookAheadSamples ? beginning_of(data, kLookAheadSamples) : IdData();
    const IdData& data_set = data.sample_count() > kLookAheadSamples ? part : data;
    // Nothing rests at the first input here, so that the free motions are added to a start from rest.
    const TransferOutput model(structure, {InitialState::kEstimate, true}, data_set, 0, shortest_experiment(data_set),
                               TransferOutput::AtRest::kNothing);
    const Index own = structure.parameter_count();
    Vector point = Vector::Zero(model.parameter_count());
    point.head(own) = theta.cwiseQuotient(model.seconds().head(own));
    LinearModel linear;
    set_errors(linear, model, point, model.target());
    linear.lengths = lengths_of(model);
    linear.own = columns_from(0, own);
    for (Index input = 0; input < structure.inputs && structure.free_delays; ++input)
        if (!(point[structure.delay_index(0, input)] > 0)) std::erase(linear.own, structure.delay_index(0, input));
    linear.motions = columns_from(model.initial_start(0, 0), model.offset_index(0, 0) - model.initial_start(0, 0));
    linear.constants = columns_from(model.offset_index(0, 0), model.parameter_count() - model.offset_index(0, 0));
    const StartLookAhead ahead(std::move(linear));
    return !ahead.usable() || ahead.promises(may_start(options), may_offset(options));
}

bool is_from_rest(const Fit& fit) {
    return fit.start.state == InitialState::kZero && !fit.start.offset;
}

/// The errors of a fit without those of the first seconds, which do not count.
struct CountedErrors {
    CountedErrors(const IdData& data, const Fit& fit, double masked_seconds)
        : model(fit.structure, fit.start, data, 0, shortest_experiment(data)) {
        model.mask_start(masked_seconds);
        errors = model.target() - model.output_at(search_point(fit, model, model.seconds()));
    }
    TransferOutput model;
    Vector errors;
};

/// Whether BIC still prefers the fit with another start when errors that follow each other count as fewer.
bool convinces(const IdData& data, const Fit& from_rest, const Fit& other) {
    if (other.structure.outputs > 1) return true;
    const double masked_seconds = masked_start(other, data);
    const CountedErrors rest(data, from_rest, masked_seconds), found(data, other, masked_seconds);
    if (!found.errors.allFinite()) return false;
    if (!rest.errors.allFinite()) return true;
    const double r = neighbors_correlation(found.errors, lengths_of(found.model));
    const Index values = found.model.parameter_count() - rest.model.parameter_count();
    return start_evidence(rest.errors.squaredNorm(), found.errors.squaredNorm(), least_squares_of(found.model.target()),
                          independent_samples(static_cast<double>(found.model.sample_count()), r),
                          values) > kStartEvidence;
}

}  // namespace

bool start_is_open(const FitOptions& options) {
    const bool rests = may_start(options) || options.initial_state == InitialState::kZero;
    const bool plain = may_offset(options) || options.offset == Offset::kNone;
    return rests && plain && (may_start(options) || may_offset(options));
}

bool other_start_promises(const IdData& data, const Fit& from_rest, const FitOptions& options) {
    if (from_rest.structure.outputs == 1)
        return !(from_rest.fit_percent[0] > 0) || output_promises(data, from_rest.structure, from_rest.theta, options);
    for (Index output = 0; output < from_rest.structure.outputs; ++output) {
        const OutputProblem problem = output_problem(data, from_rest.structure, output);
        if (!(from_rest.fit_percent[output] > 0) ||
            output_promises(problem.data, problem.structure, from_rest.theta(problem.places), options))
            return true;
    }
    return false;
}

Fit with_chosen_start(const IdData& data, const FitOptions& options, const StartTrials& trials) {
    if (!start_is_open(options)) return trials.among_all(options);
    const FitOptions plain = options.from_rest();
    Fit rest;
    try {
        rest = trials.first(plain);
    } catch (const InvalidArgument&) {
        return trials.among_all(options);  // a constant input whose output does not start from rest
    }
    const auto canceled = [](const Fit& fit) { return fit.termination == Termination::kCanceled; };
    if (canceled(rest)) return rest;
    bool finished = false;
    const auto finish = [&] {
        if (!finished) rest = trials.finish(std::move(rest), plain);
        finished = true;
    };
    if (!other_start_promises(data, rest, options)) {
        const double before = rest.loss;
        finish();
        if (rest.loss == before || canceled(rest) || !other_start_promises(data, rest, options)) return rest;
    }
    Fit other = trials.among_all(options);
    if (canceled(other) || (!is_from_rest(other) && convinces(data, rest, other))) return other;
    finish();
    return is_from_rest(other) && other.loss < (1 - kLowerStart) * rest.loss ? other : rest;
}

Fit best_predicting_start(Fit fit, const FitOptions& options, const std::function<Fit(const FitOptions&)>& fit_with) {
    constexpr double kDrifts = 0.95;  // largest root of D
    const Vector& D = fit.noise ? fit.noise->D : fit.polynomial->D;
    if (!may_start(options) || !may_offset(options) || !D.tail(D.size() - 1).any() ||
        roots(D).cwiseAbs().maxCoeff() < kDrifts)
        return fit;
    const StartCondition first = fit.start;
    for (const StartCondition& other :
         {StartCondition{InitialState::kZero, false}, StartCondition{InitialState::kEstimate, true}}) {
        if (fit.termination == Termination::kCanceled) break;
        if (other.state == first.state && other.offset == first.offset) continue;
        Fit next = fit_with(options.started(other));
        if (next.noise_variance[0] < fit.noise_variance[0]) fit = std::move(next);
    }
    return fit;
}

bool other_discrete_start_promises(const IdData& data, const Fit& from_rest, const FitOptions& options) {
    if (!(from_rest.fit_percent[0] > kLostFit)) return true;
    const IdData part = data.sample_count() > kLookAheadSamples ? beginning_of(data, kLookAheadSamples) : IdData();
    const IdData& data_set = data.sample_count() > kLookAheadSamples ? part : data;
    const std::vector<SampledExperiment> experiments = sampled_experiments(data_set);
    const DiscreteOutput model(*from_rest.orders, {InitialState::kEstimate, true}, experiments);
    const Index own = from_rest.theta.size();
    if (model.target().size() <= 2 * model.parameter_count()) return true;
    Vector theta = Vector::Zero(model.parameter_count());
    theta.head(own) = from_rest.theta;
    LinearModel linear;
    set_errors(linear, model, theta, model.target());
    linear.lengths = {linear.errors.size()};
    linear.own = columns_from(0, own);
    linear.motions = columns_from(own, model.offset_index(0) - own);
    linear.constants = columns_from(model.offset_index(0), model.parameter_count() - model.offset_index(0));
    const StartLookAhead ahead(std::move(linear));
    return !ahead.usable() || ahead.promises(may_start(options), may_offset(options));
}

}  // namespace dynlab::inline numerics
