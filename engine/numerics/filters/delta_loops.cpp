#include "numerics/filters/delta_loops.h"

#include <utility>

namespace dynlab::inline numerics {

namespace {

using Part = Lanes::Part;

/// f(v, w) for so many samples of two signals in all lanes. The next tile is brought into lanes while this one is
/// worked on: shuffles wait for nothing, while a filter waits for itself. The last tile ends with the last step; where
/// there are fewer steps than in a tile, samples before the first one are read.
template <class Function>
[[gnu::always_inline]] inline void for_steps(const SegmentSamples& v, const SegmentSamples& w, Index steps,
                                             const Function& f) {
    constexpr Index kAhead = 128;  // samples; the hardware prefetcher stops at the end of every page of memory
    Part tiles[2][2][kDeltaLanes];
    const auto bring = [&](Index from, Part(*tile)[kDeltaLanes]) __attribute__((always_inline)) {
        Lanes::gather_tile(v.samples + from, v.stride, tile[0]);
        Lanes::gather_tile(w.samples + from, w.stride, tile[1]);
        for (int lane = 0; lane < kDeltaLanes; ++lane) {
            __builtin_prefetch(v.samples + from + kAhead + lane * v.stride);
            __builtin_prefetch(w.samples + from + kAhead + lane * w.stride);
        }
    };
    const Index last = steps - kDeltaLanes;
    bring(std::min<Index>(0, last), tiles[0]);
    Index k = 0;
    int now = 0;
    for (; k <= last; k += kDeltaLanes, now = 1 - now) {
        bring(std::min(k + kDeltaLanes, last), tiles[1 - now]);
#pragma GCC unroll 1  // unrolled, the loop takes a tenth longer
        for (int j = 0; j < kDeltaLanes; ++j) f(tiles[now][0][j], tiles[now][1][j]);
    }
#pragma GCC unroll 1
    for (Index j = k - last; j < kDeltaLanes; ++j) f(tiles[now][0][j], tiles[now][1][j]);
}

/// columns2: of those of the second chain, how many are multiplied.
template <int n1, int n2, bool of_first, int columns2>
void sum_loop(const DeltaChain& first, const DeltaChain& second, const SegmentSamples& v, const SegmentSamples& w,
              Index steps, DeltaState& state, DeltaSums& sums) {
    Part x[n1 + 1], y[n2 + 1], of_x[n1 + 1], both[n1 + columns2], of_y[columns2];
    double alpha[n1 + 1], beta[n2 + 1];
    std::copy_n(first.alpha.data(), n1, alpha);
    std::copy_n(second.alpha.data(), n2, beta);
    repeat<n1>([&](auto j) { x[j] = state.first[j]; });
    repeat<n2>([&](auto j) { y[j] = state.second[j]; });
    if constexpr (of_first) repeat<n1 + 1>([&](auto j) { of_x[j] = sums.first[j]; });
    repeat<n1 + columns2>([&](auto s) { both[s] = sums.both[s]; });
    repeat<columns2>([&](auto j) { of_y[j] = sums.second[j]; });
    for_steps(
        v, w, steps, [&](const Part& sample1, const Part& sample2) __attribute__((always_inline)) {
            x[n1] = sample1;
            y[n2] = sample2;
            repeat<n1>([&](auto j) __attribute__((always_inline)) { x[n1] -= alpha[j] * x[j]; });
            repeat<n2>([&](auto j) __attribute__((always_inline)) { y[n2] -= beta[j] * y[j]; });
            if constexpr (of_first)
                repeat<n1 + 1>([&](auto j) __attribute__((always_inline)) { of_x[j] += x[j] * x[j]; });
            repeat<n1 + columns2>([&](auto s) __attribute__((always_inline)) {
                constexpr int j = summed_row(n1, columns2 - 1, s);
                both[s] += x[j] * y[s - j];
            });
            repeat<columns2>([&](auto j) __attribute__((always_inline)) { of_y[j] += y[j] * y[j]; });
            repeat<n1>([&](auto j) __attribute__((always_inline)) { x[j] += x[j + 1]; });
            repeat<n2>([&](auto j) __attribute__((always_inline)) { y[j] += y[j + 1]; });
        });
    repeat<n1>([&](auto j) { state.first[j] = x[j]; });
    repeat<n2>([&](auto j) { state.second[j] = y[j]; });
    if constexpr (of_first) repeat<n1 + 1>([&](auto j) { sums.first[j] = of_x[j]; });
    repeat<n1 + columns2>([&](auto s) { sums.both[s] = both[s]; });
    repeat<columns2>([&](auto j) { sums.second[j] = of_y[j]; });
}

template <int n1, int n2>
void filter_loop(const DeltaChain& first, const DeltaChain& second, const SegmentSamples& v, const SegmentSamples& w,
                 Index steps, DeltaState& state, DeltaState& free) {
    Part x[n1 + 1], y[n2 + 1], free_x[n1 + 1], free_y[n2 + 1];
    double alpha[n1 + 1], beta[n2 + 1];
    std::copy_n(first.alpha.data(), n1, alpha);
    std::copy_n(second.alpha.data(), n2, beta);
    repeat<n1>([&](auto j) { x[j] = state.first[j], free_x[j] = free.first[j]; });
    repeat<n2>([&](auto j) { y[j] = state.second[j], free_y[j] = free.second[j]; });
    for_steps(
        v, w, steps, [&](const Part& sample1, const Part& sample2) __attribute__((always_inline)) {
            x[n1] = sample1;
            y[n2] = sample2;
            free_x[n1] = free_y[n2] = Part{};
            repeat<n1>([&](auto j) __attribute__((always_inline)) {
                x[n1] -= alpha[j] * x[j];
                free_x[n1] -= alpha[j] * free_x[j];
            });
            repeat<n2>([&](auto j) __attribute__((always_inline)) {
                y[n2] -= beta[j] * y[j];
                free_y[n2] -= beta[j] * free_y[j];
            });
            repeat<n1>([&](auto j) __attribute__((always_inline)) { x[j] += x[j + 1], free_x[j] += free_x[j + 1]; });
            repeat<n2>([&](auto j) __attribute__((always_inline)) { y[j] += y[j + 1], free_y[j] += free_y[j + 1]; });
        });
    repeat<n1>([&](auto j) { state.first[j] = x[j], free.first[j] = free_x[j]; });
    repeat<n2>([&](auto j) { state.second[j] = y[j], free.second[j] = free_y[j]; });
}

}  // namespace

/// The loops that regressions with one to four poles need. They combine an output (or an unfiltered signal) with an
/// input, and inputs with each other. The input's order is that of the model, or twice that order for its
/// sensitivities, and one more for a delay between samples with linearly interpolated inputs, which always have the
/// highest column.
DeltaLoops delta_loops(int order1, int order2, RequestedProducts requested) {
    constexpr std::true_type yes;
    constexpr std::false_type no;
    DeltaLoops loops;
    const auto pair = [&](auto n1, auto n2, auto first, auto without_highest) {
        if (order1 != n1 || order2 != n2 || (requested.first && !first)) return;
        loops.filter = filter_loop<n1, n2>;
        loops.sum = sum_loop<n1, n2, first, n2 + 1>;
        loops.summed = {first, true};
        if constexpr (without_highest) {
            if (requested.highest) return;
            loops.sum = sum_loop<n1, n2, first, n2>;
            loops.summed.highest = false;
        }
    };
    repeat<5>([&](auto i) {
        pair(std::integral_constant<int, 0>(), std::integral_constant<int, i + 1>(), yes,
             std::bool_constant<(i < 4)>());
    });
    repeat<9>([&](auto i) {
        constexpr std::integral_constant<int, i + 1> n;
        pair(n, n, yes, std::bool_constant<(n <= 4 || n == 6 || n == 8)>());
    });
    repeat<4>([&](auto i) {
        constexpr std::integral_constant<int, i + 1> n;
        pair(n, std::integral_constant<int, n + 1>(), yes, no);
        pair(n, std::integral_constant<int, 2 * n>(), no, yes);
        pair(n, std::integral_constant<int, 2 * n + 1>(), no, no);
    });
    return loops;
}

}  // namespace dynlab::inline numerics
