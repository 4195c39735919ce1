#pragma once
#include "numerics/fit/discrete/arma_noise.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

struct NoiseOrders {
    int nc = 0, nd = 0;  ///< coefficients of C and D after the leading one

    /// Throws InvalidArgument for negative orders.
    void validate() const;
};

/// Refined instrumental variables for continuous-time models with discrete-time noise, for the hybrid CBJ structure
///     y = sum_j B_j(p)/F_j(p) u_j(t - delay_j) + v,   v(k) = C(q^-1)/D(q^-1) e(k),  e white.
/// What it computes is the prediction-error estimate: from srivc's fit, passes fit C and D to the simulation error
/// (fit/discrete/arma_noise.h) and then minimize the sum of squares of e = D/C (y - simulated output), the output
/// whitened with the noise model found, by Levenberg-Marquardt. Where that ends,
///     sum_k [D/C z(k)] [D/C (y(k) - simulated output(k))] = 0,
/// the instrumental equations of RIVC whose instruments z are the exact sensitivities of the simulated output. The
/// passes end when one changes neither theta nor C and D by more than the tolerance. The estimate is efficient for ARMA
/// noise of these orders; with nc = nd = 0 it is srivc. Data: one output, several inputs and experiments. Free delays,
/// initial states and offsets start as srivc selected or estimated them, and are refined jointly. A stable start stays
/// stable. With an estimated start, the samples at the beginning that unknown inputs still affect are left out
/// (fit/transfer_refinement.h). The fit's noise_variance is that of e, its covariance noise_variance (Psi'Psi)^-1 with
/// the sensitivities Psi filtered by D/C; theta and the noise model are asymptotically independent. `warnings` reports
/// non-convergence and doubtful results. Throws InvalidArgument as srivc, for irregular sampling, and for several
/// outputs. Reference: Young, Garnier and Gilson in Garnier and Wang (2008), chapter 4.
Fit rivc(const IdData& data, const TransferStructure& structure, const NoiseOrders& orders,
         const FitOptions& options = {});

}  // namespace dynlab::inline numerics
