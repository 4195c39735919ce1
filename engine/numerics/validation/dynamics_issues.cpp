#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/error.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/integrated_input.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/preprocess.h"
#include "numerics/signals/robust_statistics.h"
#include "numerics/simulation/frequency_response.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/model_issues.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kNoisy = 10;             // dB below which noise is a concern
constexpr double kSlow = 6, kFast = 400;  // sampling frequency over bandwidth
constexpr double kBeyond = 1.5;           // times the input's frequency, above which a bandwidth is not reliable
constexpr double kBandPass = 0.1;         // steady gain over peak
constexpr double kOffset = 0.1;           // of the output's standard deviation
constexpr double kOffsetAtRest = 0.02;    // of the output's standard deviation
constexpr Index kMinSamplesAtRest = 20;   // samples
constexpr double kVisibleStart = 0.05;    // of the output's standard deviation
constexpr double kAboveError = 2;         // standard deviations of the error
constexpr double kOverOthers = 3;         // times what a fit finds of such a motion elsewhere
constexpr double kIntegrates = 0.5;       // of the simulated movement

/// rad/s up to which the output responds: where the gain is 3 dB below its steady value, or of a band-pass below its
/// peak. Not finite if the data show no such edge, as with an integrator.
double band_edge(const FittedData& fit) {
    const TransferFunction& G = fit.model();
    const Vector w = natural_frequency_grid(G);
    const Vector gain = frequency_response(G, w).cwiseAbs();
    const double peak = gain.maxCoeff();
    double edge = bandwidth(G);
    if (std::abs(G.dc_gain()) < kBandPass * peak)
        for (Index i = 0; i < w.size(); ++i)
            if (gain[i] > std::numbers::sqrt2 / 2 * peak) edge = w[i];
    const double duration = static_cast<double>(fit.data.sample_count()) * fit.data.Ts;
    return edge * duration > 2 * std::numbers::pi ? edge : std::numeric_limits<double>::quiet_NaN();
}

/// The real pole of the longest time constant, if that is longer than the window.
std::optional<double> slowest_pole(const FittedData& fit) {
    const double duration = static_cast<double>(fit.window.data.sample_count()) * fit.window.data.Ts;
    std::optional<double> slowest;
    for (const Complex pole : fit.model().poles())
        if (std::abs(pole) * duration < 1 && (!slowest || std::abs(pole) < std::abs(*slowest))) slowest = pole.real();
    return slowest;
}

/// The part of G that belongs to a single real pole.
TransferFunction part_of_pole(const TransferFunction& G, double pole) {
    Complex others = 1, numerator = 0;
    bool left_out = false;
    for (const Complex p : G.poles())
        if (!left_out && std::abs(p - pole) < 1e-9 * (1 + std::abs(pole)))
            left_out = true;
        else
            others *= pole - p;
    for (const double b : G.num()) numerator = numerator * pole + b;
    return TransferFunction(Vector{{(numerator / others).real()}}, Vector{{1.0, -pole}}, 0, G.delay());
}

/// Samples at the beginning during which the input stays at zero.
Index samples_at_rest(const VectorView& u) {
    Index count = 0;
    while (count < u.size() && u[count] == 0) ++count;
    return count;
}

/// The output level while the input is zero at the beginning, if the output is constant there and the level exceeds the
/// uncertainty of single samples.
std::optional<double> level_at_rest(const FittedData& fit) {
    const Index count = samples_at_rest(fit.u());
    if (count < kMinSamplesAtRest) return std::nullopt;
    const Vector y = fit.y().head(count);
    const double level = y.mean(), noise = standard_deviation(y);
    const bool flat = std::abs(y.head(count / 2).mean() - y.tail(count / 2).mean()) <= noise;
    if (!flat || std::abs(level) < kAboveError * noise) return std::nullopt;
    return level;
}

/// Correlation of neighbors, between 0 and 1.
double memory_of(const Vector& x) {
    const Index N = x.size();
    return std::clamp(x.head(N - 1).dot(x.tail(N - 1)) / x.squaredNorm(), 0.0, 0.999);
}

