#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/error.h"
#include "numerics/number_text.h"
#include "numerics/signals/resample.h"
#include "numerics/signals/robust_statistics.h"
#include "numerics/simulation/frequency_response.h"
#include "numerics/validation/advice.h"
#include "numerics/validation/compare.h"
#include "numerics/validation/delay_search.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kLongest = 6000;          // samples that the search looks at
constexpr Index kFewest = 60;             // samples below which a model would say little
constexpr double kNoisy = 10;             // dB below which noise is a concern
constexpr double kExplains = 50;          // per cent of fit from which the model is trusted to tell details
constexpr double kSlow = 6, kFast = 400;  // sampling frequency over bandwidth
constexpr double kBandPass = 0.1;         // steady gain over peak
constexpr double kOffset = 0.1;           // of the output's standard deviation
constexpr Index kWindows = 24;
constexpr double kLeastError = 0.05;  // of the output's standard deviation, for an error to be worth a word
constexpr double kStrange = 4;        // rms error of a window over the median of all windows

/// The record, its model, and the errors of the simulation.
struct Fitted {
    const IdData& data;
    DelaySearch search;
    CompareResult simulation;
    Vector error;

    const TransferFunction& model() const { return search.candidate.estimate.models.front(); }
    const std::string& output() const { return data.output_names.front(); }
    const std::string& input() const { return data.input_names.front(); }
    std::string unit() const { return data.output_units.front().empty() ? "" : " " + data.output_units.front(); }
    /// Standard deviation of the output.
    double deviation() const {
        const Vector y = data.experiments.front().y.col(0);
        return std::sqrt((y.array() - y.mean()).square().mean());
    }
    bool trusted() const { return simulation.fit_percent > kExplains; }
};

DelaySearchOptions search_options(const std::function<bool()>& cancel) {
    DelaySearchOptions options;
    options.estimation.initial_state = InitialState::kAuto;
    options.estimation.offset = Offset::kAuto;
    options.cancel = cancel;
    return options;
}

IdData shortened(const IdData& data) {
    const Index N = data.sample_count();
    return N > kLongest ? resample(data, 1, (N + kLongest - 1) / kLongest) : data;
}

std::optional<DelaySearch> fitted(const IdData& data, const std::function<bool()>& cancel) {
    try {
        DelaySearch search = search_delay(shortened(data), search_options(cancel));
        if (!search.cancelled) return search;
    } catch (const InvalidArgument&) {
        // nothing could be fitted: the findings on the signals say why
    }
    return std::nullopt;
}

RecordFinding about(const Fitted& fit, const char* code, Weight weight, const std::string& message, double value) {
    return {code, weight, fit.output(), message, value, 0, {}};
}

void find_noise(const Fitted& fit, std::vector<RecordFinding>& findings) {
    const double error = fit.error.squaredNorm() / static_cast<double>(fit.error.size());
    const double total = fit.deviation() * fit.deviation();
    if (error <= 1e-20 * total) return;
    const double decibels = 10 * std::log10(std::max(total - error, 1e-3 * total) / error);
    const std::string size =
        number_text(std::round(decibels), 3) + " dB (what a model with " + std::to_string(fit.search.candidate.poles) +
        (fit.search.candidate.poles == 1 ? " pole" : " poles") + " leaves unexplained has the standard deviation " +
        number_text(std::sqrt(error), 2) + fit.unit() + ")";
    if (decibels >= kNoisy)
        findings.push_back(about(fit, "noise", Weight::kNote,
                                 "The signal-to-noise ratio of " + fit.output() + " is about " + size + ".", decibels));
    else
        findings.push_back(
            about(fit, "low_snr", Weight::kWarning,
                  "The signal-to-noise ratio of " + fit.output() + " is only about " + size +
                      ". Record longer, or with a larger amplitude, and prefer methods that noise does not "
                      "bias (tfsrivc rather than lssvf).",
                  decibels));
}

void find_dead_time(const Fitted& fit, std::vector<RecordFinding>& findings) {
    const double delay = fit.search.delay, Ts = fit.data.Ts;
    if (!(delay > Ts) || !(delay > 4 * fit.search.std)) return;
    findings.push_back(about(fit, "dead_time", Weight::kNote,
                             fit.output() + " answers about " + number_text(delay, 3) + " " + fit.data.time_unit +
                                 " (" + number_text(delay / Ts, 3) + " samples) after " + fit.input() +
                                 ": give the model a dead time (`largest_delay` of tfsrivc, the D of procsrivc).",
                             delay));
}

void find_offset(const Fitted& fit, std::vector<RecordFinding>& findings) {
    const double deviation = fit.deviation();
    const double offset = fit.simulation.offset;
    if (!fit.simulation.start.offset || std::abs(offset) < kOffset * deviation) return;
    findings.push_back(about(fit, "offset", Weight::kWarning,
                             fit.output() + " stands at about " + number_text(offset, 4) + fit.unit() + " when " +
                                 fit.input() +
                                 " is zero. A linear model goes through the origin: take the offset off with "
                                 "data:remove_mean() or data:detrend(\"start\"), or use `offset` = \"estimate\".",
                             offset));
}

