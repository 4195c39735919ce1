#include "numerics/criteria/initial_conditions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

bool constant(const MatrixView& u) {
    return (u.rowwise() - u.row(0)).isZero(0);
}

struct Changes {
    Index count = 0, last = 0;  // last: the sample of the last change
};

Changes changes_of(const VectorView& u) {
    Changes changes;
    for (Index k = 1; k < u.size(); ++k) {
        if (u[k] == u[k - 1]) continue;
        ++changes.count;
        changes.last = k;
    }
    return changes;
}

}  // namespace

JointOperatingPoint joint_operating_point(const MatrixView& u, const VectorView& y) {
    Index max_changes = 0, first_step = u.rows();
    for (Index j = 0; j < u.cols(); ++j) {
        const Changes changes = changes_of(u.col(j));
        max_changes = std::max(max_changes, changes.count);
        if (changes.count == 1) first_step = std::min(first_step, changes.last);
    }
    if (max_changes == 0) return {Vector::Zero(u.cols()), 0};
    if (max_changes == 1) return {u.row(0).transpose(), y.head(first_step + 1).mean()};
    return {u.colwise().mean().transpose(), y.mean()};
}

std::vector<StartCondition> start_conditions(const MatrixView& u, InitialState state, Offset offset) {
    const bool flat = constant(u), zero_first = u.row(0).isZero(0);
    if (flat && state == InitialState::kSteady)
        throw InvalidArgument("{} = \"steady\" needs an input that changes, but this input is constant: use \"none\"",
                              OptionName{"initial_state"});
    if (flat && state == InitialState::kEstimate && offset == Offset::kEstimate)
        throw InvalidArgument(
            "With a constant input, {} = \"estimate\" together with {} = \"estimate\" leaves the gain undetermined: "
            "estimate only the initial state or only the offset",
            OptionName{"initial_state"}, OptionName{"offset"});
    std::vector<StartCondition> conditions;
    const auto add = [&](InitialState candidate, bool with_offset) {
        const bool free_state = state == InitialState::kAuto;
        if (!free_state && candidate != state) return;
        if (with_offset ? (offset == Offset::kNone || offset == Offset::kRemove) : offset == Offset::kEstimate) return;
        if (candidate == InitialState::kSteady && free_state && (flat || zero_first)) return;
        if (candidate == InitialState::kEstimate && flat && with_offset) return;
        conditions.push_back({candidate, with_offset});
    };
    for (InitialState candidate : {InitialState::kZero, InitialState::kSteady, InitialState::kEstimate})
        for (bool with_offset : {false, true}) add(candidate, with_offset);
    return conditions;
}

std::vector<StartCondition> start_conditions(const IdData& data, InitialState state, Offset offset) {
    // Two rows that begin with zero, and change, where some experiment does.
    Matrix summary = Matrix::Zero(2, data.input_count());
    for (const Experiment& experiment : data.experiments) {
        const Eigen::RowVectorXd first = experiment.u.row(0);
        summary.row(0) = summary.row(0).cwiseMax(first.cwiseAbs());
        summary.row(1) = summary.row(1).cwiseMax((experiment.u.rowwise() - first).cwiseAbs().colwise().maxCoeff());
    }
    summary.row(1) += summary.row(0);
    return start_conditions(summary, state, offset);
}

Message description(const StartCondition& condition) {
    const bool offset = condition.offset;
    if (condition.state == InitialState::kZero)
        return offset ? Message("from rest at zero input, with an estimated offset")
                      : Message("from rest at zero input");
    if (condition.state == InitialState::kSteady)
        return offset ? Message("from rest at the first input value, with an estimated offset")
                      : Message("from rest at the first input value");
    return offset ? Message("from an estimated initial state, with an estimated offset")
                  : Message("from an estimated initial state");
}

double bic_of_loss(double mean_square, double output_power, Index samples, Index parameters) {
    constexpr double kRounding = 1e3 * std::numeric_limits<double>::epsilon();
    const double least = std::max(kRounding * kRounding * output_power, std::numeric_limits<double>::min());
    const double N = static_cast<double>(samples);
    return std::log(std::max(mean_square, least)) + static_cast<double>(parameters) * std::log(N) / N;
}

void require_transient(const std::string& caller, const StepFit& fit) {
    const double constant = bic_of_loss(fit.spread, fit.output_power, fit.samples, fit.experiments);
    if (bic_of_loss(fit.loss, fit.output_power, fit.samples, fit.parameters) < constant) return;
    throw InvalidArgument(
        "{}: the input never changes and the output shows no transient, so the data contain no excitation: vary the "
        "input, for instance with prbs",
        caller);
}

}  // namespace dynlab::inline numerics
