#include "numerics/estimators/grey_box/greyest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "numerics/criteria/grey_output.h"
#include "numerics/error.h"
#include "numerics/estimators/grey_box/missed_initial_state.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/output_error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/simulation/sensitivity_solver.h"
#include "numerics/statistics/distributions.h"
#include "numerics/statistics/identifiability.h"

namespace dynlab::inline numerics {
namespace {

constexpr int kFollowedIterations = 15, kStartsOfLost = 5;  // the latter are followed from the beginning of the data
constexpr double kFollowedTolerance = 1e-3;
constexpr int kWeightings = 20;           // of the outputs, at most
constexpr double kSettledWeights = 1e-4;  // of their ratios
constexpr double kMinError = 1e-12;       // of an output's errors beside what it varies, for its weight
constexpr double kConfidence = 0.95;
constexpr double kLost = 1e-4, kFollows = 0.5;  // of the variation, left over, and its lag-one correlation: far away
constexpr double kFirstShare = 1 / 16., kGrowth = 1.5, kSame = 1e-3;  // of the samples; of what is left: ends agree

/// Values between 0 and 1 that fill the space evenly (Halton 1960): the i-th, in the dimension of this prime.
double halton(int i, int prime) {
    double value = 0, share = 1;
    for (; i > 0; i /= prime) {
        share /= prime;
        value += share * (i % prime);
    }
    return value;
}

constexpr std::array kPrimes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};

/// Between both bounds where there are two, otherwise up to three times larger or smaller than the start.
double spread_value(const GreyParameter& p, double share) {
    if (std::isfinite(p.lower) && std::isfinite(p.upper)) {
        if (p.lower > 0 && p.upper > 10 * p.lower) return p.lower * std::pow(p.upper / p.lower, share);
        return p.lower + share * (p.upper - p.lower);
    }
    return std::clamp(p.start == 0 ? 2 * share - 1 : p.start * std::pow(9, share - 0.5), p.lower, p.upper);
}

Vector named_start(const GreyModel& model, const std::map<std::string, double>& values) {
    Vector start = model.start();
    for (const auto& [name, value] : values) {
        const auto found = std::ranges::find(model.parameters, name, &GreyParameter::name);
        if (found == model.parameters.end())
            throw InvalidArgument("greyest: the option {} contains the parameter {}, which the model does not have",
                                  OptionName{"starts"}, name);
        if (!(value >= found->lower && value <= found->upper))
            throw InvalidArgument("greyest: the option {} contains {} = {}, which is not between the bounds {} and {}",
                                  OptionName{"starts"}, name, value, found->lower, found->upper);
        start[found - model.parameters.begin()] = value;
    }
    return start;
}

std::vector<Vector> starts_of(const GreyModel& model, const GreyOptions& options, int count) {
    std::vector<Vector> starts = {model.start()};
    for (const auto& values : options.further_starts) starts.push_back(named_start(model, values));
    for (int i = 1; i < count; ++i) {
        Vector start = model.start();
        for (std::size_t k = 0; k < model.parameters.size(); ++k)
            if (const GreyParameter& p = model.parameters[k]; !p.fixed)
                start[static_cast<Index>(k)] = spread_value(p, halton(i, kPrimes[k % kPrimes.size()]));
        starts.push_back(std::move(start));
    }
    return starts;
}

struct Problem {
    const IdData& data;
    const GreyModel& model;
    const GreyOptions& options;
    std::optional<Matrix> initial;

