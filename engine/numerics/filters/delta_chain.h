#pragma once
#include <array>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

constexpr int kMaxDeltaOrder = 9;

/// A signal v filtered by 1/A(delta) with the operator delta = q - 1 (Middleton and Goodwin 1990), and the differences
/// of what comes out: the columns
///     X_j = delta^j/A v,  j = 0 .. n,    A = delta^n + alpha_(n-1) delta^(n-1) + ... + alpha_0.
/// The state is X_0 .. X_(n-1), and X_n = v - sum alpha_j X_j = X_(n-1)[k+1] - X_(n-1)[k]. Every output of a sampled
/// system with these poles is a combination of the columns, in which derivatives lose no digits: they are differences.
/// v is zero before sample `begin`, at which `start` is added to the state, and after `count` samples.
struct DeltaChain {
    int order = 0;  ///< n <= kMaxDeltaOrder
    std::array<double, kMaxDeltaOrder> alpha = {}, start = {};
    const double* samples = nullptr;
    Index begin = 0, count = 0;
};

/// Largest matrix of products of two chains' columns, without heap memory.
using ColumnMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxDeltaOrder + 1, kMaxDeltaOrder + 1>;

/// Steps without a signal after which less than rounding is left of any state, whatever its size in units of the
/// chain's mean pole; an eighth too many at most. `max_length` where it would be as many.
Index memory_length(const DeltaChain& chain, Index max_length);

}  // namespace dynlab::inline numerics
