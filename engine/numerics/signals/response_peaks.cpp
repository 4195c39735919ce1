#include "numerics/signals/response_peaks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/signals/fourier.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSegments = 4;  // of the shortest experiment
constexpr Index kMinSegmentLength = 64, kMaxSegmentLength = 8192;
constexpr Index kNeighbors = 2;  // on each side, below a peak

Index segment_length(const IdData& data) {
    Index shortest = data.sample_count();
    for (const Experiment& experiment : data.experiments) shortest = std::min(shortest, experiment.y.rows());
    Index length = kMinSegmentLength;
    while (length < kMaxSegmentLength && kSegments * length < shortest) length *= 2;
    return length;
}

/// |S_uy|^2/S_uu at the frequencies 2 pi i/length, i = 1 .. length/2 - 1.
Vector explained_power(const IdData& data, Index length) {
    const Vector phase = Vector::LinSpaced(length, 0.5, static_cast<double>(length) - 0.5) *
                         (std::numbers::pi / static_cast<double>(length));
    const Vector window = phase.array().sin().square();
    const Index lines = length / 2 - 1;
    ComplexVector cross = ComplexVector::Zero(lines);
    Vector input = Vector::Zero(lines);
    for (const Experiment& experiment : data.experiments)
        for (Index first = 0; first + length <= experiment.y.rows(); first += length / 2) {
            Vector u = experiment.u.col(0).segment(first, length), y = experiment.y.col(0).segment(first, length);
            u.array() -= u.mean(), y.array() -= y.mean();
            const TransformPair both = fourier_transforms(u.cwiseProduct(window), y.cwiseProduct(window));
            const auto U = both.first.segment(1, lines), Y = both.second.segment(1, lines);
            cross += U.conjugate().cwiseProduct(Y);
            input += U.cwiseAbs2();
        }
    // Lines that the input does not excite explain nothing.
    return cross.cwiseAbs2().cwiseQuotient((input.array() + 1e-6 * input.maxCoeff() + 1e-300).matrix());
}

}  // namespace

std::vector<double> response_peaks(const IdData& data, std::size_t max_count) {
    if (!data.regular() || data.input_count() == 0) return {};
    const Index length = segment_length(data);
    const Vector power = explained_power(data, length);
    if (!(power.maxCoeff() > 0)) return {};
    std::vector<Index> peaks;
    for (Index i = 0; i < power.size(); ++i) {
        const Index first = std::max<Index>(0, i - kNeighbors), last = std::min(power.size() - 1, i + kNeighbors);
        if (power.segment(first, last - first + 1).maxCoeff() <= power[i]) peaks.push_back(i);
    }
    std::ranges::stable_sort(peaks, [&](Index a, Index b) { return power[a] > power[b]; });
    std::vector<double> frequencies;
    for (std::size_t i = 0; i < std::min(max_count, peaks.size()); ++i)
        frequencies.push_back(2 * std::numbers::pi * static_cast<double>(peaks[i] + 1) /
                              (static_cast<double>(length) * data.Ts));
    return frequencies;
}

}  // namespace dynlab::inline numerics
