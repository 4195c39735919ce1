#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "numerics/linalg/decompositions.h"
#include "numerics/signals/correlation.h"
#include "numerics/signals/quantization.h"
#include "numerics/signals/repair.h"
#include "numerics/statistics/wrapped_period.h"
#include "numerics/validation/fitted_data.h"
#include "numerics/validation/sampling_issues.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMinRunLength = 5;       // samples at a limit that are no chance
constexpr Index kReach = 4;              // samples before a run over which its slope is taken
constexpr double kSharp = 10;            // steps of the converter that a signal rises before it is cut off
constexpr double kClippedExcess = 0.05;  // of the range, what the signal would have gone beyond its limit
constexpr double kCoarse = 100;          // steps over the range below which quantization matters
constexpr Index kMaxExcitation = 20, kPoorOrder = 6;
constexpr double kExcited = 5e-3;  // singular value against the largest one

struct Channel {
    std::string name, unit;
    bool output;
    Vector x;
    std::size_t experiment;
};

Message value_of(const Channel& channel, double value, int digits = 4) {
    return with_unit(significant(value, digits), channel.unit);
}

Message subject(const Channel& channel) {
    return channel.output ? Message("The output {}", channel.name) : Message("The input {}", channel.name);
}

std::vector<Channel> channels_of(const IdData& data) {
    std::vector<Channel> channels;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const Experiment& experiment = data.experiments[k];
        for (const bool output : {true, false}) {
            const Matrix& signals = output ? experiment.y : experiment.u;
            for (Index i = 0; i < signals.cols(); ++i) {
                const auto place = static_cast<std::size_t>(i);
                channels.push_back({(output ? data.output_names : data.input_names)[place],
                                    (output ? data.output_units : data.input_units)[place], output, signals.col(i), k});
            }
        }
    }
    return channels;
}

DataIssue about(const Channel& channel, const char* code, Weight weight, const Message& message, double value = 0) {
    return {code, weight, channel.name, message, value, channel.experiment, {}};
}

