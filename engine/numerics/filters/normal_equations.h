#pragma once
#include <vector>

#include "numerics/filters/regression_data.h"

namespace dynlab::inline numerics {

/// z = phi, all signals filtered by gain/E(p), E monic of degree n.
NormalEquations svf_equations(const RegressionData& data_set, const VectorView& E, double gain = 1);

/// Signals filtered by gain/E. The instrument uses the auxiliary model's output x = sum B_j/A u_j instead of y,
/// simulated exactly and then filtered with the same hold.
NormalEquations auxiliary_equations(const RegressionData& data_set, const VectorView& E, const VectorView& A,
                                    const std::vector<Vector>& B, double gain = 1);

/// SRIVC: signals filtered by 1/A, and z the exact sensitivities of the model's output,
///     z = [-p^(n-i) sum_j B_j/A^2 u_j, p^(m_j-l)/A u_j];
/// with_gram: sum z z' in the same run.
NormalEquations refined_equations(const RegressionData& data_set, const VectorView& A, const std::vector<Vector>& B,
                                  bool with_gram = false);

/// sum (y - sum_j B_j/A_j u_j)^2, simulated from rest; every input can have a separate denominator here.
double output_error_squares(const RegressionData& data_set, const std::vector<Vector>& A, const std::vector<Vector>& B);

}  // namespace dynlab::inline numerics
