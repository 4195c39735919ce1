#include "numerics/fit/first_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/criteria/denominator_group.h"
#include "numerics/error.h"
#include "numerics/fit/simulation_error.h"
#include "numerics/fit/srivc_iteration.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kCutoffs = 8;              // frequencies that best_cutoff_start tries
constexpr int kTrialPasses = 4;          // passes after those that are followed
constexpr double kFarOff = 3;            // times the smallest loss found: such starts are not followed
constexpr Index kTrialSamples = 50'000;  // for longer data the start is found on their beginning
constexpr double kTrialTolerance = 1e-4;

double longest_experiment(const IdData& data) {
    double longest = 0;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) longest = std::max(longest, data.duration(e));
    return longest;
}

/// Channels with separate denominators at one output: each is fitted to its share of a common model.
void start_channels(const IdData& data, const TransferStructure& structure, Index output, double lambda, Hold hold_y,
                    Vector& theta) {
    constexpr int kMaxCommonPoles = 8;
    int order = 0, zeros = 0;
    std::vector<double> delays;
    for (Index input = 0; input < structure.inputs; ++input) {
        const TransferChannel& channel = structure.channel(output, input);
        order += structure.poles[static_cast<std::size_t>(channel.denominator)];
        delays.push_back(channel.delay);
    }
    order = std::min(order, kMaxCommonPoles);
    zeros = order - 1;
    const TransferStructure common =
        TransferStructure::grid(1, structure.inputs, Denominators::kCommon, {order}, {zeros}, delays);
    std::vector<Index> inputs;
    for (Index input = 0; input < structure.inputs; ++input) inputs.push_back(input + 1);
    const IdData of_output = data.select({output + 1}, inputs);
    const Vector joint = lssvf_start(of_output, common, lambda, hold_y);
    for (Index input = 0; input < structure.inputs; ++input) {
        const TransferChannel& channel = structure.channel(output, input);
        const int n = structure.poles[static_cast<std::size_t>(channel.denominator)];
        const Index a = structure.denominator_start(channel.denominator), b = structure.numerator_start(output, input);
        Vector own = Vector::Constant(n + channel.zeros + 1, std::numeric_limits<double>::quiet_NaN());
        if (joint.allFinite()) {
            std::vector<Vector> shares;
            for (const Experiment& experiment : data.experiments)
                shares.push_back(response_from_rest(data, experiment, common.numerator(joint, 0, input),
                                                    common.denominator(joint, 0, input), channel.delay, input));
            own = lssvf_start(single_channel(of_output, shares, input),
                              TransferStructure::single(n, channel.zeros, channel.delay), lambda, hold_y);
        }
        theta.segment(a, n) = own.head(n);
        theta.segment(b, channel.zeros + 1) = own.tail(channel.zeros + 1);
    }
}

/// What the first estimate at a cutoff frequency leads to.
struct CutoffStart {
    Vector theta;
    double loss;
};

/// Of starts in rising order of the cutoff frequency those of smaller loss than their neighbors.
std::vector<CutoffStart> valleys_over_the_cutoff(const std::vector<CutoffStart>& starts) {
    std::vector<CutoffStart> valleys;
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const bool left = i == 0 || starts[i].loss <= starts[i - 1].loss;
        const bool right = i + 1 == starts.size() || starts[i].loss < starts[i + 1].loss;
        if (left && right) valleys.push_back(starts[i]);
    }
    return valleys;
}

}  // namespace

IdData single_channel(const IdData& data, const std::vector<Vector>& outputs, Index input) {
    IdData part = data.select({1}, {input + 1});
    for (std::size_t e = 0; e < outputs.size(); ++e) part.experiments[e].y = outputs[e];
    return part;
}

IdData beginning_of(const IdData& data, Index max_samples) {
    IdData part;
    part.Ts = data.Ts;
    part.hold = data.hold;
    part.input_names = data.input_names;
    part.output_names = data.output_names;
    part.input_units = data.input_units;
    part.output_units = data.output_units;
    part.time_unit = data.time_unit;
    for (const Experiment& experiment : data.experiments) {
        const Index N = std::min(max_samples, experiment.y.rows());
        Experiment beginning;
        beginning.y = experiment.y.topRows(N);
        beginning.u = experiment.u.topRows(N);
        if (experiment.t.size() > 0) beginning.t = experiment.t.head(N);
        beginning.start_time = experiment.start_time;
        part.experiments.push_back(std::move(beginning));
    }
    return part;
}

