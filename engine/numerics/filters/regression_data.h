#pragma once
#include <vector>

#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

using SampleView = Eigen::Map<const Vector>;  ///< samples that the caller owns

/// Sampling of one experiment: every Ts seconds, or (Ts = 0) at the instants t.
struct Sampling {
    double Ts = 0;
    SampleView t{nullptr, 0};
};

/// One equation A(p) y = sum_j B_j(p) u_j(t - delay_j) of degree n over one experiment, as LSSVF, IVSVF and SRIVC solve
/// it.
struct RegressionData {
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
struct NormalEquations {
    Matrix z_phi;    ///< d x d, sum z phi'
    Vector z_y;      ///< d, sum z p^n y_f
    Matrix z_z;      ///< d x d, sum z z', when asked for
    double y_y = 0;  ///< sum (p^n y_f)^2, with z = phi only
};

}  // namespace dynlab::inline numerics
