#pragma once
#include <optional>

#include "numerics/filters/regression_data.h"

namespace dynlab::inline numerics {

// The sums of normal_equations.h for models of one to four poles with any zeros, inputs and delays, regularly sampled:
// by delta_products. No value is returned for other models and for short data.

/// Signals filtered by gain/E, of the equation error.
std::optional<NormalEquations> delta_svf_equations(const RegressionData& data_set, const VectorView& E, double gain);

/// For held inputs and models with more poles than zeros, whose output does not jump at the first sample.
std::optional<NormalEquations> delta_auxiliary_equations(const RegressionData& data_set, const VectorView& E,
                                                         const VectorView& A, const std::vector<Vector>& B,
                                                         double gain);

/// Signals filtered by 1/A, with the exact sensitivities of the simulated output as instruments.
std::optional<NormalEquations> delta_refined_equations(const RegressionData& data_set, const VectorView& A,
                                                       const std::vector<Vector>& B, bool with_gram);

/// Sums of products of y, B_1/A_1 u_1, B_2/A_2 u_2, ..., simulated from rest; all A_j of one degree.
std::optional<Matrix> delta_output_products(const RegressionData& data_set, const std::vector<Vector>& A,
                                            const std::vector<Vector>& B);

}  // namespace dynlab::inline numerics
