#pragma once

namespace dynlab {

/// Regularised incomplete beta function I_x(a, b) for a, b > 0 and 0 <= x <= 1, by the continued fraction of
/// DLMF 8.17.22 (modified Lentz). Relative accuracy about 1e-13 for a, b up to 1e3. Throws InvalidArgument
/// outside that domain.
double incomplete_beta(double a, double b, double x);

/// P(t <= x) of Student's t with `degrees` > 0 degrees of freedom (need not be whole).
double student_t_cdf(double x, double degrees);

/// The x with P(t <= x) = probability, 0 < probability < 1; for intervals of level 1 - alpha use
/// student_t_quantile(1 - alpha/2, N - d). Throws InvalidArgument otherwise.
double student_t_quantile(double probability, double degrees);

}  // namespace dynlab
