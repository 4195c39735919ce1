#include "numerics/validation/prediction.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/fit/discrete/arma_noise.h"
#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/discrete/prediction_model.h"
#include "numerics/fit/operating_points.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

bool is_one(const Vector& p) {
    return p.tail(p.size() - 1).isZero(0);
}

void check_sampling(const IdData& data, double Ts) {
    constexpr double kRounding = 1e-9;
    if (Ts == 0 || std::abs(data.Ts - Ts) <= kRounding * Ts) return;
    throw InvalidArgument(
        "The sampling time of the model and its noise is {} s, but the sampling time of the data is {} s. The sampling "
        "times must be equal",
        Ts, data.Ts);
}

void check_regular(const IdData& data) {
    if (!data.regular())
        throw InvalidArgument(
            "The noise model is discrete-time, but the data are sampled irregularly: interpolate them at equally "
            "spaced instants first (interp1)");
}

void check_output_varies(const IdData& data) {
    const auto constant = [](const Experiment& e) { return (e.y.col(0).array() == e.y(0, 0)).all(); };
    if (std::ranges::all_of(data.experiments, constant))
        throw InvalidArgument(
            "The measured output never changes, so a relative fit is undefined. Use data in which the output varies");
}

void check_invertible(const Vector& C, const Vector& D) {
    for (const auto& [name, p] : {std::pair{"C", C}, std::pair{"D", D}})
        if (!inside_unit_circle(p))
            throw InvalidArgument(
                "The polynomial {} of the noise model has a root on or outside the unit circle, so the white noise "
                "cannot be computed from the data",
                name);
}

/// sum_{i < steps} h_i e(k - i)
Vector unforeseen(const Vector& errors, const Vector& h) {
    Vector sum = Vector::Zero(errors.size());
    Index terms = std::min(h.size(), errors.size());
    const double rounding = 1e-18 * h.head(terms).cwiseAbs().maxCoeff();
    while (terms > 1 && std::abs(h[terms - 1]) <= rounding) --terms;  // all there is of them over many steps
    for (Index i = 0; i < terms; ++i)
        if (h[i] != 0) sum.tail(errors.size() - i) += h[i] * errors.head(errors.size() - i);
    return sum;
}

/// One output: what is known of it before its fit.
struct OutputSignals {
    std::vector<Vector> measured, simulated, errors;  // N each; simulated: before `first` the measured ones
    std::vector<Index> first;
};

/// Adds one output to the predictions.
void add_output(Predictions& all, const OutputSignals& output_signals, const NoisyModel& model,
                const std::optional<Index>& steps) {
    double squares = 0, variation = 0, error_squares = 0, count = 0;
    for (std::size_t k = 0; k < output_signals.measured.size(); ++k) {
        const Vector& y = output_signals.measured[k];
        const Index first = output_signals.first[k], rows = y.size() - first;
        PredictedOutput own{output_signals.simulated[k], output_signals.errors[k], first, 0};
        if (steps && *steps < y.size() && model.has_noise_model())
            own.output = y - unforeseen(own.errors, noise_impulse_response(model, *steps));
        const double own_squares = (y - own.output).tail(rows).squaredNorm();
        const double own_variation = (y.tail(rows).array() - y.tail(rows).mean()).matrix().squaredNorm();
        own.fit_percent = fit_percent_of_sums(own_squares, own_variation);
        squares += own_squares;
        variation += own_variation;
        error_squares += own.errors.squaredNorm();
        count += static_cast<double>(rows);
        all.results[k].push_back(std::move(own));
    }
    const Index place = all.fit_percent.size();
    all.fit_percent.conservativeResize(place + 1);
    all.loss.conservativeResize(place + 1);
    all.fit_percent[place] = fit_percent_of_sums(squares, variation);
    all.loss[place] = error_squares / count;
}

/// A difference equation under one start condition, all experiments one after the other.
struct StartedPrediction {
    StartCondition condition;
    std::vector<Index> lengths;  // of the experiments' ends that are predicted
    Vector errors, simulated;
    Index values = 0;  // estimated ones

