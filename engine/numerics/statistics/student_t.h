#pragma once

namespace dynlab::inline numerics {

/// The x with P(t <= x) = probability, 0 < probability < 1, t Student's with `degrees` > 0 degrees of freedom (need not
/// be whole); for intervals of level 1 - alpha use student_t_quantile(1 - alpha/2, N - d). Throws InvalidArgument
/// outside of these ranges.
double student_t_quantile(double probability, double degrees);

}  // namespace dynlab::inline numerics
