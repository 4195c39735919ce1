#include <algorithm>
#include <cmath>
#include <optional>

#include "numerics/error.h"
#include "numerics/estimators/srivc.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/statistics/autoregression.h"
#include "numerics/statistics/distributions.h"
#include "numerics/validation/model_findings.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMostCausalSamples = 4000;
constexpr Index kPastInputs = 10, kLaterInputs = 3;
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

/// Whether the error goes with inputs from `first` samples later on, beside those before them. A smooth input, whose
/// next samples its last ones tell, has nothing of its own to go with.
bool follows_later_inputs(const FittedRecord& fit, Index first = 1) {
    const IdData& window = fit.window.data;
    const Index count = std::min(window.sample_count(), kMostCausalSamples);
    const Index past = kPastInputs + first, rows = count - past - kLaterInputs;
    if (rows < 5 * (past + kLaterInputs)) return false;
    const VectorView u = window.experiments.front().u.col(0);
    const Vector error = fit.error(Eigen::seqN(fit.window.first, count, fit.window.step));
    if (!error.allFinite()) return false;
    const Autoregression memory = fit_autoregression(error, {count}, kPastInputs, AutoregressiveOrder::kBic);
    const Index order = memory.order();
    const auto white = [&](Index lead) -> Vector {
        return filtered_past(memory, u.segment(past - order + lead, rows + order));
    };
    Matrix columns(rows, past + kLaterInputs + 1);
    columns.col(0).setOnes();
    for (Index i = 1; i <= past; ++i) columns.col(i) = white(first - i);
    for (Index i = 0; i < kLaterInputs; ++i) columns.col(past + 1 + i) = white(first + i);
    const Vector e = filtered_past(memory, error.segment(past - order, rows + order));
    const double before = solve_least_squares(columns.leftCols(past + 1), e).residuals.squaredNorm();
    const double after = solve_least_squares(columns, e).residuals.squaredNorm();
    const double statistic = static_cast<double>(rows - past - kLaterInputs - 1) * (before - after) / after;
    return chi_squared_upper_tail(std::max(0.0, statistic), static_cast<double>(kLaterInputs)) < kCausalLevel;
}

/// As many white errors of the same power at low frequencies as the model leaves.
double independent_errors(const IdData& data, const TransferFunction& G) {
    const Vector e = data.experiments.front().y.col(0) - compare(data, G).output;
    const Index N = e.size();
    const double r = std::clamp(e.head(N - 1).dot(e.tail(N - 1)) / e.squaredNorm(), 0.0, 0.999);
    return static_cast<double>(N) * (1 - r) / (1 + r);
}

/// The model of the window's structure to its input so many samples earlier.
std::optional<Fit> fit_to_earlier_input(const FittedRecord& fit, Index samples, int zeros) {
    const TransferStructure& found = fit.search.candidate.estimate.structure;
    const IdData data = samples > 0 ? fit.window.data.shifted(-samples) : fit.window.data;
    FitOptions options;
    options.initial_state = InitialState::kEstimate;
    options.offset = Offset::kEstimate;
    options.tolerance = kQuickTolerance;
    options.largest_delay = static_cast<double>(2 * samples) * data.Ts;
    TransferStructure structure = TransferStructure::single(found.poles.front(), zeros);
    structure.free_delays = samples > 0;
    try {
        return srivc(data, structure, options);
    } catch (const InvalidArgument&) {
        return std::nullopt;
    }
}

}  // namespace

bool find_late_input(const FittedRecord& fit, RecordFindings& findings) {
    constexpr Index kShift = 3;                      // samples
    constexpr double kEvidence = 30, kNoWorse = 10;  // of N log of losses
    constexpr double kLeastLead = 0.5;               // samples
    const Fit& found = fit.search.candidate.estimate;
    const bool at_zero = !found.at_bound.empty() && found.at_bound[static_cast<std::size_t>(found.theta.size() - 1)];
    if (!fit.trusted() || fit.window.step > 1 || !(at_zero || follows_later_inputs(fit, 0))) return false;
    const int poles = fit.search.candidate.poles, zeros = fit.search.candidate.zeros;
    const std::optional<Fit> earlier = fit_to_earlier_input(fit, kShift, std::min(zeros, poles - 1));
    if (!earlier) return false;
    const double N = independent_errors(fit.window.data.shifted(-kShift), earlier->models.front());
    if (!(N * std::log(fit.search.loss() / earlier->loss) > kEvidence)) return false;
    const double lead = static_cast<double>(kShift) - earlier->models.front().delay() / fit.data.Ts;
    if (lead < kLeastLead) return false;
    const std::optional<Fit> direct = fit_to_earlier_input(fit, 0, poles);
    if (direct && N * std::log(earlier->loss / direct->loss) > kNoWorse) return false;  // a feedthrough
    const auto samples = static_cast<Index>(std::max(1.0, std::round(lead)));
    findings.push_back(
        about(fit, "late_input", Weight::kWarning,
              Message("{} answers before {} changes, by about {}: the input was logged late. Shift it with "
                      "data:shift({}).",
                      fit.output(), fit.input(), plural(samples, "{} sample", "{} samples"), -samples),
              static_cast<double>(samples)));
    return true;
}

bool find_exchange(const FittedRecord& fit, const std::function<bool()>& cancel, RecordFindings& findings) {
    const bool disturbed = wanders(fit.error);
    const double forward = std::max(fit.simulation.fit_percent, disturbed ? 100 * (1 - fit.movement_error) : 0.0);
    if (forward > kExplainsMost) return false;
    if (!fit.runs_away() && (!fit.model().stable() || !follows_later_inputs(fit))) return false;
    const IdData turned = exchanged(fit.data);
    if (!may_be_exchanged(exchanged(fit.window.data), forward)) return false;
    const std::optional<FittedRecord> backward = fitted_record(turned, cancel);
    if (!backward || !(backward->simulation.fit_percent > kExplainsHalf)) return false;
    if (!(100 - backward->simulation.fit_percent < kMuchBetter * (100 - forward))) return false;
    findings.push_back(about(fit, "causality", Weight::kWarning,
                             Message("A model from {} to {} explains {} %, one from {} to {} only {} %: {} seems to "
                                     "answer {}. The two columns are probably exchanged (iddata takes the output "
                                     "first), or a controller was running.",
                                     fit.output(), fit.input(), rounded(backward->simulation.fit_percent, 2),
                                     fit.input(), fit.output(), rounded(forward, 2), fit.input(), fit.output()),
                             forward));
    return true;
}

}  // namespace dynlab::inline numerics
