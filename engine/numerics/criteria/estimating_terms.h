#pragma once
#include "numerics/criteria/denominator_group.h"

namespace dynlab::inline numerics {

/// A model B_1/A u_1 + B_2/A u_2 + ..., A monic.
struct CommonDenominator {
    Vector A;
    std::vector<Vector> B;
};

/// The equation p^n y_f = phi' theta of one experiment, all signals filtered by gain/E: N and N x d.
struct FilteredEquation {
    Vector y;
    Matrix Phi;
};
FilteredEquation filtered_equation(const RegressionData& data_set, const VectorView& E, double gain = 1);

/// An estimate solves sum_k z(k) e(k) = 0: the terms of this sum, N x d and N. What its errors scatter by depends on
/// how the terms depend on each other.
struct EstimatingTerms {
    Matrix Z;
    Vector errors;
};

/// The terms of LSSVF (z = phi) or, with an auxiliary model `instrument`, of IVSVF: e = p^n y_f - phi' theta is the
/// error of the equation with all signals filtered by gain/E, E monic of degree n, theta the coefficients of `model`.
/// With v = y - sum B_j/A u_j the error is e = gain A/E v, except for the effect of the hold of y between samples. For
/// regular sampling and a stable model the terms are therefore the instruments, filtered by gain A/E backwards in time,
/// and the output errors v, which no filter has colored.
EstimatingTerms estimating_terms(const RegressionData& data_set, const VectorView& E, double gain,
                                 const CommonDenominator& model, const CommonDenominator* instrument = nullptr);

/// The terms of a group at its `theta`, with an auxiliary model of parameters `instrument`: stacked by experiment and
/// output, unweighted.
EstimatingTerms estimating_terms(const DenominatorGroup& group, const VectorView& E, double gain, const Vector& theta,
                                 const Vector* instrument = nullptr);

}  // namespace dynlab::inline numerics