    GreyOutput criterion(const Vector& start, const Vector& weights) const {
        return GreyOutput(data, model, start, initial, weights, options.relative_tolerance);
    }
    FitOptions search_options() const {
        FitOptions search;
        search.max_iterations = options.max_iterations;
        search.tolerance = options.tolerance;
        search.cancel = options.cancel;
        return search;
    }
};

/// One over the standard deviation of each column about its mean, of all experiments.
Vector weights_of_spread(const IdData& data) {
    const double N = static_cast<double>(data.sample_count());
    Vector weights(data.output_count());
    const Vector variations = output_variations(data), powers = output_powers(data);
    for (Index i = 0; i < weights.size(); ++i) {
        const double power = variations[i] > 0 ? variations[i] / N : powers[i];
        weights[i] = power > 0 ? 1 / std::sqrt(power) : 1;
    }
    return weights;
}

/// The sum of squares of each output's errors, without weights.
Vector squares_of_outputs(const GreyOutput& criterion, const Vector& theta, const IdData& data) {
    Vector squares = Vector::Zero(data.output_count());
    const std::vector<GreyTrajectory> runs = criterion.trajectories(theta, false);
    for (std::size_t k = 0; k < runs.size(); ++k)
        squares += (data.experiments[k].y - runs[k].y).colwise().squaredNorm().transpose();
    return squares;
}

/// Of each output's errors: its share of the values that were searched.
double residual_degrees(const Fit& end, const IdData& data) {
    const double held = static_cast<double>(std::ranges::count(end.at_bound, true));
    return static_cast<double>(data.sample_count()) -
           (static_cast<double>(end.theta.size()) - held) / static_cast<double>(data.output_count());
}

Fit minimize(const GreyOutput& criterion, const Vector& start, const FitOptions& search) {
    if (criterion.parameter_count() > 0) return minimize_output_error(criterion, criterion.measured(), start, search);
    Fit fit;  // everything is fixed
    fit.theta = start;
    fit.loss = (criterion.measured() - criterion.output_at(start)).squaredNorm() /
               static_cast<double>(criterion.measured().size());
    return fit;
}

/// A start of the search: all parameters, and theta of the criterion.
struct Beginning {
    Vector parameters, theta;
    std::vector<FitIteration> trace;
};

Beginning best_start(const Problem& problem, const Vector& weights) {
    const std::vector<Vector> starts = starts_of(problem.model, problem.options, problem.options.starts);
    const FitOptions search = problem.search_options();
    const FitOptions rough = search.rough(std::min(kFollowedIterations, search.max_iterations),
                                          std::max(kFollowedTolerance, search.tolerance));
    Beginning best;
    double smallest = kInfinity;
    for (const Vector& start : starts) {
        const GreyOutput criterion = problem.criterion(start, weights);
        const bool first = &start == &starts.front();
        if (first) criterion.trajectories(criterion.start(), false);  // throws if the model's start fails
        if (starts.size() == 1) return {start, criterion.start(), {}};
        const Fit trial = minimize(criterion, criterion.start(), rough);
        if (first || trial.loss < smallest) {
            smallest = std::isfinite(trial.loss) ? trial.loss : kInfinity;
            best = {criterion.parameters(trial.theta), trial.theta, trial.trace};
        }
        if (trial.termination == Termination::kCanceled) break;
    }
    return best;
}

struct SearchEnd {
    Fit fit;
    Vector weights;
};

/// The search for these weights, then for those that its errors say, until they settle.
SearchEnd search(const Problem& problem, const Beginning& from, Vector weights) {
    const bool reweighted = problem.options.output_weights.size() == 0 && problem.data.output_count() > 1;
    const Vector least = kMinError * weights_of_spread(problem.data).cwiseInverse();
    SearchEnd end;
    Vector theta = from.theta;
    std::vector<FitIteration> trace = from.trace;
    for (int pass = 0; pass < (reweighted ? kWeightings : 1); ++pass) {
        const GreyOutput criterion = problem.criterion(from.parameters, weights);
        end = {minimize(criterion, theta, problem.search_options()), weights};
        trace.insert(trace.end(), end.fit.trace.begin(), end.fit.trace.end());
        theta = end.fit.theta;
        if (!reweighted || end.fit.termination == Termination::kCanceled) break;
        const Vector squares = squares_of_outputs(criterion, theta, problem.data);
        const Vector next =
            (squares / static_cast<double>(problem.data.sample_count())).cwiseSqrt().cwiseMax(least).cwiseInverse();
        const Vector ratios = next.cwiseQuotient(weights);
        weights = next;
        if (ratios.maxCoeff() <= (1 + kSettledWeights) * ratios.minCoeff()) break;
    }
    end.fit.trace = std::move(trace);
    return end;
}

/// theta fitted to longer and longer beginnings of the data, over which a model far away does not lose the phase.
Vector grown(const Problem& problem, const Vector& start, const Vector& weights) {
    Vector theta = problem.criterion(start, weights).start();
    const FitOptions rough = problem.search_options().rough(kFollowedIterations, kFollowedTolerance);
    const double mean_length =
        static_cast<double>(problem.data.sample_count()) / static_cast<double>(problem.data.experiments.size());
    for (double length = kFirstShare * mean_length; length < mean_length; length *= kGrowth) {
        const IdData part = beginning_of(problem.data, static_cast<Index>(length));
        if (part.sample_count() * part.output_count() <= 2 * theta.size()) continue;
        const Problem beginning{part, problem.model, problem.options, problem.initial};
        theta = minimize(beginning.criterion(start, weights), theta, rough).theta;
    }
    return theta;
}

/// The end, or where it leaves much a better one from fits to beginnings, from several starts until two ends agree.
SearchEnd or_grown(const Problem& problem, SearchEnd end, const Vector& weights) {
    const GreyOutput criterion = problem.criterion(problem.model.start(), weights);
    const double lost = kLost * output_variations(problem.data).dot(weights.cwiseAbs2());
    const auto errors = [&](const Fit& of) -> Vector { return criterion.measured() - criterion.output_at(of.theta); };
    for (const Vector& start : starts_of(problem.model, problem.options, kStartsOfLost)) {
        const Vector e = errors(end.fit);
        const double before = e.squaredNorm();
        if (before <= lost || e.head(e.size() - 1).dot(e.tail(e.size() - 1)) <= kFollows * before) break;
        if (end.fit.theta.size() == 0 || end.fit.termination == Termination::kCanceled) break;
        try {
            SearchEnd other = search(problem, {start, grown(problem, start, weights), {}}, weights);
            const double after = errors(other.fit).squaredNorm();
            if (!(after >= before)) end = std::move(other);
            if (std::abs(after - before) < kSame * before) break;
        } catch (const InvalidArgument&) {
        }  // the simulation breaks down
    }
    return end;
}

std::vector<std::string> search_names(const GreyModel& model, const GreyOutput& criterion) {
    std::vector<std::string> names;
    for (const Index i : model.free_parameters()) names.push_back(model.parameters[static_cast<std::size_t>(i)].name);
    const auto experiments = criterion.estimated_states().empty()
                                 ? Index{0}
                                 : (criterion.parameter_count() - criterion.free_count()) /
                                       static_cast<Index>(criterion.estimated_states().size());
    for (Index k = 0; k < experiments; ++k)
        for (const Index state : criterion.estimated_states())
            names.push_back(model.state_names[static_cast<std::size_t>(state)] + "(0)" +
                            (experiments > 1 ? " of experiment " + std::to_string(k + 1) : ""));
    return names;
}

/// Checks which parameters the sensitivities at the end determine.
void look_at_sensitivities(GreyFit& result, const GreyOutput& criterion, const Fit& end) {
    if (criterion.parameter_count() == 0) return;
    Vector output;
    Matrix J;
    criterion.simulate(end.theta, output, &J);
    std::vector<Index> active;
    std::vector<std::string> names;
    const std::vector<std::string> all = search_names(result.model, criterion);
    for (Index i = 0; i < J.cols(); ++i) {
        if (end.at_bound[static_cast<std::size_t>(i)]) continue;
        active.push_back(i);
        names.push_back(all[static_cast<std::size_t>(i)]);
    }
    if (active.empty() || !J.allFinite()) return;
    const Vector y = criterion.measured();
    const Matrix own = J(Eigen::all, active);
    Vector lengths = own.colwise().norm();
    for (double& length : lengths)
        if (!(length > 0)) length = 1;
    result.singular_values = singular_values(triangular_part(own * lengths.cwiseInverse().asDiagonal()));
    const Ambiguity found = find_ambiguity(own, names, end.theta(active), (y.array() - y.mean()).matrix().norm());
    for (const Message& sentence : found.sentences) result.fit.warnings.push_back(sentence);
    for (std::size_t k = 0; k < active.size(); ++k)
        if (found.parameters[k]) result.fit.covariance(active[k], active[k]) = kInfinity;
}

/// With weights that were asked for: they say nothing of the errors' variances.
void set_weights_asked_for(Fit& fit, const GreyOutput& criterion, const IdData& data, const Vector& weights) {
    if (weights.size() < 2) return;
    fit.output_weights = weights;
    if (fit.theta.size() == 0) return;
    Vector output, squares = squares_of_outputs(criterion, fit.theta, data);
    Matrix J;
    criterion.simulate(fit.theta, output, &J);
    Vector variances(output.size());
    Index first = 0;
    for (const Experiment& experiment : data.experiments)
        for (Index o = 0; o < weights.size(); ++o, first += experiment.y.rows())
            variances.segment(first, experiment.y.rows())
                .setConstant(std::pow(weights[o], 2) * squares[o] / residual_degrees(fit, data));
    fit.covariance = covariance_of_unequal_rows(fit.covariance, fit.noise_variance[0], J, variances);
}

void warn_of_bounds(Fit& fit, const GreyModel& model, const std::vector<Index>& free, const Fit& end) {
    for (std::size_t q = 0; q < free.size(); ++q) {
        if (!end.at_bound[q]) continue;
        const GreyParameter& p = model.parameters[static_cast<std::size_t>(free[q])];
        fit.warnings.push_back(
            Message("The parameter {} ended at its bound {}. It has no standard error, and the other standard errors "
                    "treat this parameter as known.",
                    p.name, end.theta[static_cast<Index>(q)]));
    }
}

/// Converts the parameters from the search's order to the model's, which includes fixed parameters.
void set_parameters(GreyFit& result, const GreyOutput& criterion, const Fit& end) {
    Fit& fit = result.fit;
    const std::vector<Index> free = result.model.free_parameters();
    const auto d = static_cast<Index>(result.model.parameters.size());
    fit.theta = criterion.parameters(end.theta);
    const Matrix searched = std::move(fit.covariance);
    fit.covariance = Matrix::Zero(d, d);
    fit.at_bound.assign(static_cast<std::size_t>(d), false);
    for (std::size_t q = 0; q < free.size(); ++q) {
        fit.at_bound[static_cast<std::size_t>(free[q])] = end.at_bound[q];
        for (std::size_t r = 0; r < free.size(); ++r)
            fit.covariance(free[q], free[r]) = searched(static_cast<Index>(q), static_cast<Index>(r));
    }
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    for (GreyParameter& p : result.model.parameters) {
        fit.names.push_back(p.name);
        p.start = fit.theta[static_cast<Index>(fit.names.size()) - 1];
    }
    result.initial_states = criterion.initial_states(end.theta);
    result.initial_std = Matrix::Zero(result.initial_states.rows(), result.initial_states.cols());
    Index next = criterion.free_count();
    for (Index k = 0; k < result.initial_std.cols(); ++k)
        for (const Index state : criterion.estimated_states()) {
            result.initial_std(state, k) = std::sqrt(std::max(0., searched(next, next)));
            ++next;
        }
}

void set_measures(GreyFit& result, const GreyOutput& criterion, const Fit& end, const IdData& data) {
    Fit& fit = result.fit;
    const double N = static_cast<double>(data.sample_count()), ny = static_cast<double>(data.output_count());
    Vector squares = Vector::Zero(data.output_count());
    std::vector<double> rough;
    for (GreyTrajectory& run : criterion.trajectories(end.theta, false)) {
        squares += (data.experiments[result.outputs.size()].y - run.y).colwise().squaredNorm().transpose();
        result.outputs.push_back(std::move(run.y));
        result.states.push_back(std::move(run.states));
        // At its first sample a state that begins at zero has no size yet that its errors could be small beside.
        const double begin = data.time(result.outputs.size() - 1)[0];
        for (const double t : run.rough_times)
            if (t > begin) rough.push_back(t);
    }
    fit.noise_variance = squares / residual_degrees(end, data);
    fit.loss = squares.sum() / (N * ny);
    fit.fit_percent = squares.binaryExpr(output_variations(data), &fit_percent_of_sums);
    const double reach =
        student_t_quantile(0.5 + kConfidence / 2, std::floor(N * ny) - static_cast<double>(end.theta.size()));
    result.intervals.resize(fit.theta.size(), 2);
    result.intervals << fit.theta - reach * fit.std, fit.theta + reach * fit.std;
    if (!rough.empty())
        fit.warnings.push_back(
            Message("At t = {}, no integration step was small enough, because the equations are discontinuous. Use "
                    "smooth equations, such as tanh(v/small) instead of sign(v).",
                    rough.front()));
}

void check_outputs(const IdData& data) {
    const Vector variations = output_variations(data);
    for (Index i = 0; i < variations.size(); ++i)
        if (variations[i] == 0)
            throw InvalidArgument("greyest: output {} never changes. Use data in which this output varies",
                                  data.output_names[static_cast<std::size_t>(i)]);
}

GreyModel with_start(GreyModel model, GreyStart start) {
    if (start != GreyStart::kModel)
        model.estimated_initial.assign(model.state_names.size(), start == GreyStart::kEstimate);
    model.estimated_initial.resize(model.state_names.size());
    return model;
}

}  // namespace

