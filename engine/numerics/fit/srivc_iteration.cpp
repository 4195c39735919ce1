#include "numerics/fit/srivc_iteration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/fit/simulation_error.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kMaxHalvings = 3;  // of a pass that raises the loss
constexpr double kContractionLimit = 0.7;
constexpr double kLeastContraction = 0.05;  // no pass is taken to leave a smaller part of the change before it

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
        std::size_t data_set = 0;
        for (const Index output : groups_[g].outputs())
            for (const Experiment& experiment : data_.experiments) {
                Vector rest = experiment.y.col(output);
                for (Index input = 0; input < structure_.inputs; ++input) {
                    if (structure_.channel(output, input).denominator == static_cast<Index>(g)) continue;
                    rest -= response_from_rest(data_, experiment, structure_.numerator(theta, output, input),
                                               structure_.denominator(theta, output, input),
                                               structure_.channel(output, input).delay, input);
                }
                groups_[g].set_target(data_set++, rest);
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

/// The remaining distance of the passes from their limit: the changes shrink by a nearly constant factor.
double change_to_come(double change, double last_change) {
    const double factor = std::max(kLeastContraction, change / last_change);
    return factor < kContractionLimit ? change * factor / (1 - factor) : kInfinity;
}

}  // namespace

double simulation_loss(const IdData& data, const TransferStructure& structure, const SrivcSolution& solution) {
    return solution.loss ? *solution.loss : simulation_loss(data, structure, solution.theta);
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
            solution.termination = Termination::kCanceled;
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
            for (int i = 0; (i < kMaxHalvings) && (*next_loss > loss); ++i) {
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

}  // namespace dynlab::inline numerics