std::string small_letters(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

double range_of(const Vector& x) {
    return x.maxCoeff() - x.minCoeff();
}

/// A constant input other than zero may be a step at the first sample.
void find_step_at_the_start(const Channel& channel, std::vector<DataIssue>& findings) {
    findings.push_back(about(channel, "step_input", Weight::kNote,
                             Message("{} stays at {} throughout. If the input was switched on with the first sample "
                                     "and the output started from rest, this is a step experiment: the data determine "
                                     "the gain, the dead time and one or two time constants.",
                                     subject(channel), value_of(channel, channel.x[0])),
                             0));
}

void find_constant(const Channel& channel, std::vector<DataIssue>& findings) {
    findings.push_back(about(channel, "constant", Weight::kWarning,
                             Message("{} stays at {} throughout, so no dynamics can be estimated from it. Possible "
                                     "causes are saturation, a dead sensor or wire, or a wrong column.",
                                     subject(channel), value_of(channel, channel.x[0])),
                             channel.x[0]));
}

/// One of several inputs: the data do not show its effect.
void find_resting_input(const Channel& channel, std::vector<DataIssue>& findings) {
    findings.push_back(about(channel, "constant", Weight::kWarning,
                             Message("{} stays at {} throughout, so its effect cannot be distinguished from an offset. "
                                     "Exclude it with data:select, or vary it.",
                                     subject(channel), value_of(channel, channel.x[0])),
                             channel.x[0]));
}

void find_time_column(const Channel& channel, std::vector<DataIssue>& findings) {
    const Index N = channel.x.size();
    if (N < 10) return;
    const Vector steps = channel.x.tail(N - 1) - channel.x.head(N - 1);
    const double mean = steps.mean();
    if (!(mean > 0) || (steps.array() - mean).abs().maxCoeff() > 1e-3 * mean) return;
    findings.push_back(
        about(channel, "time_column", Weight::kWarning,
              Message("{} increases by {} at every sample, like a time column. Check the columns of the file.",
                      subject(channel), significant(mean, 4)),
              mean));
}

/// The change of a signal in the `reach` samples before `place`; 0 if the data do not go back so far.
double rise_before(const Vector& x, Index place, Index reach) {
    return place < reach ? 0 : std::abs(x[place] - x[place - reach]);
}

/// Runs at the largest or smallest value into which the signal comes at speed: it would have gone on. A smooth maximum
/// between two steps of a converter rises by no more than eight steps in as many samples before as it lasts.
std::vector<Segment> saturated_runs(const Vector& x, const Quantization& grid) {
    std::vector<Segment> runs;
    const double range = range_of(x), tolerance = 1e-9 * range;
    for (const double limit : {x.maxCoeff(), x.minCoeff()})
        for (Index first = 0; first < x.size();) {
            Index last = first;
            while (last < x.size() && std::abs(x[last] - limit) <= tolerance) ++last;
            const Index length = last - first;
            const double slope = rise_before(x, first, kReach) / static_cast<double>(kReach);
            const double excess = slope * static_cast<double>(std::min<Index>(length, 40));
            const bool sharp = grid.step == 0 || rise_before(x, first, std::min(length, first)) > kSharp * grid.step;
            if (length >= kMinRunLength && excess > kClippedExcess * range && slope > 0.6 * grid.step && sharp)
                runs.push_back({first + 1, last});
            first = std::max(last, first + 1);
        }
    return joined(std::move(runs));
}

/// A signal that jumps between a few levels (a relay, a PRBS, a keyed-in step) has no limits to run into.
bool has_few_levels(const Quantization& grid) {
    return grid.levels <= 5;
}

/// Of outputs: an input that was applied is what it is, whatever its limits.
void find_saturation(const Channel& channel, const Quantization& grid, std::vector<DataIssue>& findings) {
    if (!channel.output || has_few_levels(grid)) return;
    const std::vector<Segment> runs = saturated_runs(channel.x, grid);
    if (runs.empty()) return;
    Index samples = 0;
    for (const Segment& run : runs) samples += run.last - run.first + 1;
    const double share = static_cast<double>(samples) / static_cast<double>(channel.x.size());
    const Message who = subject(channel), limit = value_of(channel, channel.x[runs[0].first - 1]);
    const Number percent = significant(100 * share, 2);
    const Message message =
        share > 0.5 ? Message(
                          "{} saturates for {} % of the data (samples {}): it reaches {} abruptly and stays at this "
                          "value. A linear model cannot represent saturation. Most of the data are saturated: repeat "
                          "the experiment with a smaller amplitude or another sensor range.",
                          who, percent, listed_places(runs), limit)
                    : Message(
                          "{} saturates for {} % of the data (samples {}): it reaches {} abruptly and stays at this "
                          "value. A linear model cannot represent saturation. Exclude these samples with data:discard, "
                          "or repeat the experiment with a smaller amplitude.",
                          who, percent, listed_places(runs), limit);
    DataIssue issue = about(channel, "saturation", Weight::kWarning, message, share);
    issue.sections = runs;
    findings.push_back(std::move(issue));
}

void find_quantization(const Channel& channel, const Quantization& grid, std::vector<DataIssue>& findings) {
    const double range = range_of(channel.x);
    if (!channel.output || grid.step == 0 || range / grid.step >= kCoarse) return;
    findings.push_back(about(
        channel, "quantization", Weight::kWarning,
        Message(
            "{} is quantized in steps of {}; the number of steps over its range is only {}. The effect is similar to "
            "noise with a standard deviation of {}. Use a converter with a higher resolution, or a larger amplitude.",
            subject(channel), value_of(channel, grid.step, 3), std::round(range / grid.step),
            value_of(channel, grid.step / std::sqrt(12.0), 2)),
        grid.step));
}

double bend_at(const Vector& x, Index k) {
    return k < 1 || k + 1 >= x.size() ? 0 : std::abs(x[k + 1] - 2 * x[k] + x[k - 1]);
}

/// Drops outliers that bend the signal no more than ordinary samples do: fast passages, of which there are many.
void drop_usual_bends(RepairedSignal& repaired, const Vector& x) {
    constexpr double kUnusual = 1.2;
    double usual = 0;
    Index from = 0;
    for (std::size_t i = 0; i <= repaired.stretches.size(); ++i) {
        const Index to = i < repaired.stretches.size() ? repaired.stretches[i].first - 2 : x.size();
        for (Index k = from; k < to; ++k) usual = std::max(usual, bend_at(x, k));
        if (i < repaired.stretches.size()) from = repaired.stretches[i].last + 1;
    }
    const auto is_usual = [&](const Segment& stretch) {
        double bend = 0;
        for (Index k = stretch.first - 2; k <= stretch.last; ++k) bend = std::max(bend, bend_at(x, k));
        return bend < kUnusual * usual;
    };
    for (const Segment& stretch : repaired.stretches)
        if (is_usual(stretch))
            std::erase_if(repaired.replaced, [&](Index k) { return k >= stretch.first && k <= stretch.last; });
    std::erase_if(repaired.stretches, is_usual);
}

void find_outliers(const Channel& channel, const Quantization& grid, std::vector<DataIssue>& findings) {
    if (!channel.output || has_few_levels(grid)) return;
    OutlierOptions options;
    options.quantization = grid.step;
    RepairedSignal repaired = replace_outliers(channel.x, options);
    drop_usual_bends(repaired, channel.x);
    const auto count = static_cast<Index>(repaired.replaced.size());
    if (count == 0 || static_cast<double>(count) > 0.05 * static_cast<double>(channel.x.size())) return;
    DataIssue issue =
        about(channel, "outliers", Weight::kWarning,
              Message("{} has {} far from the neighboring samples ({}). Check for invalid samples, and replace them by "
                      "linear interpolation with filloutliers.",
                      subject(channel), plural(count, "{} sample", "{} samples"), listed_places(repaired.stretches)),
              static_cast<double>(count));
    issue.sections = repaired.stretches;
    findings.push_back(std::move(issue));
}

/// An angle that jumps by a turn. Without a unit it may be either.
bool find_wrap(const Channel& channel, std::vector<DataIssue>& findings) {
    constexpr double kDegreesPerTurn = 360, kRadians = 2 * std::numbers::pi;
    const std::string unit = small_letters(channel.unit);
    const bool radians = unit.starts_with("rad"), degrees = unit.starts_with("deg") || unit == "°";
    const Vector periods = radians   ? Vector{{kRadians}}
                           : degrees ? Vector{{kDegreesPerTurn}}
                                     : Vector{{kDegreesPerTurn, kRadians}};
    if (!unit.empty() && !radians && !degrees) return false;
    const std::optional<double> period = wrapped_period(channel.x, periods);
    if (!period) return false;
    findings.push_back(about(channel, "wrapped", Weight::kWarning,
                             Message("{} is an angle that jumps by a full turn ({}) at the end of its range, which no "
                                     "linear model can represent: remove the jumps with {}.",
                                     subject(channel), value_of(channel, *period),
                                     *period == kDegreesPerTurn ? "unwrap(x, 360)" : "unwrap(x)"),
                             *period));
    return true;
}

void find_degrees(const Channel& channel, std::vector<DataIssue>& findings) {
    const std::string unit = small_letters(channel.unit);
    const double swing = range_of(channel.x) / 2;
    if ((unit != "rad" && unit != "radian" && unit != "radians") || swing <= std::numbers::pi) return;
    findings.push_back(
        about(channel, "degrees", Weight::kWarning,
              Message("{} is declared in rad but oscillates by ±{}, which would be {} turns. The unit is probably "
                      "degrees: multiply by pi/180, or declare the unit deg.",
                      subject(channel), significant(swing, 3), significant(swing / (2 * std::numbers::pi), 2)),
              swing));
}

/// First lag at which the autocorrelation has fallen to one half.
Index half_correlation(const Vector& x, Index max_lag) {
    for (Index reach = std::min<Index>(64, max_lag);; reach = std::min(8 * reach, max_lag)) {
        const Vector r = lagged_products(x, x, reach).tail(reach + 1);
        for (Index lag = 1; lag <= reach; ++lag)
            if (r[lag] < 0.5 * r[0]) return lag;
        if (reach == max_lag) return max_lag;
    }
}

/// The sums of products of `order` copies of u, each `shift` samples later than the one before, over `rows` samples:
/// those of a copy with another differ from those of the two before them by what enters and what leaves.
Matrix products_of_copies(const Vector& u, Index shift, Index order, Index rows) {
    Matrix G(order, order);
    for (Index j = 0; j < order; ++j) G(0, j) = G(j, 0) = u.head(rows).dot(u.segment(j * shift, rows));
    for (Index i = 1; i < order; ++i)
        for (Index j = i; j < order; ++j) {
            const auto piece = [&](Index copy, Index first) { return u.segment(copy * shift + first, shift); };
            G(i, j) = G(j, i) =
                G(i - 1, j - 1) - piece(i - 1, 0).dot(piece(j - 1, 0)) + piece(i - 1, rows).dot(piece(j - 1, rows));
        }
    return G;
}

/// Rank of the input's shifted copies, shifts as far apart as the input takes to change: how many parameters of a
/// model it can determine.
Index excitation_order(const Vector& input) {
    const Vector u = input.array() - input.mean();
    const Index N = u.size(), shift = half_correlation(u, std::max<Index>(N / 20, 1));
    const Index order = std::min(kMaxExcitation, N / (2 * shift));
    if (order < 1) return 1;
    const Index rows = N - (order - 1) * shift;
    Vector means(order);
    for (Index i = 0; i < order; ++i) means[i] = u.segment(i * shift, rows).mean();
    const Matrix centered =
        products_of_copies(u, shift, order, rows) - static_cast<double>(rows) * means * means.transpose();
    const Vector squares = symmetric_eigenvalues(centered);
    return (squares.array() > kExcited * kExcited * squares[order - 1]).count();
}

Index changes_of(const Vector& u) {
    const double least = 0.05 * range_of(u);
    Index changes = 0;
    for (Index k = 1; k < u.size(); ++k) changes += std::abs(u[k] - u[k - 1]) > least;
    return changes;
}

/// Of an input that changes so often only.
Message few_changes(const Channel& channel, Index changes) {
    return changes == 1 ? Message(
                              "{} changes only once, as in a step experiment. These data determine the gain, the dead "
                              "time and one or two time constants (procsrivc, step_first_order). For higher orders, "
                              "excite the system with a PRBS (prbs).",
                              subject(channel))
                        : Message(
                              "{} changes only {} times, as in a step experiment. These data determine the gain, the "
                              "dead time and one or two time constants (procsrivc, step_first_order). For higher "
                              "orders, excite the system with a PRBS (prbs).",
                              subject(channel), changes);
}

Message excitation_of(const Channel& channel, Index order) {
    if (order < kPoorOrder)
        return Message(
            "{} can determine no more than {}: it contains only about {}. Excite the system with a PRBS, a chirp or a "
            "multisine that covers the plant's bandwidth.",
            subject(channel), plural(order, "{} parameter", "{} parameters"),
            plural((order + 1) / 2, "{} frequency", "{} frequencies"));
    if (order < kMaxExcitation)
        return Message("{} is sufficiently exciting for models with {} parameters.", subject(channel), order);
    return Message("{} is sufficiently exciting for models with {} parameters or more.", subject(channel),
                   kMaxExcitation);
}

void find_excitation(const Channel& channel, const Quantization& grid, std::vector<DataIssue>& findings) {
    const Index changes = changes_of(channel.x);
    if (has_few_levels(grid) && changes <= 3) {
        findings.push_back(
            about(channel, "step_input", Weight::kNote, few_changes(channel, changes), static_cast<double>(changes)));
        return;
    }
    const Index order = excitation_order(channel.x);
    const bool poor = order < kPoorOrder;
    findings.push_back(about(channel, poor ? "poor_excitation" : "excitation", poor ? Weight::kWarning : Weight::kNote,
                             excitation_of(channel, order), static_cast<double>(order)));
}

void find_twins(const std::vector<Channel>& channels, std::vector<DataIssue>& findings) {
    for (std::size_t i = 0; i < channels.size(); ++i)
        for (std::size_t j = i + 1; j < channels.size(); ++j) {
            const Channel &a = channels[i], &b = channels[j];
            if (a.experiment != b.experiment || range_of(a.x) == 0 || a.x != b.x) continue;
            findings.push_back(
                about(b, "same_column", Weight::kWarning,
                      Message("{} is identical to {} in every sample: the same column was probably read twice.",
                              subject(b), a.name)));
        }
}

}  // namespace

std::vector<DataIssue> signal_advice(const IdData& data) {
    std::vector<DataIssue> findings;
    find_sampling(data, findings);
    const std::vector<Channel> channels = channels_of(data);
    find_twins(channels, findings);
    for (const Channel& channel : channels) {
        if (range_of(channel.x) == 0) {
            if (channel.output)
                find_constant(channel, findings);
            else if (data.input_count() > 1)
                find_resting_input(channel, findings);
            else
                channel.x[0] != 0 ? find_step_at_the_start(channel, findings) : find_constant(channel, findings);
            continue;
        }
        const Quantization grid = quantization_of(channel.x);
        if (!has_few_levels(grid) && find_wrap(channel, findings)) continue;
        find_time_column(channel, findings);
        find_saturation(channel, grid, findings);
        find_quantization(channel, grid, findings);
        find_outliers(channel, grid, findings);
        find_degrees(channel, findings);
        if (!channel.output) find_excitation(channel, grid, findings);
    }
    return findings;
}

}  // namespace dynlab::inline numerics