void find_running_start(const Fitted& fit, std::vector<RecordFinding>& findings) {
    if (fit.simulation.start.state != InitialState::kEstimate) return;
    findings.push_back(
        about(fit, "running_start", Weight::kWarning,
              "The record begins in the middle of a movement of " + fit.output() +
                  ": no start from rest explains its first samples. Use `initial_state` = \"estimate\", or "
                  "begin the record later.",
              fit.simulation.initial_values.size() > 0 ? fit.simulation.initial_values[0] : 0));
}

/// rad/s up to which the output answers: where the gain is 3 dB below its steady value, or of a band-pass below its
/// peak. Not finite where the record tells of no such edge, as with an integrator.
double band_edge(const Fitted& fit) {
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

void find_sampling_rate(const Fitted& fit, std::vector<RecordFinding>& findings) {
    const double band = band_edge(fit);
    if (!std::isfinite(band)) return;
    const double ratio = 2 * std::numbers::pi / (fit.data.Ts * band);
    const std::string numbers = "The sampling frequency is " + number_text(ratio, 3) +
                                " times the bandwidth of about " + number_text(band, 3) + " rad/" + fit.data.time_unit +
                                "; ";
    if (ratio < kSlow)
        findings.push_back(about(fit, "slow_sampling", Weight::kWarning,
                                 numbers + "10 to 30 times is usual. What happens between the samples is lost: sample "
                                           "faster, and do not trust fast poles.",
                                 ratio));
    else if (ratio > kFast)
        findings.push_back(about(fit, "fast_sampling", Weight::kNote,
                                 numbers +
                                     "continuous-time methods do not mind, but before arx and its like use "
                                     "resample(data, 1, " +
                                     std::to_string(std::min<Index>(static_cast<Index>(ratio / 30), 1000)) + ").",
                                 ratio));
}

/// Windows whose error is far beyond that of most windows, where the model follows the rest.
void find_strange_sections(const Fitted& fit, std::vector<RecordFinding>& findings) {
    const Index N = fit.error.size(), length = N / kWindows;
    if (length < 5) return;
    Vector levels(kWindows);
    for (Index i = 0; i < kWindows; ++i)
        levels[i] = std::sqrt(fit.error.segment(i * length, length).squaredNorm() / static_cast<double>(length));
    const double limit = std::max(kStrange * median(levels), kLeastError * fit.deviation());
    std::vector<Segment> sections;
    for (Index i = 0; i < kWindows; ++i)
        if (levels[i] > limit) sections.push_back({i * length + 1, (i + 1) * length});
    sections = joined(sections);
    if (sections.empty() || static_cast<Index>(sections.size()) > kWindows / 4) return;
    std::string places;
    for (const Segment& section : sections)
        places += (places.empty() ? "" : ", ") + std::to_string(section.first) + " to " + std::to_string(section.last);
    RecordFinding finding =
        about(fit, "nonlinear", Weight::kWarning,
              "A linear model follows " + fit.output() + " but not in samples " + places +
                  ", where its error is more than " + number_text(kStrange) +
                  " times the usual one: something else happens there (a limit, friction, a disturbance). "
                  "Look at it, and leave it out with data:discard when it is not what you want to model.",
              static_cast<double>(sections.size()));
    finding.sections = std::move(sections);
    findings.push_back(std::move(finding));
}

/// With exchanged columns the model from y to u explains what the one from u to y cannot.
bool explained_backwards(const Fitted& fit, const std::function<bool()>& cancel) {
    IdData turned = fit.data;
    for (Experiment& experiment : turned.experiments) std::swap(experiment.u, experiment.y);
    const std::optional<DelaySearch> backwards = fitted(turned, cancel);
    return backwards && backwards->candidate.fit_percent > std::max(kExplains, fit.simulation.fit_percent + 30);
}

void find_causality(const Fitted& fit, std::vector<RecordFinding>& findings) {
    findings.push_back(
        about(fit, "causality", Weight::kWarning,
              fit.input() + " can be explained by " + fit.output() + " much better than " + fit.output() + " by " +
                  fit.input() +
                  ". The two columns are probably exchanged (iddata takes the output first), or a controller "
                  "was running.",
              fit.simulation.fit_percent));
}

}  // namespace

std::vector<RecordFinding> model_advice(const IdData& data, const std::function<bool()>& cancel) {
    std::vector<RecordFinding> findings;
    if (data.sample_count(0) < kFewest) {
        findings.push_back({"short",
                            Weight::kWarning,
                            "",
                            "The record has only " + std::to_string(data.sample_count(0)) +
                                " samples. Every parameter of a model wants about ten of them: record longer, or stay "
                                "with a model of one pole.",
                            static_cast<double>(data.sample_count(0)),
                            0,
                            {}});
        return findings;
    }
    IdData first = data;
    first.experiments.resize(1);
    std::optional<DelaySearch> search = fitted(first, cancel);
    if (!search) return findings;
    const TransferFunction G = search->candidate.estimate.models.front();
    Fitted fit{first, std::move(*search), compare(first, G), {}};
    fit.error = first.experiments.front().y.col(0) - fit.simulation.output;
    if (!fit.trusted() && explained_backwards(fit, cancel)) {
        find_causality(fit, findings);
        return findings;
    }
    find_noise(fit, findings);
    if (!fit.trusted()) return findings;
    find_dead_time(fit, findings);
    find_offset(fit, findings);
    find_running_start(fit, findings);
    find_sampling_rate(fit, findings);
    find_strange_sections(fit, findings);
    return findings;
}

}  // namespace dynlab::inline numerics
