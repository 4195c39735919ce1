#pragma once
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// N times the covariance of the correlations r_a = (1/N) sum_t e(t) u(t - a), a = 0..L, over all t of a record for
/// which u(t - a) is in the record too, for a stationary e that u does not touch and from which the record's mean was
/// taken: exact for a white e, for records however short. Of several records, N samples in all, the sums are added.
/// `Re` holds the covariances of e at lags -reach..reach (a white e has one, its variance), `g` at h = 0..L the sums
/// (1/N) sum_k Re(k) sum_t u(t + k) u(t + h), and `u` a vector with mean zero per record. (L + 1) x (L + 1). For
/// u(t + a) in place of u(t - a) give the records backwards.
/// Far from the ends of a record the covariances are those of Ljung (1999, section 16.6), g(|a - b|); what they lack is
/// what the input, moved on by a, would do beyond the end.
Matrix lagged_sum_covariance(const VectorView& g, const VectorView& Re, const std::vector<Vector>& u);

/// P(R^2 > part), R^2 being the part of a normal white noise, in a space of `dimension` dimensions, that falls into
/// `directions` of them that have nothing to do with it: Beta(directions/2, (dimension - directions)/2). dimension R^2
/// tends to chi-squared with many dimensions. 1 without a direction or where they span all dimensions.
double explained_part_upper_tail(double part, double directions, double dimension);

/// Number of values in all records together.
double total_size(const std::vector<Vector>& records);

/// (1/N) sum_k x(k + lag) y(k) over all records, lags -lags..lags, N values in all.
Vector lagged_covariances(const std::vector<Vector>& x, const std::vector<Vector>& y, Index lags);

}  // namespace dynlab::inline numerics