    StartedPrediction(const OrderedParameters& model, const StartCondition& start,
                      const std::vector<SampledExperiment>& experiments)
        : condition(start) {
        const PredictionModel predictor(model.orders, start, experiments);
        lengths = predictor.lengths();
        values = predictor.linear_count();
        if (*std::min_element(lengths.begin(), lengths.end()) < 1 || predictor.target().size() <= values) return;
        const Vector theta = predictor.completed(model.theta);
        predictor.simulate(theta, errors, nullptr);
        errors = predictor.target() - errors;
        simulated = predictor.simulated(theta);
    }
    bool possible() const { return errors.size() > 0; }
    /// Of the errors at the ends, `counts` samples of each experiment.
    double bic(const std::vector<Index>& counts, double power) const {
        double squares = 0;
        Index end = 0, samples = 0;
        for (std::size_t k = 0; k < lengths.size(); ++k) {
            end += lengths[k];
            squares += errors.segment(end - counts[k], counts[k]).squaredNorm();
            samples += counts[k];
        }
        return bic_of_loss(squares / static_cast<double>(samples), power, samples, values);
    }
};

std::vector<StartCondition> conditions_of(const IdData& data, const PolynomialOrders& orders,
                                          const CompareOptions& options) {
    CompareOptions requested = options;
    if (orders.na > 0 && requested.initial_state == InitialState::kAuto)
        requested.initial_state = InitialState::kEstimate;
    if (orders.na > 0 && requested.offset == Offset::kAuto) requested.offset = Offset::kNone;
    return start_conditions(data, requested.initial_state, requested.offset);
}

StartedPrediction best_start(const IdData& data, const OrderedParameters& model, const CompareOptions& options) {
    const std::vector<SampledExperiment> experiments = sampled_experiments(data);
    std::vector<StartedPrediction> candidates;
    for (const StartCondition& condition : conditions_of(data, model.orders, options)) {
        StartedPrediction candidate(model, condition, experiments);
        if (candidate.possible()) candidates.push_back(std::move(candidate));
    }
    if (candidates.empty())
        throw InvalidArgument(
            "The data have too few samples for a prediction: the number of past samples before the first predicted "
            "sample is {}. The prediction also needs more samples than estimated values. Use more data",
            model.orders.past());
    std::vector<Index> common = candidates.front().lengths;
    for (const StartedPrediction& candidate : candidates)
        for (std::size_t k = 0; k < common.size(); ++k) common[k] = std::min(common[k], candidate.lengths[k]);
    double power = 0;
    for (const Experiment& experiment : data.experiments) power += experiment.y.squaredNorm();
    power /= static_cast<double>(data.sample_count());
    const auto better = [&](const StartedPrediction& a, const StartedPrediction& b) {
        return a.bic(common, power) < b.bic(common, power);
    };
    return *std::min_element(candidates.begin(), candidates.end(), better);
}

Message sentence(const Predictions& all, const NoisyModel& model, const std::optional<Index>& steps,
                 const StartCondition& start) {
    const Number fit = significant(all.fit_percent[0], 4);
    if (!steps || !model.has_noise_model()) return Message("Simulated {}: fit {} %.", description(start), fit);
    return plural(*steps, "Predicted {} step ahead {}: fit {} %.", "Predicted {} steps ahead {}: fit {} %.",
                  description(start), fit);
}

/// Predictions without their output, one empty row for each experiment.
Predictions without_results(const IdData& data) {
    Predictions all;
    all.results.resize(data.experiments.size());
    return all;
}

Predictions predict_difference_equation(const IdData& data, const NoisyModel& model, const PredictionOptions& options) {
    const OrderedParameters ordered = ordered_parameters(*model.polynomial);
    if (static_cast<std::size_t>(data.input_count()) != ordered.orders.inputs())
        throw InvalidArgument(plural(static_cast<Index>(ordered.orders.inputs()),
                                     "The model has {} input, but the data have {}: select the input of the model",
                                     "The model has {} inputs, but the data have {}: select the inputs of the model",
                                     data.input_count()));
    check_polynomial_channels("The prediction", data, ordered.orders);
    check_output_varies(data);
    check_regular(data);
    check_sampling(data, model.polynomial->Ts);
    check_invertible(model.polynomial->C, model.polynomial->D);
    const CenteredData centered = centered_for(data, options.start.offset);
    const StartedPrediction best = best_start(centered.data, ordered, options.start);
    OutputSignals output_signals;
    Index place = 0;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const Vector y = data.experiments[k].y.col(0);
        const Index rows = best.lengths[k];
        const double level = centered.removed.empty() ? 0 : centered.removed[k].front().output;
        Vector errors = Vector::Zero(y.size()), simulated = y;
        errors.tail(rows) = best.errors.segment(place, rows);
        simulated.tail(rows) = best.simulated.segment(place, rows).array() + level;
        place += rows;
        output_signals.measured.push_back(y);
        output_signals.errors.push_back(std::move(errors));
        output_signals.simulated.push_back(std::move(simulated));
        output_signals.first.push_back(y.size() - rows);
    }
    Predictions all = without_results(data);
    add_output(all, output_signals, model, options.steps);
    all.message = sentence(all, model, options.steps, best.condition);
    return all;
}

