#pragma once
#include <algorithm>

#include "numerics/filters/delta_chain.h"
#include "numerics/filters/regression_data.h"
#include "numerics/linalg/state_matrix.h"

namespace dynlab::inline numerics {

// Continuous-time systems as delta chains, exactly for zero-order hold (zoh) and linear interpolation (foh), with any
// delay (s). Sampling must be faster than filtering short data, so that nothing here uses the heap.

constexpr int kMaxDeltaOutputs = kMaxDeltaOrder;

/// dx/dt = A x + [1; 0; ..] u of n <= 4 poles, in `capacity` for all states: the companion form of 1/den, or (`twice`)
/// two of them in a row, the second one driven by the last state of the first. With the step over a sampling interval:
///     x(Ts) = x + E x + H0 u(0) + H1 u(Ts) on a straight line, x + E x + G u(0) for a held input.
template <int capacity>
struct SampledFilter {
    int poles = 0, states = 0;
    double Ts = 0;
    StateMatrix<capacity> A, E;
    StateVector<capacity> G, H0, H1;

    SampledFilter() = default;
    SampledFilter(const VectorView& den, double Ts, bool twice);
    /// The first one of two in a row alone.
    SampledFilter<4> first() const;
};

/// Outputs y = C x + D u of n states.
template <int capacity>
struct StateOutputs {
    int count = 0;
    StateVector<capacity> C[kMaxDeltaOutputs];
    double D[kMaxDeltaOutputs] = {};
};

/// A signal's chain, and outputs as combinations of its columns.
struct DeltaSignal {
    DeltaChain chain;
    int count = 0;
    double outputs[kMaxDeltaOutputs][kMaxDeltaOrder + 1] = {};

    /// Whether the chain's last column is part of any output.
    bool sees_highest() const {
        return std::any_of(outputs, outputs + count, [&](const auto& output) { return output[chain.order] != 0; });
    }
};

/// These outputs of the filter, for an input with a delay of `delay` seconds. `longer`: as a chain of n + 1 columns,
/// which linearly interpolated inputs with a delay between samples need.
template <int capacity>
DeltaSignal delta_signal(const SampledFilter<capacity>& filter, const StateOutputs<capacity>& outputs,
                         const SampleView& u, Hold hold, double delay, bool longer);

}  // namespace dynlab::inline numerics
