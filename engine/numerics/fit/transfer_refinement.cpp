#include "numerics/fit/transfer_refinement.h"

#include <algorithm>
#include <cmath>

#include "numerics/criteria/denominator_group.h"
#include "numerics/criteria/transfer_output.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/transfer_split.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kWeightRounds = 2;
constexpr double kFirstTolerance = 1e-3;
constexpr double kLeastRelativeError = 1e-6;  // of the output's own size: smaller errors count as rounding

// Per output: the sum of squared errors without the weights.
Vector squared_errors(const TransferOutput& model, const Vector& output) {
    const Vector errors = model.target() - output;
    Vector sums = Vector::Zero(model.weights().size());
    for (std::size_t e = 0; e < model.experiment_count(); ++e)
        for (Index o = 0; o < sums.size(); ++o)
            sums[o] += errors.segment(model.row(e, o), model.rows(e)).squaredNorm() / std::pow(model.weights()[o], 2);
    return sums;
}

// Every denominator with its unstable poles mirrored.
Vector stabilised(const TransferStructure& structure, Vector theta) {
    for (std::size_t d = 0; d < structure.poles.size(); ++d) {
        auto a = theta.segment(structure.a_place(static_cast<Index>(d)), structure.poles[d]);
        a = reflect_unstable_roots(monic(a)).tail(a.size()).eval();
    }
    return theta;
}

// The initial values and offsets that suit the other parameters best, by least squares.
void solve_linear_part(const TransferOutput& model, Vector& theta) {
    const Index count = model.linear_count();
    theta.tail(count).setZero();
    if (count == 0) return;
    Vector output;
    Matrix sensitivities;
    model.simulate(theta, output, &sensitivities);
    if (!output.allFinite()) return;
    const LeastSquares fit = solve_least_squares(sensitivities.rightCols(count), model.target() - output);
    if (fit.solution.allFinite()) theta.tail(count) = fit.solution;
}

Vector first_point(const TransferOutput& model, const TransferStructure& structure, const Vector& theta_start) {
    const Index count = structure.parameter_count();
    Vector theta = Vector::Zero(model.parameter_count()), output;
    theta.head(count) = theta_start.cwiseQuotient(model.seconds().head(count));
    theta = theta.cwiseMax(model.lower()).cwiseMin(model.upper());
    model.simulate(theta, output, nullptr);
    if (!output.allFinite()) theta.head(count) = stabilised(structure, theta.head(count));
    solve_linear_part(model, theta);
    return theta;
}

// A held input makes outputs with n - m < 2 kinked or stepped functions of the delay, sampling instant by sampling
// instant, straight lines those with n = m: points half an interval away on both sides of each such delay.
std::vector<Vector> starts_around(const TransferStructure& structure, const IdData& data, const Vector& theta) {
    std::vector<Vector> starts = {theta};
    if (!structure.free_delays) return starts;
    const int smooth = data.hold == Hold::kZoh ? 2 : 1;
    for (Index output = 0; output < structure.outputs; ++output)
        for (Index input = 0; input < structure.inputs; ++input) {
            const TransferChannel& channel = structure.channel(output, input);
            if (structure.poles[static_cast<std::size_t>(channel.denominator)] - channel.zeros >= smooth) continue;
            for (const double step : {-0.5, 0.5}) {
                starts.push_back(theta);
                starts.back()[structure.delay_place(output, input)] += step;
            }
        }
    return starts;
}

void set_weights(TransferOutput& model, const Vector& output, const Vector& power) {
    const double N = static_cast<double>(model.sample_count());
    const Vector errors =
        (squared_errors(model, output) / N).cwiseSqrt().cwiseMax(kLeastRelativeError * power.cwiseSqrt());
    if (errors.allFinite()) model.set_weights(errors.cwiseInverse());
}

OutputErrorSolution search(TransferOutput& model, const TransferStructure& structure, const IdData& data,
                           const Vector& start, const FitOptions& options) {
    OutputErrorOptions search_options{options.max_iterations, options.tolerance, options.cancel};
    Vector theta = start;
    if (structure.outputs > 1) {
        const OutputErrorOptions rough{options.max_iterations, std::max(options.tolerance, kFirstTolerance),
                                       options.cancel};
        const Vector power = output_powers(data);
        Vector output;
        model.simulate(theta, output, nullptr);
        set_weights(model, output, power);
        for (int round = 0; round < kWeightRounds; ++round) {
            const OutputErrorSolution solution = minimise_output_error(model, model.target(), theta, rough);
            theta = solution.theta;
            set_weights(model, solution.output, power);
        }
    }
    const std::vector<Vector> starts = starts_around(structure, data, theta);
    if (starts.size() == 1) return minimise_output_error(model, model.target(), theta, search_options);
    return minimise_output_error(model, model.target(), starts, search_options);
}

