#pragma once
#include <vector>

#include "numerics/filters/filtered_signal.h"

namespace dynlab::inline numerics {

/// The matrix of sums over all N samples
///     M(i, j) = sum_k output_left[i](k) output_right[j](k)
/// where the outputs of all signals are numbered through in order, and after them the `sums` of outputs. Only a piece
/// of the outputs is stored at a time, so that memory does not grow with N. All filters start from the zero state; all
/// signals have N >= 1 samples.
Matrix filter_products(const std::vector<FilteredSignal>& signals, const std::vector<Index>& left,
                       const std::vector<Index>& right, const std::vector<OutputSum>& sums = {});

/// The same of stored outputs: the first columns of `outputs`. The last columns are for the sums, which this fills in.
Matrix stored_products(Matrix& outputs, const std::vector<Index>& left, const std::vector<Index>& right,
                       const std::vector<OutputSum>& sums);

}  // namespace dynlab::inline numerics
