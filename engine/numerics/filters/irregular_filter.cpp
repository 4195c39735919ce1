#include "numerics/filters/irregular_filter.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace dynlab::inline numerics {

IrregularFilter::IrregularFilter(Matrix A, Vector B, Matrix C, Vector D, Hold hold, double delay)
    : A_(std::move(A)), C_(std::move(C)), B_(std::move(B)), D_(std::move(D)), hold_(hold), delay_(delay) {}

const StepMatrices& IrregularFilter::step(double length) {
    constexpr std::size_t kMostSteps = 4096;  // random sampling has no repeated steps worth remembering
    const auto known = steps_.find(length);
    if (known != steps_.end()) return known->second;
    if (steps_.size() >= kMostSteps) steps_.clear();
    return steps_.emplace(length, exact_step(A_, B_, length)).first->second;
}

/// The delayed input at `time`, on the segment that begins with sample `segment` (-1: not yet begun).
double IrregularFilter::input_at(const VectorView& u, const VectorView& t, Index segment, double time) const {
    if (segment < 0) return 0;
    if (hold_ == Hold::kZoh || segment + 1 == u.size()) return u(segment);
    const double fraction = (time - delay_ - t(segment)) / (t(segment + 1) - t(segment));
    return u(segment) + fraction * (u(segment + 1) - u(segment));
}

Matrix IrregularFilter::run(const VectorView& u, const VectorView& t, Vector x) {
    const Index N = u.size();
    Matrix y(N, C_.rows());
    Index segment = delay_ > 0 ? -1 : 0;
    double time = t(0);
    for (Index k = 0; k < N; ++k) {
        while (time < t(k)) {
            // With no delay the samples of the input are the sampling instants themselves, free of rounding.
            const double segment_end =
                segment + 1 < N ? t(segment + 1) + delay_ : std::numeric_limits<double>::infinity();
            const double stop = std::min(t(k), segment_end);
            if (stop > time) {
                const StepMatrices& matrices = step(stop - time);
                x = matrices.F * x + matrices.H0.col(0) * input_at(u, t, segment, time) +
                    matrices.H1.col(0) * input_at(u, t, segment, stop);
            }
            time = stop;
            if (stop == segment_end) ++segment;
        }
        y.row(k) = C_ * x + D_ * input_at(u, t, segment, time);
    }
    return y;
}

}  // namespace dynlab::inline numerics
