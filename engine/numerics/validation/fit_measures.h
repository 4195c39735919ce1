#pragma once
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Measures of how well a simulated output `y_sim` follows the measured `y` (N values each). All throw InvalidArgument
/// for lengths that differ or fewer than two samples.

/// |y - mean(y)|^2, what the measures below relate errors to. Throws for a constant y.
double variation_about_mean(const VectorView& y);

/// R_T^2 = 1 - var(y - y_sim)/var(y): blind to a constant error. Throws for a constant y.
double r_squared_simulation(const VectorView& y, const VectorView& y_sim);

/// Young's information criterion ln(var(e)/var(y)) + ln(mean_i(P_ii/theta_i^2)), e = y - y_sim, P the covariance
/// of theta: the more negative, the better the compromise. Parameters that are exactly zero are left out.
struct YoungCriterion {
    double value = 0;            ///< minus infinity for a perfect fit
    std::vector<Index> skipped;  ///< positions (0-based) of the zero parameters
};
YoungCriterion yic(const VectorView& y, const VectorView& y_sim, const VectorView& theta, const MatrixView& covariance);

/// For the mean square V of N errors and d estimated parameters (Ljung 1999, section 16.4), all per sample:
///     FPE = V (1 + d/N)/(1 - d/N),  AIC = ln V + 2 d/N,  AICc = AIC + 2 d (d + 1)/(N (N - d - 1)),
///     BIC = ln V + d ln(N)/N.
struct InformationCriteria {
    double fpe, aic, aicc, bic;
};
/// Throws InvalidArgument unless V >= 0 and N > d + 1.
InformationCriteria information_criteria(double mean_square, Index samples, Index parameters);

}  // namespace dynlab::inline numerics
