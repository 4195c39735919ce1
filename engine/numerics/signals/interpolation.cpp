#include "numerics/signals/interpolation.h"

#include <algorithm>

#include "numerics/error.h"

namespace dynlab::inline numerics {
namespace {

void check_points(const VectorView& x, const VectorView& y) {
    if (x.size() != y.size())
        throw InvalidArgument("x and y must have the same length, but the length of x is {} and the length of y is {}",
                              x.size(), y.size());
    if (x.size() < 2)
        throw InvalidArgument("interpolation needs at least two points, but x has {}",
                              plural(x.size(), "{} element", "{} elements"));
    for (Index i = 1; i < x.size(); ++i)
        if (!(x[i] > x[i - 1]))
            throw InvalidArgument("x must be increasing, but element {} is not larger than the previous element",
                                  i + 1);
}

}  // namespace

Vector interpolate_linearly(const VectorView& x, const VectorView& y, const VectorView& x_new, Outside outside) {
    check_points(x, y);
    constexpr int kDigits = 15;  // a place just beyond the end must not read like the end
    const Index last = x.size() - 1;
    return x_new.unaryExpr([&](double place) {
        if (outside == Outside::kHold) place = std::clamp(place, x[0], x[last]);
        if (!(place >= x[0] && place <= x[last]))
            throw InvalidArgument(
                "interpolation at {} is not possible, because x ranges from {} to {}. To use the values of the end "
                "points outside this range, specify outside = \"hold\"",
                significant(place, kDigits), significant(x[0], kDigits), significant(x[last], kDigits));
        const Index right = std::clamp<Index>(std::upper_bound(x.begin(), x.end(), place) - x.begin(), 1, last);
        const double part = (place - x[right - 1]) / (x[right] - x[right - 1]);
        return y[right - 1] + part * (y[right] - y[right - 1]);
    });
}

}  // namespace dynlab::inline numerics
