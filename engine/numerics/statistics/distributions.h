#pragma once

namespace dynlab::inline numerics {

/// P(X > x) for X chi-squared with `degrees` > 0 degrees of freedom (need not be whole). Throws InvalidArgument for
/// degrees that are not positive or an x that is not a number.
double chi_squared_upper_tail(double x, double degrees);

/// The x with P(X <= x) = probability, 0 < probability < 1. Throws InvalidArgument otherwise.
double chi_squared_quantile(double probability, double degrees);

/// Half width, in standard deviations, of the interval that holds a normal variable with this probability:
/// 2.576 for 0.99. Throws InvalidArgument unless 0 < probability < 1.
double normal_half_width(double probability);

/// The x with P(t <= x) = probability, 0 < probability < 1, t Student's with `degrees` > 0 degrees of freedom (need not
/// be whole); for intervals of level 1 - alpha use student_t_quantile(1 - alpha/2, N - d). Throws InvalidArgument
/// outside of these ranges.
double student_t_quantile(double probability, double degrees);

}  // namespace dynlab::inline numerics
