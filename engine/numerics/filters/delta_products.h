#pragma once
#include <optional>

#include "numerics/filters/delta_chain.h"

namespace dynlab::inline numerics {

/// Sums over the samples 0 .. N-1 of all products of the columns of two chains.
struct DeltaProducts {
    ColumnMatrix first;   ///< (n1+1) x (n1+1), of the first chain's columns among themselves
    ColumnMatrix both;    ///< (n1+1) x (n2+1)
    ColumnMatrix second;  ///< (n2+1) x (n2+1)
};
/// Products that need not be summed, but may be where that saves a loop.
struct RequestedProducts {
    bool first = true;    ///< those of the first chain's columns among themselves
    bool highest = true;  ///< those with W_n2 of the second chain; `both` and `second` may lack that column otherwise
};

/// Only n1 + n2 + 1 products of different chains and n of a chain's own columns are summed: a difference of a product,
///     delta(X_j W_i) = X_(j+1) W_i + X_j W_(i+1) + X_(j+1) W_(i+1),
/// summed over the record is what X_j W_i has grown (summation by parts), and gives the others without a division,
/// wherever the poles are. So the work grows with the orders and not with their squares. Of each sum of orders i + j
/// the product in the middle is summed; the norms of a signal's differences are log-convex, so that little is lost on
/// the way to the others, and nothing where they are of one signal. The record is cut into segments that run side by
/// side in the lanes of a machine vector. Nothing for a pair of orders that has no loop of its own
/// (delta_loops.cpp), or a short record.
std::optional<DeltaProducts> delta_products(const DeltaChain& first, const DeltaChain& second, Index N,
                                            RequestedProducts requested = {});

}  // namespace dynlab::inline numerics
