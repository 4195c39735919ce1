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
/// summed over the data is the growth of X_j W_i (summation by parts), and gives the other products without a division,
/// for any poles. The work therefore grows with the orders and not with their squares. Of each sum of orders i + j the
/// middle product is summed. The norms of a signal's differences are log-convex, so that the computation of the others
/// loses little precision, and none for products of one signal. The data are cut into segments that run side by side in
/// the lanes of a machine vector. No value for a pair of orders without a loop (delta_loops.cpp), or for short data.
std::optional<DeltaProducts> delta_products(const DeltaChain& first, const DeltaChain& second, Index N,
                                            RequestedProducts requested = {});

}  // namespace dynlab::inline numerics
