#include "numerics/signals/random_phase_multisine.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "numerics/error.h"
#include "numerics/signals/fourier.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMinSamples = 8, kSmallestGroup = 2;
constexpr std::uint32_t kGridSeed = 1;

std::vector<double> chosen_lines(Index period, const RandomPhaseOptions& options) {
    std::vector<double> lines(options.lines.begin(), options.lines.end());
    for (Index k = 1; options.lines.size() == 0 && 2 * k < period; ++k) lines.push_back(static_cast<double>(k));
    std::sort(lines.begin(), lines.end());
    if (options.odd) std::erase_if(lines, [](double line) { return std::fmod(line, 2) == 0; });
    return lines;
}

Vector as_vector(const std::vector<double>& values) {
    return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

/// Moves one of each whole group to the lines that detect.
void draw_detection(Index group, std::vector<double>& lines, std::vector<double>& detection) {
    RandomStream grid(kGridSeed);
    std::vector<double> kept;
    const auto size = static_cast<std::size_t>(group);
    for (std::size_t first = 0; first < lines.size(); first += size) {
        const bool whole = first + size <= lines.size();
        const auto out = static_cast<std::size_t>(std::floor(grid.uniform() * static_cast<double>(group)));
        for (std::size_t i = 0; i < size && first + i < lines.size(); ++i)
            (whole && i == out ? detection : kept).push_back(lines[first + i]);
    }
    lines = kept;
}

/// sum cos(2 pi k n/N + phase_k) over n, as transforms of the cosines and sines of the phases.
Vector sum_of_cosines(Index period, const Vector& lines, const Vector& phases) {
    Vector cosines = Vector::Zero(period), sines = Vector::Zero(period);
    for (Index i = 0; i < lines.size(); ++i) {
        const auto k = static_cast<Index>(lines[i]);
        cosines[k] = std::cos(phases[i]), sines[k] = std::sin(phases[i]);
    }
    const TransformPair pair = fourier_transforms(cosines, sines);
    return pair.first.real() + pair.second.imag();
}

double crest_of(const Vector& u) {
    return u.cwiseAbs().maxCoeff() / std::sqrt(u.squaredNorm() / static_cast<double>(u.size()));
}

/// Clips the peaks, takes the phases of what is left, and keeps the best period met.
Vector with_low_peaks(Vector u, const Vector& lines) {
    constexpr int kRounds = 200;
    constexpr double kClip = 0.9;
    Vector best = u;
    for (int round = 0; round < kRounds; ++round) {
        const double limit = kClip * u.cwiseAbs().maxCoeff();
        const ComplexVector U = fourier_transform(u.cwiseMax(-limit).cwiseMin(limit));
        Vector phases(lines.size());
        for (Index i = 0; i < lines.size(); ++i) phases[i] = std::arg(U[static_cast<Index>(lines[i])]);
        u = sum_of_cosines(u.size(), lines, phases);
        if (crest_of(u) < crest_of(best)) best = u;
    }
    return best;
}

}  // namespace

void RandomPhaseOptions::validate(Index period) const {
    if (period < kMinSamples)
        throw InvalidArgument("multisine: a period needs at least {} samples, but has {}", kMinSamples, period);
    const Index last = (period - 1) / 2;
    for (const double line : lines)
        if (line != std::floor(line) || line < 1 || line > static_cast<double>(last))
            throw InvalidArgument(
                "multisine: lines must be whole numbers of cycles per period, from 1 to {}, but one is {}", last, line);
    std::vector<double> sorted(lines.begin(), lines.end());
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end())
        throw InvalidArgument("multisine: each line may occur only once, but {} occurs several times", *twice);
    if (detection != 0 && detection < kSmallestGroup)
        throw InvalidArgument("multisine: each group omits one line, so a group needs at least 2 lines, not {}",
                              detection);
    if (!(amplitude > 0) || !std::isfinite(amplitude))
        throw InvalidArgument("multisine: the amplitude must be positive, but is {}", amplitude);
}

RandomPhaseMultisine random_phase_multisine(Index period, const RandomPhaseOptions& options, RandomStream& phases) {
    options.validate(period);
    std::vector<double> lines = chosen_lines(period, options), detection;
    if (options.detection > 0) draw_detection(options.detection, lines, detection);
    if (lines.empty())
        throw InvalidArgument(
            "multisine: no line remains to be excited; with option 'odd', specify at least one odd line");
    RandomPhaseMultisine result;
    result.lines = as_vector(lines), result.detection = as_vector(detection);
    result.u = sum_of_cosines(period, result.lines, 2 * std::numbers::pi * phases.uniform(result.lines.size()));
    if (options.low_crest) result.u = with_low_peaks(result.u, result.lines);
    result.u *= options.amplitude * std::sqrt(2 / static_cast<double>(lines.size()));
    result.crest = crest_of(result.u);
    return result;
}

}  // namespace dynlab::inline numerics
