#include <algorithm>
#include <cmath>
#include <optional>

#include "numerics/error.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/structure_advice.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/statistics/autoregression.h"
#include "numerics/statistics/distributions.h"
#include "numerics/validation/model_issues.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMaxCausalSamples = 4000;
constexpr Index kPastInputs = 10, kLaterInputs = 20;
constexpr double kCausalLevel = 1e-6;
constexpr double kExplainsHalf = 50, kExplainsMost = 85;  // per cent of fit
constexpr double kPromises = 30, kQuickMisses = 10;       // per cent of fit
constexpr double kQuickTolerance = 1e-3;                  // relative, of parameters
constexpr double kMuchBetter = 2.0 / 3;                   // of the error

IdData exchanged(const IdData& data) {
    IdData turned = data;
    for (Experiment& experiment : turned.experiments) std::swap(experiment.u, experiment.y);
    return turned;
}

/// Whether a quick model of two poles from the output to the input comes near the fit of the one the other way round.
bool may_be_exchanged(const IdData& turned, double forward) {
    FitOptions options;
    options.initial_state = InitialState::kEstimate;
    options.offset = Offset::kEstimate;
    options.tolerance = kQuickTolerance;
    try {
        return srivc(turned, TransferStructure::single(2, 1), options).fit_percent[0] >
               std::max(kPromises, forward - kQuickMisses);
    } catch (const InvalidArgument&) {
        return false;
    }
}

/// Whether the error is correlated with inputs from `first` samples later on, in addition to earlier inputs. A smooth
/// input, whose last samples predict the next ones, has no later part with which the error could be correlated.
bool follows_later_inputs(const FittedData& fit, Index first = 1) {
    const IdData& window = fit.window.data;
    const Index count = std::min(window.sample_count(), kMaxCausalSamples);
    if (count < 6 * (kPastInputs + kLaterInputs)) return false;
    const VectorView u = window.experiments.front().u.col(0);
    const Vector error = fit.error(Eigen::seqN(fit.window.first, count, fit.window.step));
    if (!error.allFinite()) return false;
    const Autoregression memory = fit_autoregression(error, {count}, kPastInputs, AutoregressiveOrder::kBic);
    const Index order = memory.order(), past = kPastInputs + first;
    const Index rows = count - past - order - kLaterInputs - first;
    const auto white = [&](Index lead) -> Vector {
        return filtered_past(memory, u.segment(past + lead, rows + order));
    };
    Matrix columns(rows, past + kLaterInputs + 1);
    columns.col(0).setOnes();
    for (Index i = 1; i <= past; ++i) columns.col(i) = white(first - i);
    for (Index i = 0; i < kLaterInputs; ++i) columns.col(past + 1 + i) = white(first + i);
    const Vector e = filtered_past(memory, error.segment(past, rows + order));
    const double before = solve_least_squares(columns.leftCols(past + 1), e).residuals.squaredNorm();
    const double after = solve_least_squares(columns, e).residuals.squaredNorm();
    const double statistic = static_cast<double>(rows - past - kLaterInputs - 1) * (before - after) / after;
    return chi_squared_upper_tail(std::max(0.0, statistic), static_cast<double>(kLaterInputs)) < kCausalLevel;
}

/// The part of a signal's variance that its past does not predict.
double unpredictable_part(const VectorView& x) {
    const Vector centered = x.array() - x.mean();
    const Autoregression memory =
        fit_autoregression(centered, {centered.size()}, kPastInputs, AutoregressiveOrder::kBic);
    return filtered_past(memory, centered).squaredNorm() / centered.squaredNorm();
}

/// Whether noise is in the input and none in the output, as in a smooth signal that was put in and its measured
/// response.
bool output_is_smoother(const IdData& window) {
    const Experiment& data_set = window.experiments.front();
    return unpredictable_part(data_set.y.col(0)) < unpredictable_part(data_set.u.col(0));
}

}  // namespace

bool find_late_input(const FittedData& fit, DataIssues& findings) {
    const Fit& found = fit.search.candidate.estimate;
    const bool at_zero = !found.at_bound.empty() && found.at_bound[static_cast<std::size_t>(found.theta.size() - 1)];
    if (fit.window.step > 1 || !((fit.trusted() && at_zero) || follows_later_inputs(fit, 0))) return false;
    if (!late_input(fit.window.data, fit.search.candidate.poles, fit.search.loss())) return false;
    findings.push_back(about(fit, "late_input", Weight::kWarning, late_input_sentence(fit.data), 1));
    return true;
}

bool find_exchange(const FittedData& fit, const std::function<bool()>& cancel, DataIssues& findings) {
    const bool disturbed = wanders(fit.error);
    const double forward = std::max(fit.simulation.fit_percent, disturbed ? 100 * (1 - fit.movement_error) : 0.0);
    if (forward > kExplainsMost) return false;
    if (!fit.runs_away() &&
        !(fit.model().stable() && (follows_later_inputs(fit) || output_is_smoother(fit.window.data))))
        return false;
    const IdData turned = exchanged(fit.data);
    if (!may_be_exchanged(exchanged(fit.window.data), forward)) return false;
    const std::optional<FittedData> backward = fitted_data(turned, cancel);
    if (!backward || !(backward->simulation.fit_percent > kExplainsHalf)) return false;
    if (!(100 - backward->simulation.fit_percent < kMuchBetter * (100 - forward))) return false;
    findings.push_back(about(fit, "causality", Weight::kWarning,
                             Message("A model from {} to {} has a fit of {} %, but a model from {} to {} has a fit of "
                                     "only {} %: {} seems to respond to {}. The two columns are probably exchanged "
                                     "(the first argument of iddata is the output), or a controller was active.",
                                     fit.output(), fit.input(), rounded(backward->simulation.fit_percent, 2),
                                     fit.input(), fit.output(), rounded(forward, 2), fit.input(), fit.output()),
                             forward));
    return true;
}

}  // namespace dynlab::inline numerics
