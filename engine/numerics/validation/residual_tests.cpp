#include "numerics/validation/residual_tests.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/statistics/distributions.h"
#include "numerics/statistics/lagged_sums.h"
#include "numerics/validation/prediction.h"

namespace dynlab::inline numerics {

namespace {

// What is tested.
using ErrorKind = ModelError;

using Signals = std::vector<Vector>;  // one channel, an entry per experiment

Vector centered(const VectorView& x) {
    return x.array() - x.mean();
}

Signals centered_column(const std::vector<Matrix>& signals, Index column) {
    Signals all;
    for (const Matrix& x : signals) all.push_back(centered(x.col(column)));
    return all;
}

Index longest(const Signals& signals) {
    Index max_samples = 0;
    for (const Vector& x : signals) max_samples = std::max(max_samples, x.size());
    return max_samples;
}

// R_e at lags -reach..reach, and g(h) = sum_k R_e(k) R_u(k + h), h = 0..lags.
struct ProductCovariances {
    Vector Re, g;
};

// Bartlett weights extend over a quarter of the data: g is positive by construction, and as exact as the
// autocorrelations allow.
ProductCovariances product_covariances(const Signals& e, const Signals& u, Index lags) {
    const Index reach = longest(e) / 4;
    ProductCovariances product{{}, Vector(lags + 1)};
    Vector Ru;
    tbb::parallel_invoke([&] { product.Re = lagged_covariances(e, e, reach); },
                         [&] { Ru = lagged_covariances(u, u, reach + lags); });
    for (Index k = -reach; k <= reach; ++k)
        product.Re[reach + k] *= 1 - static_cast<double>(std::abs(k)) / static_cast<double>(reach + 1);
    for (Index h = 0; h <= lags; ++h) product.g[h] = product.Re.dot(Ru.segment(lags + h, 2 * reach + 1));
    return product;
}

Signals backwards(const Signals& signals) {
    Signals all;
    for (const Vector& x : signals) all.push_back(x.reverse());
    return all;
}

struct QuadraticForm {
    double statistic = 0;
    Index degrees = 0;
    double p_value = 1;
};

// N r' P^-1 r in the directions that the input excites by more than one sample's power, r from N samples in one or
// several experiments.
QuadraticForm quadratic_form(const Vector& r, const Matrix& P, double N, double experiment_count) {
    const auto [values, vectors] = symmetric_eigen(P);
    const Vector along = vectors.transpose() * r;
    QuadraticForm form;
    for (Index i = 0; i < r.size(); ++i) {
        if (values[i] <= P.diagonal().maxCoeff() / N) continue;
        form.statistic += N * along[i] * along[i] / values[i];
        ++form.degrees;
    }
    form.p_value =
        explained_part_upper_tail(form.statistic / N, static_cast<double>(form.degrees), N - experiment_count);
    return form;
}

Message lag_text(Index lag, const IdData& data) {
    if (!data.regular()) return Message("lag {}", lag);
    const Message time = Message("{}\u202F{}", significant(static_cast<double>(lag) * data.Ts, 3), data.time_unit);
    return Message("lag {}, {}", lag, time);
}

// The lag from 0 on at which the error goes most with the input.
Index strongest_lag(const IndependenceTest& test) {
    Index lag = 0;
    test.correlation.tail((test.correlation.size() + 1) / 2).cwiseAbs().maxCoeff(&lag);
    return lag;
}

Message independence_message(const IndependenceTest& test, const IdData& data) {
    const std::string& name = data.input_names[static_cast<std::size_t>(test.input)];
    const auto probability = probability_text(test.p_value);
    if (!test.independent)
        return Message("{} is correlated with the residuals ({}; largest at {}).", name, probability,
                       lag_text(strongest_lag(test), data));
    if (!test.without_feedback)
        return Message(
            "{} is not correlated with later residuals ({}), but the residuals are correlated with later values of the "
            "input ({}): the output seems to affect the input through feedback.",
            name, probability, probability_text(test.p_value_future));
    return Message("{} is not correlated with the residuals ({}).", name, probability);
}

// An input, its covariances at lags 0 and on, and those with the error at lags of both signs.
struct TestedInput {
    Signals u;
    Vector own, with_error;
};

// Of all inputs, and R, the covariances of e at lags 0 and on: about two dozen passes over the data each, in parallel.
std::vector<TestedInput> tested_inputs(const Signals& e, const IdData& data, Index lags, Vector& R) {
    std::vector<TestedInput> inputs(static_cast<std::size_t>(data.input_count()));
    for (std::size_t j = 0; j < inputs.size(); ++j)
        for (const Experiment& experiment : data.experiments)
            inputs[j].u.push_back(centered(experiment.u.col(static_cast<Index>(j))));
    tbb::parallel_for(std::size_t{0}, 2 * inputs.size() + 1, [&](std::size_t i) {
        if (i == 0) {
            R = lagged_covariances(e, e, lags).tail(lags + 1);
            return;
        }
        TestedInput& input = inputs[(i - 1) / 2];
        if (i % 2 == 1)
            input.own = lagged_covariances(input.u, input.u, lags).tail(lags + 1);
        else
            input.with_error = lagged_covariances(e, input.u, lags);
    });
    return inputs;
}

// `variance` is that of e.
IndependenceTest test_independence(const Signals& e, double variance, const TestedInput& tested, const IdData& data,
                                   Index input, bool white, const ResidualOptions& options) {
    const Index lags = options.lags;
    const double N = total_size(e);
    IndependenceTest test;
    test.input = input;
    const double Re = variance, Ru = tested.own[0];
    if (Ru == 0) {
        test.tested = false;
        test.correlation = Vector::Zero(2 * lags + 1);
        test.verdict = Message(
            "{} never changes, so its correlation with the residuals is undefined. Use data in which it varies.",
            data.input_names[static_cast<std::size_t>(input)]);
        return test;
    }
    const Vector& r = tested.with_error;
    const auto [own_Re, g] =
        white ? ProductCovariances{Vector::Constant(1, Re), Re * tested.own} : product_covariances(e, tested.u, lags);
    test.correlation = r / std::sqrt(Re * Ru);
    test.bound = normal_half_width(options.confidence) * std::sqrt(g[0] / (N * Re * Ru));
    test.outside = (test.correlation.tail(lags + 1).cwiseAbs().array() > test.bound).count();
    const auto experiment_count = static_cast<double>(e.size());
    const QuadraticForm past =
        quadratic_form(r.tail(lags + 1), lagged_sum_covariance(g, own_Re, tested.u), N, experiment_count);
    const Matrix ahead = lagged_sum_covariance(g, own_Re, backwards(tested.u)).bottomRightCorner(lags, lags);
    test.statistic = past.statistic;
    test.degrees = past.degrees;
    test.p_value = past.p_value;
    test.p_value_future = quadratic_form(r.head(lags).reverse(), ahead, N, experiment_count).p_value;
    test.independent = test.p_value >= 1 - options.confidence;
    test.without_feedback = test.p_value_future >= 1 - options.confidence;
    test.verdict = independence_message(test, data);
    return test;
}

// The results of the tests for one output's model; the caller adds what it knows about the model.
ModelEvidence standing_of(const OutputResiduals& output, ErrorKind kind) {
    ModelEvidence model;
    model.fit_percent = output.fit_percent;
    model.white = output.whiteness.white;
    model.of_predictions = kind == ErrorKind::kPrediction;
    for (const IndependenceTest& test : output.inputs) {
        model.independent = model.independent && test.independent;
        model.tested = model.tested && test.tested;
    }
    return model;
}

OutputResiduals test_output(const std::vector<Matrix>& errors, const IdData& data, Index output, ErrorKind kind,
                            const ResidualOptions& options) {
    OutputResiduals result;
    const Signals e = centered_column(errors, output);
    const double N = total_size(e);
    double output_power = 0, squares = 0;
    for (std::size_t k = 0; k < errors.size(); ++k) {
        result.mean += errors[k].col(output).sum() / N;
        squares += errors[k].col(output).squaredNorm();
        output_power += data.experiments[k].y.col(output).squaredNorm() / N;
    }
    result.fit_percent = fit_percent_of_sums(squares, output_variations(data)[output]);
    Vector R;
    const std::vector<TestedInput> inputs = tested_inputs(e, data, options.lags, R);
    result.variance = R[0];
    const std::string& name = data.output_names[static_cast<std::size_t>(output)];
    constexpr double kRounding = 1e4 * std::numeric_limits<double>::epsilon();
    if (result.variance <= kRounding * kRounding * output_power) {
        result.exact = true;
        result.verdict = kind == ErrorKind::kOutput ? Message(
                                                          "{}: the simulated output equals the measured output to "
                                                          "within rounding error, so no residuals remain to test.",
                                                          name)
                                                    : Message(
                                                          "{}: the predicted output equals the measured output to "
                                                          "within rounding error, so no residuals remain to test.",
                                                          name);
        return result;
    }
    result.whiteness = whiteness_of_covariances(e, R, options.confidence, kind);
    std::vector<Message> messages{Message("{}: {}", name, result.whiteness.verdict)};
    for (Index j = 0; j < data.input_count(); ++j) {
        const TestedInput& tested = inputs[static_cast<std::size_t>(j)];
        result.inputs.push_back(test_independence(e, R[0], tested, data, j, result.whiteness.white, options));
        messages.push_back(result.inputs.back().verdict);
    }
    result.verdict = sentences(std::move(messages));
    return result;
}

std::vector<Matrix> output_errors(const IdData& data, std::vector<Matrix> simulated) {
    if (simulated.size() != data.experiments.size() || data.experiments.empty())
        throw InvalidArgument("The residual tests need a simulated output for each experiment ({}), but got {}",
                              plural(static_cast<Index>(data.experiments.size()), "{} experiment", "{} experiments"),
                              simulated.size());
    for (std::size_t k = 0; k < simulated.size(); ++k) {
        const Matrix& y = data.experiments[k].y;
        if (y.rows() != simulated[k].rows() || y.cols() != simulated[k].cols())
            throw InvalidArgument("The simulated output of experiment {} must be {} x {}, but is {} x {}", k + 1,
                                  y.rows(), y.cols(), simulated[k].rows(), simulated[k].cols());
        if (!simulated[k].allFinite())
            throw InvalidArgument("The simulated output is not finite everywhere: the model is unstable on these data");
        simulated[k] = y - simulated[k];
    }
    return simulated;
}

ResidualTests tests_of(const IdData& data, std::vector<Matrix> errors, ErrorKind kind, const ResidualOptions& options) {
    ResidualTests tests;
    tests.residuals = std::move(errors);
    Index max_samples = 0;
    for (const Matrix& own : tests.residuals) max_samples = std::max(max_samples, own.rows());
    if (max_samples < 2 * options.lags)
        throw InvalidArgument(
            "Tests over {} need at least {} samples in one experiment, but the longest has {}: use fewer lags",
            plural(options.lags, "{} lag", "{} lags"), 2 * options.lags, max_samples);
    for (Index i = 0; i < data.output_count(); ++i) {
        tests.outputs.push_back(test_output(tests.residuals, data, i, kind, options));
    }
    return tests;
}

// Adds the conclusion from all results to each output's text.
template <class Standing>
void conclude(ResidualTests& tests, const Standing& standing) {
    MessageList lines{{}, Join::kLines};
    for (std::size_t i = 0; i < tests.outputs.size(); ++i) {
        OutputResiduals& output = tests.outputs[i];
        if (!output.exact) output.verdict = sentences({output.verdict, model_quality_message(standing(i))});
        lines.items.push_back(output.verdict);
    }
    tests.verdict = lines.items.size() == 1 ? lines.items.front() : Message("{}", lines);
}

// Whether the error goes with this input at an instant that the channel leaves out, before its delay ends or at once.
void check_input_instants(ModelEvidence& model, const IndependenceTest& test, const TransferFunction& G,
                          const IdData& data) {
    if (test.independent || !data.regular() || !G.continuous()) return;
    const Index lag = strongest_lag(test);
    if (G.delay() > (static_cast<double>(lag) + 0.5) * data.Ts)
        model.acts_earlier = true;
    else
        model.acts_at_once = model.acts_at_once || (lag == 0 && G.zero_count() < G.pole_count());
}

constexpr double kBetterStart = 0.2;  // of what the fit lacks

// "Simulated from ... the fit is 88 % instead of 66 %", where another start than the options' explains that much more.
Message better_start(const IdData& data, const std::vector<TransferFunction>& channels,
                     const CompareOptions& simulation, std::size_t output, double fit) {
    if (simulation.initial_state == InitialState::kAuto && simulation.offset == Offset::kAuto) return {};
    const Comparison best = compare_all(data, channels, {});
    const double reached = best.fit_percent[static_cast<Index>(output)];
    if (!(reached - fit >= kBetterStart * (100 - fit))) return {};
    return Message("The assumed initial conditions are wrong: for a simulation {}, the fit is {} % instead of {} %.",
                   description(best.results[0][output].start), significant(reached, 4), significant(fit, 4));
}

}  // namespace

ResidualTests prediction_error_tests(const IdData& data, const Predictions& predictions,
                                     const ResidualOptions& options) {
    options.validate();
    std::vector<Matrix> errors;
    for (const auto& outputs : predictions.results) {
        Matrix& own = errors.emplace_back(outputs.front().errors.size(), static_cast<Index>(outputs.size()));
        for (std::size_t i = 0; i < outputs.size(); ++i) own.col(static_cast<Index>(i)) = outputs[i].errors;
        if (!own.allFinite())
            throw InvalidArgument(
                "The prediction errors are not finite everywhere: the model is unstable on these data");
    }
    ResidualTests tests = tests_of(data, std::move(errors), ErrorKind::kPrediction, options);
    conclude(tests, [&](std::size_t i) { return standing_of(tests.outputs[i], ErrorKind::kPrediction); });
    return tests;
}

ResidualTests residual_tests(const IdData& data, std::vector<Matrix> simulated, const ResidualOptions& options) {
    options.validate();
    ResidualTests tests = tests_of(data, output_errors(data, std::move(simulated)), ErrorKind::kOutput, options);
    conclude(tests, [&](std::size_t i) { return standing_of(tests.outputs[i], ErrorKind::kOutput); });
    return tests;
}

ResidualTests residual_tests(const IdData& data, const std::vector<TransferFunction>& channels,
                             const CompareOptions& simulation, const ResidualOptions& options,
                             const ModelDoubts& doubts) {
    options.validate();
    const Comparison comparison = compare_all(data, channels, simulation);
    std::vector<Matrix> simulated;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) simulated.push_back(comparison.outputs(k));
    ResidualTests tests = tests_of(data, output_errors(data, std::move(simulated)), ErrorKind::kOutput, options);
    conclude(tests, [&](std::size_t i) {
        const OutputResiduals& output = tests.outputs[i];
        ModelEvidence model = standing_of(output, ErrorKind::kOutput);
        model.doubts = doubts.about(i, data.output_names[i]);
        for (std::size_t j = 0; j < output.inputs.size(); ++j) {
            const TransferFunction& G = channels[i * output.inputs.size() + j];
            model.unstable = model.unstable || has_unstable_pole(G);
            check_input_instants(model, output.inputs[j], G, data);
        }
        if (model.tested && !(model.independent && model.white))
            model.start = better_start(data, channels, simulation, i, output.fit_percent);
        return model;
    });
    return tests;
}

}  // namespace dynlab::inline numerics
