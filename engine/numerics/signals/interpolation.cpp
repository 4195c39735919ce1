#include "numerics/signals/interpolation.h"

#include <algorithm>
#include <sstream>

#include "base/number_text.h"
#include "numerics/error.h"

namespace dynlab::inline numerics {
namespace {

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
    std::ostringstream message;
    (message << ... << parts);
    throw InvalidArgument(message.str());
}

void check_points(const VectorView& x, const VectorView& y) {
    if (x.size() != y.size()) refuse("x has ", x.size(), " values, but y has ", y.size());
    if (x.size() < 2) refuse("interpolation needs at least two points, but ", x.size(), " was given");
    for (Index i = 1; i < x.size(); ++i)
        if (!(x[i] > x[i - 1]))
            refuse("x must increase, but its element ", i + 1, " is not larger than the one before it");
}

}  // namespace

Vector interpolate_linearly(const VectorView& x, const VectorView& y, const VectorView& x_new, Outside outside) {
    check_points(x, y);
    constexpr int kDigits = 15;  // a place just beyond the end must not read like the end
    const Index last = x.size() - 1;
    return x_new.unaryExpr([&](double place) {
        if (outside == Outside::kHold) place = std::clamp(place, x[0], x[last]);
        if (!(place >= x[0] && place <= x[last]))
            refuse("there is no value at ", number_text(place, kDigits), ": x goes from ", number_text(x[0], kDigits),
                   " to ", number_text(x[last], kDigits));
        const Index right = std::clamp<Index>(std::upper_bound(x.begin(), x.end(), place) - x.begin(), 1, last);
        const double part = (place - x[right - 1]) / (x[right] - x[right - 1]);
        return y[right - 1] + part * (y[right] - y[right - 1]);
    });
}

}  // namespace dynlab::inline numerics
