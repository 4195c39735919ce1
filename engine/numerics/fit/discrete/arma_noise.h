#pragma once
#include <vector>

#include "numerics/fit/fit.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Colored noise v = C(q^-1)/D(q^-1) e, e white: C = 1 + c_1 q^-1 + ..., D = 1 + d_1 q^-1 + ..., both with all roots
/// inside the unit circle.
struct ArmaNoise {
    Vector C, D;          ///< nc + 1 and nd + 1, the weight of the present sample (one) first
    Matrix covariance;    ///< of [c_1..c_nc d_1..d_nd]
    double variance = 0;  ///< of e: its squares/(samples used - nc - nd)
    Termination termination = Termination::kConverged;

    static ArmaNoise white(int nc, int nd);  ///< C = D = 1, padded with zeros to the orders
};

/// e = D/C v for one experiment. The first nd values are zero, because the v before the first sample are unknown. From
/// there on the recursion takes the e before as zero (the conditional likelihood). Linear in v, column by column.
Matrix whitened(const ArmaNoise& noise, const MatrixView& v);

/// Derivatives of v - whitened(v) with respect to [c_1..c_nc d_1..d_nd], where e = whitened(v): q^-j e/C and -q^-i v/C.
Matrix noise_sensitivities(const ArmaNoise& noise, const VectorView& v, const VectorView& e);

/// All roots of the monic polynomial in q^-1 lie inside the unit circle.
bool inside_unit_circle(const Vector& p);
/// The same polynomial with roots outside the unit circle replaced by their mirror images, and those on it moved in.
Vector reflect_roots_into_unit_circle(const Vector& p);

/// Returns the C and D for which sum e^2 over all experiments is smallest, given the first nd values of each. The
/// search starts from `start` if given, otherwise from Hannan and Rissanen's (1982) two regressions with roots mirrored
/// into the unit circle. Damped Gauss-Newton with exact derivatives follows, which keeps all roots inside the unit
/// circle. Throws InvalidArgument for negative orders or too few samples for a first regression. References: Box and
/// Jenkins (1976), chapter 7; Ljung (1999), section 10.2.
ArmaNoise estimate_arma(const std::vector<Vector>& data_sets, int nc, int nd, double tolerance,
                        const ArmaNoise* start = nullptr);

}  // namespace dynlab::inline numerics
