#include "numerics/fit/srivc_iteration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kCutoffs = 8;              // frequencies that best_cutoff_start tries
constexpr int kTrialPasses = 4;          // passes after those that are followed
constexpr double kFarOff = 3;            // times the smallest loss found: such starts are not followed
constexpr Index kTrialSamples = 50'000;  // the start for a longer record is found on its beginning
constexpr double kTrialTolerance = 1e-4;
constexpr int kMostHalvings = 3;  // of a pass that raises the loss
constexpr double kContractionLimit = 0.7;
constexpr double kLeastContraction = 0.05;  // no pass is taken to leave a smaller part of the change before it

Vector simulate(const IdData& data, const Experiment& experiment, const VectorView& B, const VectorView& A,
                double delay, Index input) {
    const Sampling sampling{data.Ts, SampleView(experiment.t.data(), experiment.t.size())};
    return transfer_filters().response(B, A, delay, experiment.u.col(input), sampling, data.hold);
}

/// All denominator groups of a model, and what one leaves for the other to explain.
class Groups {
  public:
    Groups(const IdData& data, const TransferStructure& structure, Hold hold_y, const SrivcExtras& extras)
        : data_(data), structure_(structure), with_gram_(extras.with_gram) {
        if (with_gram_) gram_ = Matrix::Zero(structure.parameter_count(), structure.parameter_count());
        for (std::size_t g = 0; g < structure.poles.size(); ++g) {
            groups_.emplace_back(data, structure, static_cast<Index>(g), hold_y);
            for (Index output = 0; output < extras.weights.size(); ++output)
                groups_.back().set_weight(output, extras.weights[output]);
        }
        for (Index output = 0; output < structure.outputs; ++output)
            shared_outputs_ = shared_outputs_ || !structure.inputs_share_denominator(output);
    }

    /// One pass over all groups, before poles are mirrored.
    Vector pass(Vector theta) {
        Vector next = theta;
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            DenominatorGroup& group = groups_[g];
            if (shared_outputs_) set_targets(g, theta);
            const Vector own = theta.segment(group.place(), group.parameter_count());
            const NormalEquations sums = group.refined(own, with_gram_);
            if (with_gram_) gram_.block(group.place(), group.place(), own.size(), own.size()) = sums.z_z;
            const Vector solved = solve_equations(sums);
            next.segment(group.place(), group.parameter_count()) = solved;
            if (solved.allFinite())
                theta.segment(group.place(), group.parameter_count()) = group.with_stable_poles(solved);
        }
        return next;
    }

    const Matrix& gram() const { return gram_; }

    Vector with_stable_poles(Vector theta, bool& any) const {
        for (const DenominatorGroup& group : groups_) {
            bool here = false;
            auto own = theta.segment(group.place(), group.parameter_count());
            own = group.with_stable_poles(own, &here);
            any = any || here;
        }
        return theta;
    }

  private:
    void set_targets(std::size_t g, const Vector& theta) {
        std::size_t record = 0;
        for (const Index output : groups_[g].outputs())
            for (const Experiment& experiment : data_.experiments) {
                Vector rest = experiment.y.col(output);
                for (Index input = 0; input < structure_.inputs; ++input) {
                    if (structure_.channel(output, input).denominator == static_cast<Index>(g)) continue;
                    rest -= simulate(data_, experiment, structure_.numerator(theta, output, input),
                                     structure_.denominator(theta, output, input),
                                     structure_.channel(output, input).delay, input);
                }
                groups_[g].set_target(record++, rest);
            }
    }

    const IdData& data_;
    const TransferStructure& structure_;
    std::vector<DenominatorGroup> groups_;
    bool shared_outputs_ = false, with_gram_;
    Matrix gram_;
};

double largest_change(const Vector& next, const Vector& theta) {
    double change = 0;
    for (Index i = 0; i < theta.size(); ++i)
        if (next[i] != theta[i]) change = std::max(change, std::abs((next[i] - theta[i]) / next[i]));
    return change;
}

/// How far the passes still are from where they lead: the changes shrink by a factor that hardly varies.
double change_to_come(double change, double last_change) {
    const double factor = std::max(kLeastContraction, change / last_change);
    return factor < kContractionLimit ? change * factor / (1 - factor) : kInfinity;
}

double longest_record(const IdData& data) {
    double longest = 0;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) longest = std::max(longest, data.duration(e));
    return longest;
}

/// Part of the data with one output, one input and this output signal in each experiment.
IdData single_channel(const IdData& data, const std::vector<Vector>& outputs, Index input) {
    IdData part = data.select({1}, {input + 1});
    for (std::size_t e = 0; e < outputs.size(); ++e) part.experiments[e].y = outputs[e];
    return part;
}

/// Channels with denominators of their own at one output: each fitted to its share of a common model.
void start_channels(const IdData& data, const TransferStructure& structure, Index output, double lambda, Hold hold_y,
                    Vector& theta) {
    constexpr int kMostCommonPoles = 8;
    int order = 0, zeros = 0;
    std::vector<double> delays;
    for (Index input = 0; input < structure.inputs; ++input) {
        const TransferChannel& channel = structure.channel(output, input);
        order += structure.poles[static_cast<std::size_t>(channel.denominator)];
        delays.push_back(channel.delay);
    }
    order = std::min(order, kMostCommonPoles);
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
                shares.push_back(simulate(data, experiment, common.numerator(joint, 0, input),
                                          common.denominator(joint, 0, input), channel.delay, input));
            own = lssvf_start(single_channel(of_output, shares, input),
                              TransferStructure::single(n, channel.zeros, channel.delay), lambda, hold_y);
        }
        theta.segment(a, n) = own.head(n);
        theta.segment(b, channel.zeros + 1) = own.tail(channel.zeros + 1);
    }
}