void fill_errors(Fit& estimate, const TransferOutput& model, const IdData& data, const OutputErrorSolution& solution) {
    const Vector squares = squared_errors(model, solution.output), variation = output_variations(data);
    const double N = static_cast<double>(model.sample_count());
    estimate.noise_variance.resize(squares.size());
    estimate.fit_percent.resize(squares.size());
    for (Index o = 0; o < squares.size(); ++o) {
        const std::vector<bool> bears = model.bears_on(o);
        Index free = 0;
        for (std::size_t i = 0; i < bears.size(); ++i) free += bears[i] && !solution.at_bound[i] ? 1 : 0;
        estimate.noise_variance[o] = squares[o] / (N - static_cast<double>(free));
        estimate.fit_percent[o] = fit_percent_of_sums(squares[o], variation[o]);
    }
    estimate.loss = squares.sum() / (N * static_cast<double>(squares.size()));
}

void fill_start(Fit& estimate, const TransferOutput& model, const StartCondition& condition, const Vector& theta) {
    const Index experiments = static_cast<Index>(model.experiment_count()), outputs = estimate.structure.outputs;
    estimate.start = condition;
    estimate.offsets = Matrix::Zero(experiments, outputs);
    for (Index e = 0; e < experiments; ++e) {
        const std::size_t experiment = static_cast<std::size_t>(e);
        if (condition.state == InitialState::kEstimate) {
            const Index first = model.initial_place(experiment, 0), next = model.initial_place(experiment + 1, 0);
            estimate.initial_values.push_back(theta.segment(first, next - first));
        }
        for (Index o = 0; o < outputs && condition.offset; ++o)
            estimate.offsets(e, o) = theta[model.offset_place(experiment, o)];
    }
}

Fit refine_jointly(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                   const Vector& theta_start, const FitOptions& options) {
    const DelayRange range = structure.free_delays ? delay_range(data, options) : DelayRange{};
    TransferOutput model(structure, condition, data, range.least, range.largest);
    const OutputErrorSolution solution =
        search(model, structure, data, first_point(model, structure, theta_start), options);
    const Index count = structure.parameter_count();
    const Vector all = solution.theta.cwiseProduct(model.seconds()), seconds = model.seconds().head(count);
    Fit estimate;
    estimate.structure = structure;
    estimate.names = structure.parameter_names();
    estimate.theta = all.head(count);
    estimate.models = structure.models(estimate.theta);
    estimate.covariance = seconds.asDiagonal() * solution.covariance.topLeftCorner(count, count) * seconds.asDiagonal();
    estimate.condition_number = solution.condition_number;
    fill_errors(estimate, model, data, solution);
    fill_start(estimate, model, condition, all);
    estimate.termination = solution.termination;
    for (const FitIteration& iteration : solution.trace)
        estimate.trace.push_back({iteration.theta.head(count).cwiseProduct(seconds), iteration.loss, iteration.change});
    return estimate;
}

Fit refine_each_output(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                       const Vector& theta_start, const FitOptions& options) {
    std::vector<OutputProblem> problems;
    std::vector<Fit> estimates;
    for (Index output = 0; output < structure.outputs; ++output) {
        problems.push_back(output_problem(data, structure, output));
        const OutputProblem& problem = problems.back();
        estimates.push_back(
            refine_jointly(problem.data, problem.structure, condition, theta_start(problem.places), options));
    }
    return join_outputs(structure, problems, estimates);
}

}  // namespace

Index value_count(const TransferStructure& structure, const StartCondition& condition, Index experiments) {
    Index values = condition.offset ? structure.outputs : 0;
    if (condition.state == InitialState::kEstimate)
        for (Index output = 0; output < structure.outputs; ++output)
            for (Index input = 0; input < structure.inputs; ++input) {
                const Index denominator = structure.channel(output, input).denominator;
                bool known = false;
                for (Index before = 0; before < input; ++before)
                    known = known || structure.channel(output, before).denominator == denominator;
                if (!known) values += structure.poles[static_cast<std::size_t>(denominator)];
            }
    return structure.parameter_count() + experiments * values;
}

double bic_of(const Fit& estimate, const IdData& data) {
    const Index N = data.sample_count(), experiments = static_cast<Index>(data.experiments.size());
    const Vector variation = output_variations(data), power = output_powers(data);
    Index values = value_count(estimate.structure, estimate.start, experiments);
    double sum = 0;
    for (Index output = 0; output < data.output_count(); ++output) {
        const double share = 1 - estimate.fit_percent[output] / 100;
        sum += bic_of_loss(share * share * variation[output] / static_cast<double>(N), power[output], N, values);
        values = 0;  // counted once
    }
    return sum;
}

Fit refine_output_error(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                        const Vector& theta_start, const FitOptions& options) {
    check_transfer_data("Output error", data, structure);
    if (theta_start.size() != structure.parameter_count())
        throw InvalidArgument("The search needs " + std::to_string(structure.parameter_count()) +
                              " start values, and " + std::to_string(theta_start.size()) + " were given");
    const Index values = value_count(structure, condition, static_cast<Index>(data.experiments.size()));
    check_sample_count("Output error", data.sample_count() * structure.outputs, values);
    Fit estimate = structure.outputs > 1 && outputs_are_separate(structure)
                       ? refine_each_output(data, structure, condition, theta_start, options)
                       : refine_jointly(data, structure, condition, theta_start, options);
    const DelayRange range = structure.free_delays ? delay_range(data, options) : DelayRange{};
    describe_search(estimate, data, "Output error", options, range);
    return estimate;
}

}  // namespace dynlab::inline numerics
