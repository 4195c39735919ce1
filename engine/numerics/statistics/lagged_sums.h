#pragma once
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// N times the covariance of the correlations r_a = (1/N) sum_t e(t) u(t - a), a = 0..L, over all t for which u(t - a)
/// is in the data, for a stationary e that is independent of u and from which the mean of the data was subtracted. The
/// result is exact for a white e, for data of any length. Of several experiments, N samples in all, the sums are added.
/// `Re` contains the covariances of e at lags -reach..reach (a white e has one, its variance), `g` at h = 0..L the sums
/// (1/N) sum_k Re(k) sum_t u(t + k) u(t + h), and `u` one vector with mean zero per experiment. The result is (L + 1) x
/// (L + 1). For u(t + a) instead of u(t - a) pass the data in reverse order. Far from the ends of the data the
/// covariances are those of Ljung (1999, section 16.6), g(|a - b|). Near the ends, the contribution of the input
/// shifted by a beyond the end is missing.
Matrix lagged_sum_covariance(const VectorView& g, const VectorView& Re, const std::vector<Vector>& u);

/// P(R^2 > part), R^2 being the part of a normal white noise, in a space of `dimension` dimensions, that falls into
/// `directions` of them that have nothing to do with it: Beta(directions/2, (dimension - directions)/2). dimension R^2
/// tends to chi-squared with many dimensions. 1 without a direction or where they span all dimensions.
double explained_part_upper_tail(double part, double directions, double dimension);

/// Number of values in all experiments together.
double total_size(const std::vector<Vector>& data_sets);

/// (1/N) sum_k x(k + lag) y(k) over all experiments, lags -lags..lags, N values in all.
Vector lagged_covariances(const std::vector<Vector>& x, const std::vector<Vector>& y, Index lags);

}  // namespace dynlab::inline numerics
