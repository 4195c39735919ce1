#pragma once
#include "numerics/fit/arma_noise.h"
#include "numerics/fit/transfer_estimate.h"

namespace dynlab::inline numerics {

struct NoiseOrders {
    int nc = 0, nd = 0;  ///< coefficients of C and D after the leading one

    /// Throws InvalidArgument for negative orders.
    void validate() const;
};

/// The estimate, with these fields of another meaning than for srivc: `noise_variance` is that of the white e (squares
/// of the prediction error over samples used - parameters), `covariance` is noise_variance (Psi'Psi)^-1 with the
/// instruments Psi filtered by D/C. `fit_percent` and `loss` are of the simulation as ever.
struct RivcResult : TransferEstimate {
    Vector C, D;              ///< monic, nc + 1 and nd + 1; C and D in powers of q^-1 (z^nc.. when read as polynomials)
    Vector C_std, D_std;      ///< of the same lengths, zero for the leading one
    Matrix noise_covariance;  ///< of [c_1..c_nc d_1..d_nd]; theta and the noise model are asymptotically independent
};

/// Refined instrumental variables for continuous-time models with discrete-time noise, for the hybrid CBJ structure
///     y = sum_j B_j(p)/F_j(p) u_j(t - delay_j) + v,   v(k) = C(q^-1)/D(q^-1) e(k),  e white.
/// From srivc's estimate each pass fits C and D to the simulation error (kernels/arma_noise.h), and then solves
///     sum_k [D/C z(k)] [D/C (y(k) - simulated output(k))] = 0,
/// the instrumental equations whose instruments z are the exact sensitivities of the simulated output, by Gauss-Newton
/// steps that are damped until the prediction error falls. It ends when a pass changes neither theta nor C and D by
/// more than Tol; the fixed point minimises the prediction error. Efficient for ARMA noise of these orders; with nc =
/// nd = 0 it is srivc. One output; several inputs and experiments; free delays, initial states and offsets as srivc
/// chose or found them, refined jointly. Non-convergence and doubtful results are told in `warnings`. Throws
/// InvalidArgument as srivc, for irregular sampling, and for several outputs. Reference: Young, Garnier and Gilson in
/// Garnier and Wang (2008), chapter 4.
RivcResult rivc(const IdData& data, const TransferStructure& structure, const NoiseOrders& orders,
                const TransferOptions& options = {});

}  // namespace dynlab::inline numerics
