#include "numerics/fit/transfer_refinement.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numerics/criteria/denominator_group.h"
#include "numerics/criteria/transfer_output.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/output_error.h"
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
Vector with_stable_poles(const TransferStructure& structure, Vector theta) {
    for (std::size_t d = 0; d < structure.poles.size(); ++d) {
        auto a = theta.segment(structure.denominator_start(static_cast<Index>(d)), structure.poles[d]);
        a = reflect_unstable_roots(monic(a)).tail(a.size()).eval();
    }
    return theta;
}

Vector first_point(const TransferOutput& model, const TransferStructure& structure, const Vector& theta_start) {
    const Index count = structure.parameter_count();
    Vector theta = Vector::Zero(model.parameter_count()), output;
    theta.head(count) = theta_start.cwiseQuotient(model.seconds().head(count));
    theta = theta.cwiseMax(model.lower()).cwiseMin(model.upper());
    model.simulate(theta, output, nullptr);
    if (!output.allFinite()) theta.head(count) = with_stable_poles(structure, theta.head(count));
    solve_linear_part(model, theta);
    return theta;
}

// With a held input, outputs with n - m < 2 are functions of the delay with kinks or steps at the sampling instants;
// with linear interpolation those with n = m. The starts are half an interval away on both sides of each such delay.
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
                starts.back()[structure.delay_index(output, input)] += step;
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

Fit search(TransferOutput& model, const TransferStructure& structure, const IdData& data, const Vector& start,
           const FitOptions& options) {
    Vector theta = start;
    if (options.output_weights.size() > 0) {
        model.set_weights(options.output_weights);
    } else if (structure.outputs > 1) {
        const FitOptions rough = options.limited(options.max_iterations, std::max(options.tolerance, kFirstTolerance));
        const Vector power = output_powers(data);
        set_weights(model, model.output_at(theta), power);
        for (int round = 0; round < kWeightRounds; ++round) {
            theta = minimize_output_error(model, model.target(), theta, rough).theta;
            set_weights(model, model.output_at(theta), power);
        }
    }
    return minimize_output_error(model, model.target(), starts_around(structure, data, theta), options);
}

}  // namespace

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

Vector counted_variations(TransferOutput model) {
    model.set_weights(Vector::Ones(model.weights().size()));
    const Vector y = model.target();
    Vector sums = Vector::Zero(model.weights().size());
    for (std::size_t e = 0; e < model.experiment_count(); ++e)
        for (Index o = 0; o < sums.size(); ++o) {
            const auto rows = y.segment(model.row(e, o), model.rows(e)).tail(model.counted_rows(e));
            sums[o] += (rows.array() - rows.mean()).matrix().squaredNorm();
        }
    return sums;
}

namespace {

/// With weights that were asked for: they say nothing of the errors' variances.
void set_covariance_under_weights(Fit& fit, const TransferOutput& model, double pooled_variance) {
    Vector output;
    Matrix sensitivities;
    model.simulate(fit.theta, output, &sensitivities);
    Vector variances(output.size());
    for (std::size_t e = 0; e < model.experiment_count(); ++e)
        for (Index o = 0; o < fit.noise_variance.size(); ++o)
            variances.segment(model.row(e, o), model.rows(e))
                .setConstant(std::pow(model.weights()[o], 2) * fit.noise_variance[o]);
    fit.covariance = covariance_of_unequal_rows(fit.covariance, pooled_variance, sensitivities, variances);
}

/// Of the model at the end of a search, in its own parameters.
void fill_errors(Fit& fit, const TransferOutput& model) {
    const Vector squares = squared_errors(model, model.output_at(fit.theta));
    const Vector variation = counted_variations(model);
    const double N = static_cast<double>(model.sample_count());
    fit.noise_variance.resize(squares.size());
    fit.fit_percent.resize(squares.size());
    for (Index o = 0; o < squares.size(); ++o) {
        const std::vector<bool> bears = model.bears_on(o);
        Index free = 0;
        for (std::size_t i = 0; i < bears.size(); ++i) free += bears[i] && !fit.at_bound[i] ? 1 : 0;
        fit.noise_variance[o] = squares[o] / (N - static_cast<double>(free));
        fit.fit_percent[o] = fit_percent_of_sums(squares[o], variation[o]);
    }
    // Not a number would compare with the losses of other searches as neither larger nor smaller.
    const double loss = squares.sum() / (N * static_cast<double>(squares.size()));
    fit.loss = std::isfinite(loss) ? loss : kInfinity;
}

Fit refine_jointly(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                   const Vector& theta_start, const FitOptions& options, double masked_seconds) {
    const DelayRange range = structure.free_delays ? delay_range(data, options) : DelayRange{};
    TransferOutput model(structure, condition, data, range.least, range.largest);
    if (options.stable.value_or(false)) model.keep_stable();
    model.fix(options.fixed);
    if (condition.state == InitialState::kEstimate) model.mask_start(masked_seconds);
    Fit fit = search(model, structure, data, first_point(model, structure, theta_start), options);
    const double pooled_variance = fit.noise_variance[0];
    fill_errors(fit, model);
    if (structure.outputs > 1 && options.output_weights.size() > 0) {
        fit.output_weights = options.output_weights;
        if (options.precision) set_covariance_under_weights(fit, model, pooled_variance);
    }
    keep_parameters(fit, model, condition, model.seconds());
    fit.structure = structure;
    return fit;
}

// The later of two in the order converged, no progress, iteration limit, diverged, canceled.
Termination worse(Termination a, Termination b) {
    const auto rank = [](Termination termination) {
        switch (termination) {
            case Termination::kConverged:
                return 0;
            case Termination::kNoProgress:
                return 1;
            case Termination::kIterationLimit:
                return 2;
            case Termination::kDiverged:
                return 3;
            case Termination::kCanceled:
                return 4;
        }
        return 4;
    };
    return rank(a) < rank(b) ? b : a;
}

std::vector<FitIteration> joined_trace(Index parameters, const std::vector<OutputProblem>& problems,
                                       const std::vector<Fit>& estimates) {
    std::size_t length = 0;
    for (const Fit& estimate : estimates) length = std::max(length, estimate.trace.size());
    std::vector<FitIteration> trace(length);
    for (std::size_t k = 0; k < length; ++k) {
        trace[k].theta.resize(parameters);
        for (std::size_t i = 0; i < estimates.size(); ++i) {
            const auto& own = estimates[i].trace;
            const bool empty = own.empty();
            const std::size_t position = std::min(k, empty ? 0 : own.size() - 1);
            trace[k].theta(problems[i].places) = empty ? estimates[i].theta : own[position].theta;
            trace[k].loss += (empty ? estimates[i].loss : own[position].loss) / static_cast<double>(estimates.size());
            if (k < own.size()) trace[k].change = std::max(trace[k].change, own[k].change);
        }
    }
    return trace;
}

}  // namespace