/// What the first estimate at a cut-off frequency leads to.
struct CutoffStart {
    Vector theta;
    double loss;
};

/// Of starts in rising order of the cut-off frequency those of smaller loss than their neighbours.
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

IdData beginning_of(const IdData& data, Index most_samples) {
    IdData part;
    part.Ts = data.Ts;
    part.hold = data.hold;
    part.input_names = data.input_names;
    part.output_names = data.output_names;
    part.input_units = data.input_units;
    part.output_units = data.output_units;
    for (const Experiment& experiment : data.experiments) {
        const Index N = std::min(most_samples, experiment.y.rows());
        Experiment beginning;
        beginning.y = experiment.y.topRows(N);
        beginning.u = experiment.u.topRows(N);
        if (experiment.t.size() > 0) beginning.t = experiment.t.head(N);
        part.experiments.push_back(std::move(beginning));
    }
    return part;
}

double simulation_loss(const IdData& data, const TransferStructure& structure, const VectorView& theta) {
    if (!theta.allFinite()) return kInfinity;
    double squares = 0;
    for (Index output = 0; output < structure.outputs; ++output)
        squares += simulation_squares(data, structure, theta, output);
    const double loss = squares / static_cast<double>(data.sample_count() * structure.outputs);
    return std::isfinite(loss) ? loss : kInfinity;
}

double simulation_loss(const IdData& data, const TransferStructure& structure, const SrivcSolution& solution) {
    return solution.loss ? *solution.loss : simulation_loss(data, structure, solution.theta);
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
    fit.warnings.push_back("The simulation of the model grows beyond all bounds over the record: it has no fit.");
    fit.message += " " + fit.warnings.back();
}

SrivcSolution iterate_srivc(const IdData& data, const TransferStructure& structure, const Vector& start,
                            const FitOptions& options, const SrivcExtras& extras) {
    Groups groups(data, structure, options.hold_y, extras);
    SrivcSolution solution;
    solution.theta = start;
    std::vector<std::optional<double>> losses;  // after the passes
    double last_change = kInfinity;
    for (int pass = 0; pass < options.max_iterations; ++pass) {
        if (options.cancel && options.cancel()) {
            solution.termination = Termination::kCancelled;
            break;
        }
        const Vector found = groups.pass(solution.theta);
        if (!found.allFinite()) {
            solution.termination = Termination::kNoProgress;
            break;
        }
        const double change = largest_change(found, solution.theta);
        Vector next = groups.with_stable_poles(found, solution.mirrored);
        const bool settled =
            change <= options.tolerance || (pass > 0 && change_to_come(change, last_change) <= options.tolerance);
        std::optional<double> next_loss;
        if (!settled && change > kContractionLimit * last_change) {
            const double loss = simulation_loss(data, structure, solution);
            next_loss = simulation_loss(data, structure, next);
            for (int i = 0; (i < kMostHalvings) && (*next_loss > loss); ++i) {
                next = groups.with_stable_poles(0.5 * (next + solution.theta), solution.mirrored);
                next_loss = simulation_loss(data, structure, next);
            }
        }
        last_change = change;
        solution.theta = next;
        solution.loss = next_loss;
        losses.push_back(next_loss);
        solution.trace.push_back({next, std::numeric_limits<double>::quiet_NaN(), change});
        if (settled) {
            solution.termination = Termination::kConverged;
            solution.gram = groups.gram();
            return solution;
        }
    }
    solution.loss = simulation_loss(data, structure, solution);
    for (std::size_t i = 0; i + 1 < losses.size(); ++i) {
        const Vector& theta = solution.trace[i].theta;
        const double loss = losses[i] ? *losses[i] : simulation_loss(data, structure, theta);
        if (loss < *solution.loss) {
            solution.loss = loss;
            solution.theta = theta;
        }
    }
    return solution;
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
    const double slowest = 4 / (longest_record(data) + Ts), fastest = 0.6 * std::numbers::pi / Ts;
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
    std::stable_sort(starts.begin(), starts.end(),
                     [](const CutoffStart& a, const CutoffStart& b) { return a.loss < b.loss; });
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
        throw InvalidArgument("no first estimate could be found: the input does not excite the system enough for " +
                              std::to_string(structure.parameter_count()) + " parameters");
    return best;
}

Vector first_estimate(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                      CutoffTrials trials) {
    if (!options.lambda) return best_cutoff_start(data, structure, options, trials);
    return lssvf_start(data, structure, *options.lambda, options.hold_y);
}

Vector start_from_rest(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                       CutoffTrials trials) {
    const auto start_of = [&](const IdData& record) {
        const Vector theta = first_estimate(record, structure, options, trials);
        return theta.allFinite() ? theta : best_cutoff_start(record, structure, options, trials);
    };
    if (data.sample_count() <= 2 * kTrialSamples) return start_of(data);
    const IdData beginning = beginning_of(data, kTrialSamples);
    const SrivcSolution trial = iterate_srivc(beginning, structure, start_of(beginning),
                                              options.limited(options.max_iterations, kTrialTolerance));
    return trial.termination == Termination::kConverged ? trial.theta : start_of(data);
}

}  // namespace dynlab::inline numerics
