#include "numerics/signals/extension.h"

namespace dynlab::inline numerics {

Vector point_reflected(const VectorView& x, Index margin) {
    const Index N = x.size();
    Vector extended(N + 2 * margin);
    extended.segment(margin, N) = x;
    if (N == 1) {
        extended.setConstant(x[0]);
        return extended;
    }
    const Index period = 2 * (N - 1);  // after two reflections a signal is shifted by twice its rise
    const auto folded = [&](Index k) {
        const Index turns = k >= 0 ? k / period : -((period - 1 - k) / period);
        const Index rest = k - turns * period;
        const double rise = x[N - 1] - x[0];
        return 2 * rise * static_cast<double>(turns) + (rest < N ? x[rest] : 2 * x[N - 1] - x[period - rest]);
    };
    for (Index k = 1; k <= margin; ++k) {
        extended[margin - k] = folded(-k);
        extended[margin + N - 1 + k] = folded(N - 1 + k);
    }
    return extended;
}

}  // namespace dynlab::inline numerics
