#include "numerics/signals/whitening_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/signals/correlation.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kPredictable = 1e-6;  // part of its power that a signal keeps when its past tells it: a sine, say

/// Calls `take(order, a, rest)` for the best predictor of every order, from 0 on.
template <class Take>
void for_each_order(const Vector& r, Index highest, const Take& take) {
    Vector a = Vector::Unit(highest + 1, 0);
    double rest = r[0];
    take(Index{0}, a, rest);
    for (Index n = 1; n <= highest && rest > kPredictable * r[0]; ++n) {
        const double reflection = -a.head(n).dot(r.segment(1, n).reverse()) / rest;
        const Vector before = a.head(n + 1);
        a.head(n + 1) += reflection * before.reverse();
        rest *= 1 - reflection * reflection;
        take(n, a, rest);
    }
}

}  // namespace

Vector whitening_filter(const Vector& r, Index order) {
    Vector last;
    for_each_order(r, order, [&last](Index, const Vector& a, double) { last = a; });
    return last;
}

Vector whitening_filter_of(const VectorView& x, Index highest) {
    const Index N = x.size(), most = std::min(highest, N / 3);
    if (most < 1) return Vector::Ones(1);
    const Vector centred = x.array() - x.mean();
    const Vector r = lagged_products(centred, centred, most).tail(most + 1);
    if (!(r[0] > 0)) return Vector::Ones(1);
    Vector best = Vector::Ones(1);
    double least = std::numeric_limits<double>::infinity();
    for_each_order(r, most, [&](Index order, const Vector& a, double rest) {
        const auto samples = static_cast<double>(N);
        const double bic = samples * std::log(std::max(rest, 1e-300)) + static_cast<double>(order) * std::log(samples);
        if (!(bic < least)) return;
        least = bic;
        best = a.head(order + 1);
    });
    return best;
}

Vector filtered_past(const Vector& a, const VectorView& x) {
    const Index n = a.size() - 1, count = x.size() - n;
    Vector result = Vector::Zero(count);
    for (Index i = 0; i <= n; ++i) result += a[i] * x.segment(n - i, count);
    return result;
}

}  // namespace dynlab::inline numerics
