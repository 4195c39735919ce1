#pragma once
#include <vector>

#include "numerics/filters/filter_chain.h"

namespace dynlab::inline numerics {

/// One equation A(p) y = sum_j B_j(p) u_j(t - delay_j) of degree n over one record: what LSSVF, IVSVF and SRIVC solve.
struct RegressionRecord {
    SampleView y;
    std::vector<SampleView> u;
    std::vector<int> zeros;      ///< degree m_j <= n of each B_j
    std::vector<double> delays;  ///< s
    Sampling sampling;
    Hold hold = Hold::kZoh;    ///< of the inputs
    Hold hold_y = Hold::kFoh;  ///< of the output inside the filters
};

/// Sums over the samples of the filtered equation p^n y_f = phi' theta with theta = [a_1..a_n, B_1, B_2, ...],
///     phi = [-p^(n-1) y_f .. -y_f, p^m_1 u_f,1 .. u_f,1, ...],
/// multiplied by instruments z (d = number of parameters).
struct RegressionMoments {
    Matrix z_phi;    ///< d x d, sum z phi'
    Vector z_y;      ///< d, sum z p^n y_f
    Matrix z_z;      ///< d x d, sum z z', when asked for
    double y_y = 0;  ///< sum (p^n y_f)^2, with z = phi only
};

/// z = phi, all signals filtered by gain/E(p), E monic of degree n.
RegressionMoments svf_moments(const RegressionRecord& record, const VectorView& E, double gain = 1);

/// Signals filtered by gain/E; the instrument has the auxiliary model's output x = sum B_j/A u_j, simulated exactly and
/// then filtered with the same hold, in the place of y.
RegressionMoments auxiliary_moments(const RegressionRecord& record, const VectorView& E, const VectorView& A,
                                    const std::vector<Vector>& B, double gain = 1);

/// SRIVC: signals filtered by 1/A, and z the exact sensitivities of the model's output,
///     z = [-p^(n-i) sum_j B_j/A^2 u_j, p^(m_j-l)/A u_j];
/// with_gram: sum z z' in the same run.
RegressionMoments refined_moments(const RegressionRecord& record, const VectorView& A, const std::vector<Vector>& B,
                                  bool with_gram = false);

/// sum z z' of these instruments, d x d.
Matrix sensitivity_moments(const RegressionRecord& record, const VectorView& A, const std::vector<Vector>& B);

/// sum (y - sum_j B_j/A_j u_j)^2, simulated from rest; every input may have a denominator of its own here.
double output_error_squares(const RegressionRecord& record, const std::vector<Vector>& A, const std::vector<Vector>& B);

}  // namespace dynlab::inline numerics