Predictions predict_from_simulation(const IdData& data, const NoisyModel& model, const PredictionOptions& options) {
    const bool noisy = model.has_noise_model();
    if (noisy) {
        check_regular(data);
        check_sampling(data, model.noise_Ts);
        check_invertible(model.C, model.D);
        if (data.output_count() != 1)
            throw InvalidArgument("A noise model has one output, but the data have {}: select one",
                                  data.output_count());
    }
    const Comparison comparison = compare_all(data, model.channels, options.start);
    const ArmaNoise noise{model.C, model.D, {}};
    Predictions all = without_results(data);
    for (Index i = 0; i < data.output_count(); ++i) {
        OutputSignals output_signals;
        for (std::size_t k = 0; k < data.experiments.size(); ++k) {
            const Vector y = data.experiments[k].y.col(i);
            const Vector& simulated = comparison.results[k][static_cast<std::size_t>(i)].output;
            output_signals.measured.push_back(y);
            output_signals.simulated.push_back(simulated);
            output_signals.errors.push_back(whitened(noise, y - simulated));
            output_signals.first.push_back(std::min(model.D.size() - 1, y.size() - 1));
        }
        add_output(all, output_signals, model, options.steps);
    }
    all.message = sentence(all, model, options.steps, comparison.results.front().front().start);
    return all;
}

}  // namespace

bool NoisyModel::has_noise_model() const {
    if (polynomial) return !is_one(polynomial->A) || !is_one(polynomial->C) || !is_one(polynomial->D);
    return !is_one(C) || !is_one(D);
}

ColoredNoise noise_of(const NoisyModel& model) {
    if (!model.polynomial) return {model.C, model.D};
    return {model.polynomial->C, multiply(model.polynomial->A, model.polynomial->D)};
}

Vector noise_impulse_response(const NoisyModel& model, Index count) {
    const auto [num, den] = noise_of(model);
    Vector h = Vector::Zero(count);
    h.head(std::min(count, num.size())) = num.head(std::min(count, num.size()));
    for (Index k = 1; k < count; ++k)
        for (Index i = 1; i < std::min(den.size(), k + 1); ++i) h[k] -= den[i] * h[k - i];
    return h;
}

OrderedParameters ordered_parameters(const PolynomialModel& model) {
    const auto order = [](const Vector& p) { return static_cast<int>(p.size()) - 1; };
    OrderedParameters result;
    PolynomialOrders& orders = result.orders;
    orders.na = order(model.A);
    orders.nc = order(model.C);
    orders.nd = order(model.D);
    for (std::size_t i = 0; i < model.B.size(); ++i) {
        const Vector& B = model.B[i];
        Index late = 0;
        while (late < B.size() - 1 && B[late] == 0) ++late;
        orders.nk.push_back(static_cast<int>(late));
        orders.nb.push_back(static_cast<int>(B.size() - late));
        orders.nf.push_back(order(model.F[i]));
    }
    result.theta.resize(orders.parameter_count());
    result.theta.head(orders.na) = model.A.tail(orders.na);
    for (std::size_t i = 0; i < model.B.size(); ++i) {
        result.theta.segment(orders.f_start(i), orders.nf[i]) = model.F[i].tail(orders.nf[i]);
        result.theta.segment(orders.b_start(i), orders.nb[i]) = model.B[i].tail(orders.nb[i]);
    }
    result.theta.segment(orders.c_start(), orders.nc) = model.C.tail(orders.nc);
    result.theta.segment(orders.d_start(), orders.nd) = model.D.tail(orders.nd);
    return result;
}

Matrix Predictions::outputs(std::size_t experiment) const {
    const auto& row = results[experiment];
    Matrix all(row.front().output.size(), static_cast<Index>(row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) all.col(static_cast<Index>(i)) = row[i].output;
    return all;
}

Matrix Predictions::output_errors(const IdData& data, std::size_t experiment) const {
    return data.experiments[experiment].y - outputs(experiment);
}

Predictions predict(const IdData& data, const NoisyModel& model, const PredictionOptions& options) {
    if (options.steps && *options.steps < 1)
        throw InvalidArgument("The prediction horizon must be at least 1 step, but {} was given", *options.steps);
    return model.polynomial && model.has_noise_model() ? predict_difference_equation(data, model, options)
                                                       : predict_from_simulation(data, model, options);
}

}  // namespace dynlab::inline numerics