GreyStart parse_grey_start(const std::string& text) {
    if (text == "model") return GreyStart::kModel;
    if (text == "zero") return GreyStart::kZero;
    if (text == "estimate") return GreyStart::kEstimate;
    throw InvalidArgument("{} of a grey-box model must be \"model\", \"zero\" or \"estimate\", but \"{}\" was given",
                          OptionName{"initial_state"}, text);
}

void GreyOptions::validate() const {
    if (max_iterations < 0)
        throw InvalidArgument("{} must be nonnegative, but is {}", OptionName{"max_iterations"}, max_iterations);
    if (!(tolerance > 0)) throw InvalidArgument("{} must be positive, but is {}", OptionName{"tolerance"}, tolerance);
    if (!(relative_tolerance >= 1e-13 && relative_tolerance <= 1e-2))
        throw InvalidArgument("{} must be between 1e-13 and 0.01, but is {}", OptionName{"relative_tolerance"},
                              relative_tolerance);
    if (starts < 1) throw InvalidArgument("{} must be at least 1, but is {}", OptionName{"starts"}, starts);
}

GreyFit greyest(const IdData& data, const GreyModel& model, const GreyOptions& options) {
    options.validate();
    model.validate();
    check_outputs(data);
    GreyFit result;
    result.model = with_start(model, options.initial_state);
    result.relative_tolerance = options.relative_tolerance;
    result.start = options.initial_state;
    Problem problem{data, result.model, options, std::nullopt};
    if (options.initial_state == GreyStart::kZero)
        problem.initial = Matrix::Zero(model.order(), static_cast<Index>(data.experiments.size()));
    check_output_weights(options.output_weights, data.output_count());
    const Vector weights = options.output_weights.size() > 0 ? options.output_weights : weights_of_spread(data);
    const Beginning from = best_start(problem, weights);
    SearchEnd end = or_grown(problem, search(problem, from, weights), weights);
    const GreyOutput criterion = problem.criterion(from.parameters, end.weights);
    if (end.fit.at_bound.empty()) end.fit.at_bound.resize(static_cast<std::size_t>(end.fit.theta.size()));
    result.fit = end.fit;
    set_weights_asked_for(result.fit, criterion, data, options.output_weights);
    warn_of_search(result.fit, problem.search_options());
    look_at_sensitivities(result, criterion, end.fit);
    const bool ambiguous = result.fit.covariance.size() > 0 && !result.fit.covariance.diagonal().allFinite();
    set_parameters(result, criterion, end.fit);
    set_measures(result, criterion, end.fit, data);
    warn_of_bounds(result.fit, result.model, result.model.free_parameters(), end.fit);
    if (const auto missed = missed_initial_state(data, result, end.weights)) result.fit.warnings.push_back(*missed);
    if (!ambiguous) warn_of_doubtful_parameters(result.fit, SimplerModel::kFewerFreeParameters);
    result.fit.message = has_settled(result.fit) ? Message("The grey-box search converged after {}: {}.",
                                                           iteration_count(result.fit), simulation_text(result.fit))
                                                 : Message("The grey-box search stopped after {}: {}.",
                                                           iteration_count(result.fit), simulation_text(result.fit));
    return result;
}

