#include <algorithm>
#include <cmath>
#include <optional>

#include "numerics/signals/repair.h"
#include "numerics/signals/robust_statistics.h"
#include "numerics/validation/model_issues.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSlowParts = 20;      // of the data, over which a slow disturbance is averaged
constexpr double kWorthAWord = 0.08;  // of the output's standard deviation
constexpr double kWalkWorthAWord = 0.12;
constexpr double kNearlyAll = 0.8;
constexpr double kStraightLine = 0.7;  // of the slow part's variance, for it to be called a drift
constexpr Index kSections = 24;
constexpr double kMinError = 0.05;  // of the output's standard deviation, for an error to be worth a word
constexpr double kStrange = 4;      // rms error of a window over the median of all windows

/// Means over the parts of the data, linearly interpolated. The first part is extrapolated from the two after it,
/// because it may contain a transient from before the first sample.
Vector slow_part(const Vector& x) {
    const Index N = x.size(), length = N / kSlowParts;
    Vector means(kSlowParts);
    for (Index i = 0; i < kSlowParts; ++i) means[i] = x.segment(i * length, length).mean();
    means[0] = 2 * means[1] - means[2];
    Vector slow(N);
    for (Index k = 0; k < N; ++k) {
        const double place = (static_cast<double>(k) + 0.5) / static_cast<double>(length) - 0.5;
        const auto i = static_cast<Index>(std::clamp(std::floor(place), 0.0, static_cast<double>(kSlowParts - 2)));
        slow[k] = means[i] + (place - static_cast<double>(i)) * (means[i + 1] - means[i]);
    }
    return slow;
}

/// The error without a free motion from before the first sample, which could look like a disturbance.
Vector error_without_free_motion(const FittedData& fit) {
    if (fit.simulation.start.state != InitialState::kEstimate) return fit.error;
    Vector best;
    for (const InitialState state : {InitialState::kZero, InitialState::kSteady}) {
        const Vector error = fit.y() - compare(fit.data, fit.model(), {state, Offset::kEstimate}).output;
        if (best.size() == 0 || error.squaredNorm() < best.squaredNorm()) best = error;
    }
    return best;
}

struct StraightLine {
    double rise = 0;   // from the first sample to the last
    double share = 0;  // of the variance
};

StraightLine straight_line(const Vector& x) {
    const Vector t = Vector::LinSpaced(x.size(), -0.5, 0.5);
    const double slope = t.dot(x) / t.squaredNorm(), squares = (x.array() - x.mean()).square().sum();
    return {slope, slope * slope * t.squaredNorm() / squares};
}

/// The first samples, which a start may explain, and stretches of many are no outliers.
void keep_isolated(RepairedSignal& repaired, const Vector& x) {
    constexpr Index kStart = 5, kMaxLength = 3;
    const auto is_none = [](const Segment& s) { return s.first <= kStart || s.last - s.first >= kMaxLength; };
    for (const Segment& stretch : repaired.stretches) {
        if (!is_none(stretch)) continue;
        const Index first = stretch.first - 1, count = stretch.last - first;
        repaired.signal.segment(first, count) = x.segment(first, count);
        std::erase_if(repaired.replaced, [&](Index k) { return k >= stretch.first && k <= stretch.last; });
    }
    std::erase_if(repaired.stretches, is_none);
}

/// Of an error of y; nothing where they are too many or too small to matter.
std::optional<RepairedSignal> isolated_outliers(const Vector& error, double deviation) {
    constexpr double kMaxShare = 0.05;  // of the samples
    if (!error.allFinite()) return std::nullopt;
    RepairedSignal repaired = replace_outliers(error);
    keep_isolated(repaired, error);
    const auto count = static_cast<double>(repaired.replaced.size());
    if (count == 0 || count > kMaxShare * static_cast<double>(error.size())) return std::nullopt;
    if (!((error - repaired.signal).cwiseAbs().maxCoeff() > kMinError * deviation)) return std::nullopt;
    return repaired;
}

/// Outliers can hide the response on which they lie: then a model is fitted to the data without them.
std::optional<RepairedSignal> outliers_of(FittedData& fit, const std::function<bool()>& cancel) {
    constexpr double kMuch = 0.3;  // of the error's power
    const double deviation = fit.deviation();
    std::optional<RepairedSignal> found = isolated_outliers(fit.error, deviation);
    if (!found || (fit.error - found->signal).squaredNorm() < kMuch * fit.error.squaredNorm())
        return fit.trusted() ? found : std::nullopt;
    IdData cleaned = fit.data;
    cleaned.experiments.front().y.col(0) -= fit.error - found->signal;
    std::optional<FittedData> again = fitted_data(cleaned, cancel);
    if (!again || !again->trusted()) return fit.trusted() ? found : std::nullopt;
    const Vector y = fit.y();
    fit = std::move(*again);
    fit.take_off(fit.y() - y);  // the outliers are in the data again
    return isolated_outliers(fit.error, deviation);
}

}  // namespace