/// As many white errors of the same power at low frequencies.
double independent_errors(const Vector& error) {
    const double r = memory_of(error);
    return static_cast<double>(error.size()) * (1 - r) / (1 + r);
}

/// Whether one more pole instead of the delay is nearly as good.
bool may_be_a_lag(const FittedData& fit) {
    constexpr double kNearly = 10;  // of N log of losses
    FitOptions options = FitOptions().started({InitialState::kEstimate, true});
    options.tolerance = 1e-3;
    const TransferFunction& G = fit.model();
    const Vector y = fit.window.data.experiments.front().y.col(0), own = y - compare(fit.window.data, G).output;
    const double corner = 1 / G.delay();  // of the lag that answers as late
    const Vector den = multiply(G.den(), Vector{{1.0, corner}});
    SearchAids aids;
    aids.start.resize(den.size() - 1 + G.num().size());
    aids.start << den.tail(den.size() - 1), corner * G.num();
    const auto structure = TransferStructure::single(static_cast<int>(G.pole_count()) + 1, fit.search.candidate.zeros);
    try {
        const Fit lag = srivc(fit.window.data, structure, options, aids);
        const Vector left = y - compare(fit.window.data, lag.models.front()).output;
        return independent_errors(own) * std::log(left.squaredNorm() / own.squaredNorm()) < kNearly;
    } catch (const InvalidArgument&) {
        return false;
    }
}

/// rad/s, root mean square: a chirp or a slow multisine does not show what the plant does far beyond. One that jumps
/// has all frequencies.
double input_frequency(const FittedData& fit) {
    const VectorView u = fit.u();
    const Index count = u.size() - 1;
    const Vector steps = u.tail(count) - u.head(count);
    const double deviation = standard_deviation(u);
    if (steps.cwiseAbs().maxCoeff() > deviation) return kInfinity;
    return std::sqrt(steps.squaredNorm() / static_cast<double>(count)) / (deviation * fit.data.Ts);
}

/// Standard error of the mean of errors that follow each other.
double error_of_mean(const Vector& error) {
    return standard_deviation(error) / std::sqrt(independent_errors(error));
}

bool excludes_zero(const VectorView& u) {
    const double low = u.minCoeff(), high = u.maxCoeff(), margin = 0.05 * (high - low);
    return low > margin || high < -margin;
}

}  // namespace

void find_noise(const FittedData& fit, DataIssues& findings) {
    const double error = fit.error.squaredNorm() / static_cast<double>(fit.error.size());
    const double total = std::pow(fit.deviation(), 2);
    if (error <= 1e-20 * total) return;
    const double decibels = 10 * std::log10(std::max(total - error, 1e-3 * total) / error);
    const int poles = fit.search.candidate.poles;
    const Number ratio = significant(std::round(decibels), 3);
    const Message order = plural(poles, "{} pole", "{} poles"), left = fit.with_unit(std::sqrt(error), 2);
    const bool explained = std::any_of(findings.begin(), findings.end(), [](const DataIssue& f) {
        return f.code == "nonlinear" || f.code == "saturation" || f.code == "changing_gain";
    });
    if (decibels >= kNoisy || explained)
        findings.push_back(about(fit, "noise", Weight::kNote,
                                 Message("The signal-to-noise ratio of {} is about {} dB (the residuals of a model "
                                         "with {} have a standard deviation of {}).",
                                         fit.output(), ratio, order, left),
                                 decibels));
    else
        findings.push_back(
            about(fit, "low_snr", Weight::kWarning,
                  Message("The signal-to-noise ratio of {} is only about {} dB (the residuals of a model with {} have "
                          "a standard deviation of {}). If the residuals are noise, collect more data or use a larger "
                          "amplitude, and use methods that are unbiased in noise (tfsrivc instead of lssvf). "
                          "Otherwise, an effect other than the input drives the output.",
                          fit.output(), ratio, order, left),
                  decibels));
}