GreyFit unfitted_grey_box(const GreyModel& model) {
    GreyFit result;
    result.model = model;
    result.fit.theta = model.start();
    const Index outputs = model.outputs_are_states ? model.order() : model.equations->output_count();
    result.fit.fit_percent = Vector::Constant(outputs, kNaN);
    result.initial_states = GreySimulator(model, outputs, {}, result.relative_tolerance).initial_state(model.start());
    return result;
}

Matrix grey_response(const GreyFit& grey, const GreyInputs& inputs, const Vector& x0) {
    if (inputs.u.cols() != grey.model.inputs && !(grey.model.inputs == 0))
        throw InvalidArgument("The model has {}, but the number of specified inputs is {}",
                              plural(grey.model.inputs, "{} input", "{} inputs"), inputs.u.cols());
    if (inputs.u.rows() != inputs.t.size())
        throw InvalidArgument("The inputs have {}, but the time vector has {}",
                              plural(inputs.u.rows(), "{} sample", "{} samples"),
                              plural(inputs.t.size(), "{} instant", "{} instants"));
    if (x0.size() != 0 && x0.size() != grey.model.order())
        throw InvalidArgument("The initial state must have {}, but has {}",
                              plural(grey.model.order(), "{} value", "{} values"), x0.size());
    const Vector from = x0.size() > 0 ? x0 : Vector(grey.initial_states.col(0));
    GreySimulator simulator(grey.model, grey.fit.fit_percent.size(), {}, grey.relative_tolerance);
    return simulator.run(grey.fit.theta, inputs, {&from, {}}, false).y;
}

}  // namespace dynlab::inline numerics
