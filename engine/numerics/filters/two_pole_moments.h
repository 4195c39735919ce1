#pragma once
#include <optional>

#include "numerics/filters/regression_record.h"

namespace dynlab::inline numerics {

// The sums of regression_moments.h for the commonest of all models: two poles, at most one zero, one input without
// delay, sampled regularly and fast. Every size is known to the compiler, so that preparing the sums of a short record
// does not take longer than summing. Nothing is returned where a record or model is not of that kind, or too short.

/// Signals filtered by gain/E, of the equation error.
std::optional<RegressionMoments> two_pole_svf_moments(const RegressionRecord& record, const VectorView& E, double gain);

/// The input is held.
std::optional<RegressionMoments> two_pole_auxiliary_moments(const RegressionRecord& record, const VectorView& E,
                                                            const VectorView& A, const VectorView& B, double gain);

/// Signals filtered by 1/A, with the exact sensitivities of the simulated output as instruments.
std::optional<RegressionMoments> two_pole_refined_moments(const RegressionRecord& record, const VectorView& A,
                                                          const VectorView& B, bool with_gram);

/// Sums of y y, y x and x x for the output x = B/A u simulated from rest.
std::optional<Eigen::Matrix2d> two_pole_output_moments(const RegressionRecord& record, const VectorView& A,
                                                       const VectorView& B);

}  // namespace dynlab::inline numerics