bool outputs_are_separate(const TransferStructure& structure) {
    for (Index output = 1; output < structure.outputs; ++output)
        for (Index input = 0; input < structure.inputs; ++input)
            for (Index i = 0; i < output * structure.inputs; ++i)
                if (structure.channels[static_cast<std::size_t>(i)].denominator ==
                    structure.channel(output, input).denominator)
                    return false;
    return true;
}

OutputProblem output_problem(const IdData& data, const TransferStructure& structure, Index output) {
    std::vector<Index> inputs(static_cast<std::size_t>(structure.inputs));
    std::iota(inputs.begin(), inputs.end(), Index{1});
    OutputProblem problem{data.select({output + 1}, inputs), {}, {}};
    TransferStructure& own = problem.structure;
    own.inputs = structure.inputs;
    own.free_delays = structure.free_delays;
    std::vector<Index> denominators;  // of the whole structure, in the order of the own ones
    for (Index input = 0; input < structure.inputs; ++input) {
        TransferChannel channel = structure.channel(output, input);
        auto known = std::find(denominators.begin(), denominators.end(), channel.denominator);
        if (known == denominators.end()) {
            own.poles.push_back(structure.poles[static_cast<std::size_t>(channel.denominator)]);
            known = denominators.insert(known, channel.denominator);
        }
        channel.denominator = known - denominators.begin();
        own.channels.push_back(channel);
    }
    problem.places.resize(static_cast<std::size_t>(own.parameter_count()));
    const auto place = [&](Index here, Index there, Index count) {
        std::iota(problem.places.begin() + here, problem.places.begin() + here + count, there);
    };
    for (std::size_t d = 0; d < denominators.size(); ++d)
        place(own.denominator_start(static_cast<Index>(d)), structure.denominator_start(denominators[d]), own.poles[d]);
    for (Index input = 0; input < structure.inputs; ++input)
        place(own.numerator_start(0, input), structure.numerator_start(output, input),
              own.channel(0, input).zeros + 1 + (own.free_delays ? 1 : 0));
    return problem;
}

Fit join_outputs(const TransferStructure& structure, const std::vector<OutputProblem>& problems,
                 const std::vector<Fit>& estimates) {
    const Index count = structure.parameter_count(), outputs = structure.outputs;
    Fit all;
    all.structure = structure;
    all.names = structure.parameter_names();
    all.theta.resize(count);
    all.covariance = Matrix::Zero(count, count);
    all.noise_variance.resize(outputs);
    all.fit_percent.resize(outputs);
    all.start = estimates.front().start;
    all.initial_values.resize(estimates.front().initial_values.size());
    all.offsets.resize(estimates.front().offsets.rows(), outputs);
    all.termination = Termination::kConverged;
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        const Fit& one = estimates[i];
        const auto& places = problems[i].places;
        const Index output = static_cast<Index>(i);
        all.theta(places) = one.theta;
        all.covariance(places, places) = one.covariance;
        all.noise_variance[output] = one.noise_variance[0];
        all.fit_percent[output] = one.fit_percent[0];
        all.offsets.col(output) = one.offsets.col(0);
        for (std::size_t e = 0; e < one.initial_values.size(); ++e) {
            Vector joined(all.initial_values[e].size() + one.initial_values[e].size());
            joined << all.initial_values[e], one.initial_values[e];
            all.initial_values[e] = joined;
        }
        all.loss += one.loss / static_cast<double>(outputs);
        all.condition_number = std::max(all.condition_number, one.condition_number);
        all.termination = worse(all.termination, one.termination);
    }
    all.models = structure.models(all.theta);
    all.trace = joined_trace(count, problems, estimates);
    return all;
}