Vector lssvf_start(const IdData& data, const TransferStructure& structure, double lambda, Hold hold_y) {
    Vector theta = Vector::Zero(structure.parameter_count());
    for (std::size_t g = 0; g < structure.poles.size(); ++g) {
        const DenominatorGroup group(data, structure, static_cast<Index>(g), hold_y);
        const bool whole = std::all_of(group.outputs().begin(), group.outputs().end(),
                                       [&](Index output) { return structure.inputs_share_denominator(output); });
        if (!whole) continue;
        const Vector own = solve_equations(group.svf(filter_denominator(lambda, group.order())));
        theta.segment(group.place(), group.parameter_count()) = own.allFinite() ? group.with_stable_poles(own) : own;
    }
    for (Index output = 0; output < structure.outputs; ++output)
        if (!structure.inputs_share_denominator(output)) start_channels(data, structure, output, lambda, hold_y, theta);
    return theta;
}

Vector best_cutoff_start(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                         CutoffTrials trials) {
    const double Ts = data.mean_step();
    const double slowest = 4 / (longest_experiment(data) + Ts), fastest = 0.6 * std::numbers::pi / Ts;
    const double ratio = std::pow(fastest / slowest, 1.0 / (kCutoffs - 1));
    std::vector<CutoffStart> starts;
    double lambda = slowest;
    for (int i = 0; i < kCutoffs; ++i, lambda *= ratio) {
        if (!starts.empty() && options.cancel && options.cancel()) break;
        Vector start = lssvf_start(data, structure, lambda, options.hold_y);
        if (!start.allFinite()) continue;
        const double loss = simulation_loss(data, structure, start);
        starts.push_back({std::move(start), loss});
    }
    Vector best = Vector::Constant(structure.parameter_count(), std::numeric_limits<double>::quiet_NaN());
    double best_loss = kInfinity;
    const bool all = trials == CutoffTrials::kAll;
    if (!all) starts = valleys_over_the_cutoff(starts);
    if (!all && starts.size() == 1 && std::isfinite(starts.front().loss)) return starts.front().theta;  // no rivals
    std::ranges::stable_sort(starts, {}, &CutoffStart::loss);
    for (const CutoffStart& start : starts) {
        if (!all && start.loss > kFarOff * best_loss) break;
        const auto consider = [&](const Vector& theta, double loss) {
            if (!(loss < best_loss)) return;
            best_loss = loss;
            best = theta;
        };
        consider(start.theta, start.loss);
        const SrivcSolution trial = iterate_srivc(data, structure, start.theta, options.limited(kTrialPasses, 1e-3));
        consider(trial.theta, simulation_loss(data, structure, trial));
    }
    if (!best.allFinite())
        throw InvalidArgument(
            "no initial estimate could be found, because the input does not excite the system enough for {} "
            "parameters. Use a richer input, such as a PRBS, or fewer poles and zeros",
            structure.parameter_count());
    return best;
}

Vector first_estimate(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                      CutoffTrials trials) {
    if (!options.lambda) return best_cutoff_start(data, structure, options, trials);
    return lssvf_start(data, structure, *options.lambda, options.hold_y);
}

Vector start_from_rest(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                       CutoffTrials trials) {
    const auto start_of = [&](const IdData& data_set) {
        const Vector theta = first_estimate(data_set, structure, options, trials);
        return theta.allFinite() ? theta : best_cutoff_start(data_set, structure, options, trials);
    };
    if (data.sample_count() <= 2 * kTrialSamples) return start_of(data);
    const IdData beginning = beginning_of(data, kTrialSamples);
    const SrivcSolution trial = iterate_srivc(beginning, structure, start_of(beginning),
                                              options.limited(options.max_iterations, kTrialTolerance));
    return trial.termination == Termination::kConverged ? trial.theta : start_of(data);
}

}  // namespace dynlab::inline numerics