void find_dead_time(const FittedData& fit, DataIssues& findings) {
    const double delay = fit.search.delay, Ts = fit.data.Ts;
    if (!(delay > Ts) || !(delay > 4 * fit.search.std)) return;
    const Message seen =
        Message("{} responds about {} ({} samples) after {}.", fit.output(),
                with_unit(significant(delay, 3), fit.data.time_unit), significant(delay / Ts, 3), fit.input());
    const Message remedy =
        may_be_a_lag(fit) ? Message(
                                "The cause is a delay or another pole: compare both (tfsrivc with np = {} and a delay, "
                                "and with np = {} and {} = 0).",
                                fit.search.candidate.poles, fit.search.candidate.poles + 1, OptionName{"largest_delay"})
                          : Message("Add a dead time to the model ({} of tfsrivc, D in the structure of procsrivc).",
                                    OptionName{"largest_delay"});
    findings.push_back(about(fit, "dead_time", Weight::kNote, sentences({seen, remedy}), delay));
}

void find_offset(const FittedData& fit, DataIssues& findings) {
    const double deviation = fit.deviation(), offset = fit.simulation.offset;
    const double least = std::max({kOffset * deviation, 3 * fit.disturbance, 4 * error_of_mean(fit.error)});
    if (!fit.simulation.start.offset || std::abs(offset) < least) {
        const std::optional<double> level = level_at_rest(fit);
        if (level && std::abs(*level) >= std::max(kOffsetAtRest * deviation, 3 * fit.disturbance))
            findings.push_back(
                about(fit, "offset", Weight::kNote,
                      Message("{} is at rest at about {} during the first {} samples, while {} is zero. Remove this "
                              "offset with data:detrend(\"start\"), or use {} = \"estimate\".",
                              fit.output(), fit.with_unit(*level, 3), samples_at_rest(fit.u()), fit.input(),
                              OptionName{"offset"}),
                      *level));
        return;
    }
    const bool extrapolated = excludes_zero(fit.u());
    const Message level =
        with_unit(rounded_to(offset, deviation / (extrapolated ? 5 : 50)), fit.data.output_units.front());
    const Message seen = extrapolated
                             ? Message(
                                   "According to a linear extrapolation of these data, {} is about {} when {} is zero; "
                                   "the data cover only {} from {} to {}.",
                                   fit.output(), level, fit.input(), fit.input(), rounded(fit.u().minCoeff(), 3),
                                   rounded(fit.u().maxCoeff(), 3))
                             : Message("{} is at rest at about {} when {} is zero.", fit.output(), level, fit.input());
    const Message remedy = Message(
        "A linear model cannot represent an offset: remove the offset with data:remove_mean() or "
        "data:detrend(\"start\"), or use {} = \"estimate\".",
        OptionName{"offset"});
    findings.push_back(about(fit, "offset", Weight::kWarning, sentences({seen, remedy}), offset));
}

namespace {

/// The free motion from before the first sample; zero without one, and if the motion and the offset are large only to
/// cancel each other.
Vector free_motion(const FittedData& fit) {
    constexpr double kNoSense = 20;  // standard deviations of the output
    const CompareResult& simulated = fit.simulation;
    if (simulated.start.state != InitialState::kEstimate || simulated.initial_values.size() == 0) return {};
    const TransferFunction motion(Vector::Ones(1), fit.model().den());
    const Index rows = std::min<Index>(fit.data.sample_count(), 5000);
    Vector free = lsim(motion, Vector::Zero(rows), fit.data.Ts, Hold::kZoh, simulated.initial_values);
    return free.cwiseAbs().maxCoeff() < kNoSense * fit.deviation() ? free : Vector();
}

/// How much of such a motion a fit finds in the error further on, where none can begin: the root mean square of its
/// factors. Errors with a memory, of drift or of what is not linear, are taken for motions anywhere; and what a fit
/// took for a motion at the beginning is no part of the disturbance that was taken off.
double found_elsewhere(const Vector& motion, const FittedData& fit) {
    const Vector error = fit.taken_off.size() > 0 ? Vector(fit.error + fit.taken_off) : fit.error;
    constexpr double kOver = 0.05;  // of the largest value
    Index length = motion.size();
    while (length > 1 && std::abs(motion[length - 1]) < kOver * motion.cwiseAbs().maxCoeff()) --length;
    const auto shape = motion.head(length);
    const Index step = std::max<Index>(1, length / 4);
    double squares = 0, count = 0;
    for (Index first = length; first + length <= error.size(); first += step, ++count)
        squares += std::pow(shape.dot(error.segment(first, length)) / shape.squaredNorm(), 2);
    return count > 0 ? std::sqrt(squares / count) : 0;
}

}  // namespace

