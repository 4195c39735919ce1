#pragma once
#include <optional>
#include <vector>

#include "numerics/filters/filtered_signal.h"

namespace dynlab::inline numerics {

/// The matrix of filter_moments for one signal, an output's and an input's, or, after these, the same input through
/// another system in series with the filter (joint_basis), in few multiplications per
/// sample: the moments of states in the basis of CascadeBasis are summed, in registers, segments of the record side by
/// side; those of the outputs are linear in them. Nothing where a system has no such basis, or the record is short.
std::optional<Matrix> cascade_moments(const std::vector<FilteredSignal>& signals, const std::vector<Index>& left,
                                      const std::vector<Index>& right);

}  // namespace dynlab::inline numerics
