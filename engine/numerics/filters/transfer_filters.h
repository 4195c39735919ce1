#pragma once
#include <vector>

#include "numerics/filters/regression_data.h"

namespace dynlab::inline numerics {

/// What the criteria of continuous-time models ask of filters: how transfer functions answer recorded signals, and the
/// sums over filtered signals that instrumental variables need. Everything is exact for the hold of the signals, which
/// are zero before their first sample; a criterion need not know how it is computed, nor how it is made quick.
/// A = p^n + a_1 p^(n-1) + ... + a_n, B = b_0 p^m + ... + b_m with m <= n and n >= 1, E monic of degree n; N samples.
class TransferFilters {
  public:
    virtual ~TransferFilters() = default;

    /// B/A u(t - delay), N.
    virtual Vector response(const VectorView& B, const VectorView& A, double delay, const VectorView& u,
                            const Sampling& sampling, Hold hold) const = 0;
    /// The same and its derivatives with respect to a_1..a_n, b_0..b_m and the delay, N x (n + m + 3).
    virtual Matrix sensitivities(const VectorView& B, const VectorView& A, double delay, const VectorView& u,
                                 const Sampling& sampling, Hold hold) const = 0;
    /// The solutions of A(p) y = 0 that start from y = 1, dy/dt = 1, ... with all else zero, N x n.
    virtual Matrix free_responses(const VectorView& A, Index N, const Sampling& sampling) const = 0;
    /// Derivatives with respect to a_1..a_n of the one that starts from y, dy/dt, ... = `initial`, N x n.
    virtual Matrix free_sensitivities(const VectorView& A, const VectorView& initial, Index N,
                                      const Sampling& sampling) const = 0;

    /// z = phi, all signals filtered by gain/E.
    virtual NormalEquations svf(const RegressionData& data_set, const VectorView& E, double gain) const = 0;
    /// Signals filtered by gain/E. The instrument uses the auxiliary model's output sum B_j/A u_j, filtered with the
    /// same hold, instead of y.
    virtual NormalEquations auxiliary(const RegressionData& data_set, const VectorView& E, const VectorView& A,
                                      const std::vector<Vector>& B, double gain) const = 0;
    /// Signals filtered by 1/A, and z the sensitivities of the model's output,
    ///     z = [-p^(n-i) sum_j B_j/A^2 u_j, p^(m_j-l)/A u_j];
    /// with_gram: sum z z' in the same run.
    virtual NormalEquations refined(const RegressionData& data_set, const VectorView& A, const std::vector<Vector>& B,
                                    bool with_gram) const = 0;
    /// sum (y - sum_j B_j/A_j u_j)^2, simulated from rest.
    virtual double output_error_squares(const RegressionData& data_set, const std::vector<Vector>& A,
                                        const std::vector<Vector>& B) const = 0;
};

/// Those of this folder: sums while filtering (normal_equations.h), discretized systems (transfer_sensitivity.h).
const TransferFilters& transfer_filters();

}  // namespace dynlab::inline numerics