namespace {

/// Whether the free motion explains more than errors that follow each other imitate: the gain in N log of the sum of
/// squares over the best start from rest, with as many samples as white errors of the same power at low frequencies.
bool start_is_evident(const FittedData& fit) {
    constexpr double kEvident = 30;
    double rest = kInfinity;
    for (const InitialState state : {InitialState::kZero, InitialState::kSteady}) {
        const CompareResult other = compare(fit.data, fit.model(), {state, Offset::kEstimate});
        rest = std::min(rest, (fit.y() - other.output).squaredNorm());
    }
    return independent_errors(fit.error) * std::log(rest / fit.error.squaredNorm()) > kEvident;
}

}  // namespace

void find_running_start(const FittedData& fit, DataIssues& findings) {
    const Vector motion = free_motion(fit);
    const double largest = motion.size() > 0 ? motion.cwiseAbs().maxCoeff() : 0, error = standard_deviation(fit.error);
    const bool moves =
        largest > std::max({kVisibleStart * fit.deviation(), kAboveError * error, 3 * fit.disturbance}) &&
        kOverOthers * found_elsewhere(motion, fit) < 1 && start_is_evident(fit);
    if (!moves && !has_strange_beginning(fit)) return;
    const OptionName option{"initial_state"};
    const Message message =
        moves ? Message(
                    "The data start during a transient of {} with an amplitude of about {}, so initial rest does not "
                    "explain the first samples. Use {} = \"estimate\", or remove the first samples.",
                    fit.output(), fit.with_unit(largest, 2), option)
              : Message(
                    "The data start during a transient of {}, so initial rest does not explain the "
                    "first samples. Use {} = \"estimate\", or remove the first samples.",
                    fit.output(), option);
    findings.push_back(about(fit, "running_start", Weight::kWarning, message, largest));
}

void find_sampling_rate(const FittedData& fit, DataIssues& findings) {
    const double band = band_edge(fit);
    if (!std::isfinite(band)) return;
    const double ratio = 2 * std::numbers::pi / (fit.data.Ts * band);
    const Number times = rounded(ratio, 2);
    const Message bandwidth = with_unit(rounded(band, 2), "rad/" + fit.data.time_unit);
    if (ratio < kSlow && band < kBeyond * input_frequency(fit))
        findings.push_back(about(
            fit, "slow_sampling", Weight::kWarning,
            Message(
                "The sampling frequency is {} times the bandwidth of about {}; 10 to 30 times is usual. The data do "
                "not show the behavior between the samples, and estimates of fast poles are unreliable: sample faster.",
                times, bandwidth),
            ratio));
    else if (ratio > kFast)
        findings.push_back(about(
            fit, "fast_sampling", Weight::kNote,
            Message("The sampling frequency is {} times the bandwidth of about {}. This is suitable for "
                    "continuous-time methods; before arx and other discrete-time methods, use resample(data, 1, {}).",
                    times, bandwidth, std::min<Index>(static_cast<Index>(ratio / 30), 1000)),
            ratio));
}

