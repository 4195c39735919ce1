#pragma once
#include <array>
#include <cmath>

#include "numerics/filters/lane_states.h"

namespace dynlab::inline numerics {

/// Which products are wanted: those of the first cascade's columns among themselves, or only with the sample, and those
/// of the second pair of `Second` among themselves.
enum Wanted { kFirstAlone = 1, kFirstWithSample = 2, kSecondPairAlone = 4 };

template <class First, class Second>
using ColumnProducts = Eigen::Matrix<double, First::kColumns + Second::kColumns, First::kColumns + Second::kColumns>;

/// The sums of products over `steps` samples, which the runs go on by. Only those with j >= i are set.
template <class First, class Second, int kWanted, class Number>
[[gnu::always_inline]] inline void run_products(CascadeRun<First, Number>& first, CascadeRun<Second, Number>& second,
                                                Index steps, Number (*total)[First::kColumns + Second::kColumns]) {
    constexpr int kFirst = First::kColumns, kColumns = kFirst + Second::kColumns, kFewColumns = 5;
    constexpr auto left_out = [](int i, int j) {
        if (j < kFirst) return !(kWanted & kFirstAlone) && !(kWanted & kFirstWithSample && j + 1 == kFirst);
        return Second::kOrder == 4 && i >= kFirst + 2 && j < kFirst + 4 && !(kWanted & kSecondPairAlone);
    };
    [[maybe_unused]] const CascadeRun<First, Number> start = first;
    Number sums[kColumns][kColumns] = {};
    for_samples<kColumns <= kFewColumns>(
        first, second, 0, steps, [&](const Number& v, const Number& w) __attribute__((always_inline)) {
            repeat<kColumns>([&](auto i) __attribute__((always_inline)) {
                const Number x = i < kFirst ? first.column(i, v) : second.column(i - kFirst, w);
                repeat<kColumns>([&](auto j) __attribute__((always_inline)) {
                    if constexpr (j >= i && !left_out(i, j))
                        sums[i][j] += x * (j < kFirst ? first.column(j, v) : second.column(j - kFirst, w));
                });
            });
            first.step(v);
            second.step(w);
        });
    if constexpr (kWanted & kFirstWithSample)
        for (int i = 0; i < First::kOrder; ++i)
            for (int j = i; j < First::kOrder; ++j)
                sums[i][j] = first.state(i) * first.state(j) - start.state(i) * start.state(j);
    for (int i = 0; i < kColumns; ++i)
        for (int j = i; j < kColumns; ++j) total[i][j] = sums[i][j];
}

/// Sums of the products of all columns, first those of `First`, then those of `Second`, over kCascadeLanes segments of
/// `segment` samples that follow on the first `leading` ones; zero where they are not wanted. With kFirstWithSample,
/// the places of the states of `First` hold how much these products have grown from the first sample to the end.
template <class First, class Second, int kWanted>
ColumnProducts<First, Second> sum_products(std::array<CascadeSource, 2> sources, Index leading, Index segment) {
    constexpr int kColumns = First::kColumns + Second::kColumns;
    double before[kColumns][kColumns] = {};
    if (leading > 0) {
        CascadeRun<First, double> first(sources[0], 0, 0);
        CascadeRun<Second, double> second(sources[1], 0, 0);
        for (int i = 0; i < First::kOrder; ++i) first.state(i) = sources[0].state[i];
        for (int i = 0; i < Second::kOrder; ++i) second.state(i) = sources[1].state[i];
        run_products<First, Second, kWanted>(first, second, leading, before);
        for (int i = 0; i < First::kOrder; ++i) sources[0].state[i] = first.state(i);
        for (int i = 0; i < Second::kOrder; ++i) sources[1].state[i] = second.state(i);
    }
    CascadeRun<First, Lanes::Part> first(sources[0], leading, segment);
    CascadeRun<Second, Lanes::Part> second(sources[1], leading, segment);
    find_states(first, second, sources, segment);
    Lanes::Part sums[kColumns][kColumns];
    run_products<First, Second, kWanted>(first, second, segment, sums);
    ColumnProducts<First, Second> total;
    for (int i = 0; i < kColumns; ++i)
        for (int j = i; j < kColumns; ++j) {
            double sum = before[i][j];
            for (int lane = 0; lane < kCascadeLanes; ++lane) sum += sums[i][j][lane];
            total(i, j) = total(j, i) = sum;
        }
    return total;
}

/// From what sum_products gives with kFirstWithSample for two equal poles c, the sums P, Q, R of p p, p q and q q:
/// squared, p[k+1] = c p[k] + v[k] and q[k+1] = c q[k] + p[k] say how they grow in a step, summed over the record
///     growth of P = (c^2 - 1) P + 2 c <p,v> + <v,v>   and so on
/// (the Lyapunov equation of the record). False where the terms cancel: a signal with little of what the filter passes.
template <class Products>
bool complete_squares(Products& total, double c) {
    constexpr double kMostCancelled = 10;
    const double left = 1 - c * c, pv = total(0, 2), qv = total(1, 2), vv = total(2, 2);
    const double dP = total(0, 0), dQ = total(0, 1), dR = total(1, 1);
    const double P = (2 * c * pv + vv - dP) / left, size_P = (2 * std::abs(c * pv) + vv + std::abs(dP)) / left;
    const double Q = (c * (P + qv) + pv - dQ) / left;
    const double size_Q = (std::abs(c) * (size_P + std::abs(qv)) + std::abs(pv) + std::abs(dQ)) / left;
    const double R = (2 * c * Q + P - dR) / left, size_R = (2 * std::abs(c) * size_Q + size_P + std::abs(dR)) / left;
    total(0, 0) = P;
    total(0, 1) = total(1, 0) = Q;
    total(1, 1) = R;
    return left > 0 && size_P <= kMostCancelled * P && size_R <= kMostCancelled * R &&
           size_Q <= kMostCancelled * std::sqrt(P * R);
}

}  // namespace dynlab::inline numerics