void find_error_outliers(FittedData& fit, const std::function<bool()>& cancel, DataIssues& findings) {
    const std::optional<RepairedSignal> repaired = outliers_of(fit, cancel);
    if (!repaired) return;
    const auto count = static_cast<Index>(repaired->replaced.size());
    const Vector outliers = fit.error - repaired->signal;
    fit.take_off(outliers);
    DataIssue issue = about(
        fit, "outliers", Weight::kWarning,
        Message("The output {} has {} far from the neighboring samples ({}), up to {} from the values that the input "
                "explains. Check for invalid samples, and replace them by linear interpolation with filloutliers.",
                fit.output(), plural(count, "{} sample", "{} samples"), listed_places(repaired->stretches),
                fit.with_unit(outliers.cwiseAbs().maxCoeff(), 2)),
        static_cast<double>(count));
    issue.sections = repaired->stretches;
    findings.push_back(std::move(issue));
}

void find_disturbance(FittedData& fit, DataIssues& findings) {
    if (!wanders(fit.error)) return;
    Vector slow = slow_part(error_without_free_motion(fit));
    slow.array() -= slow.mean();
    const double size = std::sqrt(slow.squaredNorm() / static_cast<double>(slow.size()));
    const StraightLine line = straight_line(slow);
    const bool straight = line.share > kStraightLine;
    if (!(size > (straight ? kWorthAWord : kWalkWorthAWord) * fit.deviation())) return;
    // What a poor model leaves may wander for other reasons, unless nearly all of the output does.
    if (!fit.trusted() && size < kNearlyAll * fit.deviation()) return;
    fit.disturbance = size;
    fit.taken_off = slow;
    fit.take_off(slow);
    if (straight)
        findings.push_back(about(
            fit, "drift", Weight::kWarning,
            Message("{} drifts by about {} from the start to the end, which {} does not explain. A model would "
                    "represent the drift as slow dynamics: remove the linear trend with data:detrend(\"linear\").",
                    fit.output(), fit.with_unit(line.rise, 2), fit.input()),
            line.rise));
    else
        findings.push_back(about(
            fit, "random_walk", Weight::kWarning,
            Message("{} drifts irregularly (like a random walk, between {} and {} around the response to {}). A linear "
                    "trend does not describe this drift: filter input and output with the same high-pass filter, or "
                    "estimate a noise model (rivc).",
                    fit.output(), fit.with_unit(slow.minCoeff(), 2), fit.with_unit(slow.maxCoeff(), 2), fit.input()),
            size));
}

namespace {

/// The rms error above which a section counts as strange: far above that of most sections.
double strange_level(const Vector& levels, double deviation) {
    return std::max(kStrange * median(levels), kMinError * deviation);
}

double rms_of(const VectorView& x) {
    return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

Vector levels_of_sections(const Vector& error) {
    const Index length = error.size() / kSections;
    Vector levels(kSections);
    for (Index i = 0; i < kSections; ++i) levels[i] = rms_of(error.segment(i * length, length));
    return levels;
}

/// Sections whose error is far above that of most sections.
std::vector<Segment> strange_sections(const Vector& error, double deviation) {
    const Index length = error.size() / kSections;
    if (length < 5) return {};
    const Vector levels = levels_of_sections(error);
    const double limit = strange_level(levels, deviation);
    std::vector<Segment> sections;
    for (Index i = 0; i < kSections; ++i)
        if (levels[i] > limit) sections.push_back({i * length + 1, (i + 1) * length});
    sections = joined(sections);
    if (static_cast<Index>(sections.size()) > kSections / 4) sections.clear();
    return sections;
}

/// A section at the beginning is the start's business.
bool is_at_the_beginning(const Segment& section) {
    return section.first == 1;
}

}  // namespace

bool find_strange_sections(const FittedData& fit, DataIssues& findings) {
    if (fit.error.size() < 10 * kSlowParts) return false;
    std::vector<Segment> sections = strange_sections(fit.error - slow_part(fit.error), fit.deviation());
    std::erase_if(sections, is_at_the_beginning);
    if (sections.empty()) return false;
    MessageList places;
    for (const auto& [first, last] : sections) places.items.push_back(Message("{} to {}", first, last));
    DataIssue issue =
        about(fit, "nonlinear", Weight::kWarning,
              Message("A linear model follows {} except in samples {}, where its error is more than {} times the "
                      "typical error. Another effect acts there, such as a limit, friction or a disturbance. Inspect "
                      "these samples, and exclude them with data:discard if they are not typical of the plant.",
                      fit.output(), places, kStrange),
              static_cast<double>(sections.size()));
    issue.sections = std::move(sections);
    findings.push_back(std::move(issue));
    return true;
}

bool has_strange_beginning(const FittedData& fit) {
    const std::vector<Segment> sections = strange_sections(fit.error, fit.deviation());
    if (!sections.empty() && is_at_the_beginning(sections.front())) return true;
    const auto masked_seconds = static_cast<Index>(2 * fit.search.delay / fit.data.Ts);
    const Index length = std::max<Index>(5, masked_seconds);
    if (kSections * length > fit.error.size()) return false;
    return rms_of(fit.error.head(length)) > strange_level(levels_of_sections(fit.error), fit.deviation());
}

}  // namespace dynlab::inline numerics