void find_integrator(const FittedData& fit, DataIssues& findings) {
    const std::optional<double> pole = slowest_pole(fit);
    if (!pole) return;
    const TransferFunction slow = part_of_pole(fit.model(), *pole);
    const IdData& window = fit.window.data;
    const VectorView u = window.experiments.front().u.col(0);
    const Vector part = lsim(slow, u, window.Ts, window.hold), all = lsim(fit.model(), u, window.Ts, window.hold);
    if (!part.allFinite() || !(standard_deviation(part) > kIntegrates * standard_deviation(all))) return;
    const double duration = static_cast<double>(window.sample_count()) * window.Ts;
    findings.push_back(about(fit, "integrator", Weight::kWarning,
                             Message("{} integrates {} and does not settle within {}. Include the pole at zero in the "
                                     "model with {}, and keep the mean of {} near zero.",
                                     fit.output(), fit.input(), with_unit(rounded(duration, 2), fit.data.time_unit),
                                     OptionName{"integration"}, fit.input()),
                             *pole));
}

namespace {

/// How well an integrator with a lag, and a constant in addition to the input, explain the data.
struct LoadedIntegrator {
    double load = 0;   ///< in units of the input
    double part = 0;   ///< of its ramp, in standard deviations of the output
    double error = 1;  ///< rms, in standard deviations of the output
};

/// y = G(s) v + c + m t with v the integral of u, G stable: m = G(0) load. y and v are linearly detrended for G.
std::optional<LoadedIntegrator> loaded_integrator(const IdData& data) {
    if (data.hold != Hold::kZoh) return std::nullopt;  // the integral of its input is known for held ones only
    const IdData integrated = integrated_inputs(data);
    const IdData bent = detrend(integrated, TrendKind::kLinear);
    FitOptions options;
    options.initial_state = InitialState::kEstimate;
    options.offset = Offset::kEstimate;
    options.tolerance = 1e-4;
    std::optional<Fit> best;
    for (const int poles : {1, 2}) try {
            Fit fit = srivc(bent, TransferStructure::single(poles, 0), options);
            if (fit.models.front().stable() && (!best || fit.loss < best->loss)) best = std::move(fit);
        } catch (const InvalidArgument&) {
            continue;
        }
    if (!best) return std::nullopt;
    const TransferFunction& G = best->models.front();
    const Experiment& data_set = integrated.experiments.front();
    const Vector y = data_set.y.col(0);
    const Vector rest = y - lsim(G, data_set.u.col(0), data.Ts, integrated.hold);
    if (!rest.allFinite()) return std::nullopt;
    Matrix line(y.size(), 2);
    line.col(0).setOnes();
    line.col(1) = Vector::LinSpaced(y.size(), 0, 1);
    const LeastSquares fit = solve_least_squares(line, rest);
    const double deviation = standard_deviation(y), rise = fit.solution[1];
    const double duration = static_cast<double>(y.size() - 1) * data.Ts;
    return LoadedIntegrator{rise / (duration * G.dc_gain()), std::abs(rise) / deviation,
                            std::sqrt(fit.residuals.squaredNorm() / static_cast<double>(y.size())) / deviation};
}

}  // namespace

bool find_load(const FittedData& fit, DataIssues& findings) {
    constexpr double kExplains = 0.3, kAsWell = 1.15, kVisible = 0.3;
    const IdData& window = fit.window.data;
    const bool doubtful = slowest_pole(fit) || fit.runs_away() || wanders(fit.error) ||
                          fit.simulation.start.state == InitialState::kEstimate;
    if (!doubtful) return false;
    const std::optional<LoadedIntegrator> found = loaded_integrator(window);
    if (!found || !(found->part > kVisible) || !(found->error < kExplains)) return false;
    const double own = fit.search.loss() / std::pow(fit.deviation(), 2);
    if (!fit.runs_away() && !(found->error < kAsWell * std::sqrt(own))) return false;
    const Message load = with_unit(rounded(found->load, 2), fit.data.input_units.front());
    const Message balance = with_unit(rounded(-found->load, 2), fit.data.input_units.front());
    findings.push_back(
        about(fit, "load", Weight::kWarning,
              Message("{} integrates {} and a constant load of about {}: the equilibrium is at {} = {}, not at zero. "
                      "Subtract this value from {}, and include the pole at zero in the model with {}.",
                      fit.output(), fit.input(), load, fit.input(), balance, fit.input(), OptionName{"integration"}),
              found->load));
    return true;
}

}  // namespace dynlab::inline numerics
