#pragma once
#include <optional>
#include <vector>

#include "numerics/filters/filter_products.h"
#include "numerics/filters/regression_data.h"
#include "numerics/filters/sensitivity_system.h"

namespace dynlab::inline numerics {

/// A model before a filter, sampled in between: the model's first output is the filter's input.
struct FrontModel {
    SingleInputSystem system;
    Hold hold = Hold::kZoh;  ///< of the signal
    double delay = 0;        ///< s
};

/// A signal and the continuous-time filter it runs through, whose outputs are looked at.
struct FilterChain {
    SampleView signal;
    SingleInputSystem filter;
    Hold hold = Hold::kZoh;  ///< of what enters the filter
    double delay = 0;        ///< s, before the filter; 0 with a front model, which has its own
    std::optional<FrontModel> front = {};
};

/// The filter whose outputs are the derivatives p^highest ... p^0 of the signal, divided by the monic `den` of degree
/// n >= highest (the n-th by identity).
SingleInputSystem derivatives_filter(const VectorView& den, Index highest);

/// M(i, j) = sum over all samples of output_left[i] output_right[j]. The outputs of all chains are numbered in order,
/// followed by the sums. All filters are at rest at the first sample. The result is exact. For regular sampling no
/// output is stored (filter_products.h); for irregular sampling IrregularFilter is used.
Matrix chain_products(const std::vector<FilterChain>& chains, const Sampling& sampling, const std::vector<Index>& left,
                      const std::vector<Index>& right, const std::vector<OutputSum>& sums = {});

/// The outputs of one chain themselves, N x p.
Matrix chain_outputs(const FilterChain& chain, const Sampling& sampling);

/// B/A as a system; A monic, B of no higher degree.
SingleInputSystem transfer_system(const VectorView& B, const VectorView& A);
/// A signal as it is: a filter with the output 1 u and no state.
SingleInputSystem no_filter();

}  // namespace dynlab::inline numerics