void keep_parameters(Fit& fit, const TransferOutput& model, const StartCondition& condition, const Vector& seconds) {
    const Index linear = model.linear_count(), own = fit.theta.size() - linear;
    const Index before = model.parameter_count() - fit.theta.size();  // other parameters than the model's are fewer
    const Vector all = fit.theta.cwiseProduct(seconds), units = seconds.head(own);
    fit.theta = all.head(own);
    fit.covariance = (units.asDiagonal() * fit.covariance.topLeftCorner(own, own) * units.asDiagonal()).eval();
    for (FitIteration& iteration : fit.trace) iteration.theta = iteration.theta.head(own).cwiseProduct(units).eval();
    fit.start = condition;
    fit.offsets = Matrix::Zero(static_cast<Index>(model.experiment_count()), model.weights().size());
    fit.initial_values.clear();
    for (std::size_t e = 0; e < model.experiment_count(); ++e) {
        const Index first = model.initial_start(e, 0), next = model.initial_start(e + 1, 0);
        if (condition.state == InitialState::kEstimate)
            fit.initial_values.emplace_back(all.segment(first - before, next - first));
        for (Index o = 0; o < fit.offsets.cols() && condition.offset; ++o)
            fit.offsets(static_cast<Index>(e), o) = all[model.offset_index(e, o) - before];
    }
}

Vector search_point(const Fit& fit, const TransferOutput& model, const Vector& seconds) {
    const Index before = model.parameter_count() - seconds.size();
    Vector theta = Vector::Zero(seconds.size());
    theta.head(fit.theta.size()) = fit.theta;
    for (std::size_t e = 0; e < fit.initial_values.size(); ++e)
        theta.segment(model.initial_start(e, 0) - before, fit.initial_values[e].size()) = fit.initial_values[e];
    for (std::size_t e = 0; e < model.experiment_count() && model.has_offset(); ++e)
        for (Index o = 0; o < fit.offsets.cols(); ++o)
            theta[model.offset_index(e, o) - before] = fit.offsets(static_cast<Index>(e), o);
    return theta.cwiseQuotient(seconds);
}

namespace {

Fit refine_each_output(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                       const Vector& theta_start, const FitOptions& options, double masked_seconds) {
    std::vector<OutputProblem> problems;
    std::vector<Fit> estimates;
    FitOptions alone = options;
    alone.output_weights.resize(0);  // decide nothing between outputs that share nothing
    for (Index output = 0; output < structure.outputs; ++output) {
        problems.push_back(output_problem(data, structure, output));
        const OutputProblem& problem = problems.back();
        estimates.push_back(refine_jointly(problem.data, problem.structure, condition, theta_start(problem.places),
                                           alone, masked_seconds));
    }
    return join_outputs(structure, problems, estimates);
}

}  // namespace

double masked_start(const StartCondition& start, double delay, const IdData& data) {
    const bool unknown = start.state == InitialState::kEstimate && delay > 0;
    return unknown && delay < shortest_experiment(data) / 2 ? delay + data.mean_step() : 0;
}

double masked_start(const Fit& fit, const IdData& data) {
    double longest = 0;
    for (const TransferFunction& G : fit.models) longest = std::max(longest, G.delay());
    return masked_start(fit.start, longest, data);
}

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

Message output_error_message(const Fit& fit) {
    return has_settled(fit) ? Message("The output-error search converged after {} for a simulation {}: {}.",
                                      iteration_count(fit), description(fit.start), simulation_text(fit))
                            : Message("The output-error search stopped after {} for a simulation {}: {}.",
                                      iteration_count(fit), description(fit.start), simulation_text(fit));
}

Fit refine_output_error(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                        const Vector& theta_start, const FitOptions& options, double masked_seconds) {
    check_transfer_data("Output error", data, structure, condition.offset ? Offset::kEstimate : options.offset);
    if (theta_start.size() != structure.parameter_count())
        throw InvalidArgument("The number of initial values must be {}, but is {}", structure.parameter_count(),
                              theta_start.size());
    const Index values = value_count(structure, condition, static_cast<Index>(data.experiments.size()));
    check_sample_count("Output error", data.sample_count() * structure.outputs, values);
    Fit estimate = structure.outputs > 1 && options.fixed.empty() && outputs_are_separate(structure)
                       ? refine_each_output(data, structure, condition, theta_start, options, masked_seconds)
                       : refine_jointly(data, structure, condition, theta_start, options, masked_seconds);
    const DelayRange range = structure.free_delays ? delay_range(data, options) : DelayRange{};
    describe_search(estimate, data, options, range);
    estimate.message = output_error_message(estimate);
    return estimate;
}

}  // namespace dynlab::inline numerics
