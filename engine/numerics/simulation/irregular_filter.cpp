#include "numerics/simulation/irregular_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kNearest = 1e-3, kFarthest = 0.1;  // spacing of kept steps, times the norm of A
constexpr double kSharing = 8;                      // samples, for each kept step
constexpr std::size_t kMostKept = 1 << 14;          // steps; longer ones are made one by one
constexpr double kNegligibleTerm = 1e-17;           // of the state

}  // namespace

IrregularFilter::IrregularFilter(const Matrix& A, const Vector& B, const Matrix& C, Vector D, Hold hold, double delay)
    : A_(A), D_(std::move(D)), hold_(hold), delay_(delay) {
    scale_ = A_.size() > 0 ? Vector(balance(A_)) : Vector();
    B_ = B.cwiseQuotient(scale_);
    C_ = C * scale_.asDiagonal();
    size_ = A_.size() > 0 ? A_.cwiseAbs().colwise().sum().maxCoeff() : 0;
}

/// Kept steps as near to each other as pays.
void IrregularFilter::set_spacing(const VectorView& t) {
    const Index N = t.size();
    const double longest = N > 1 ? (t.tail(N - 1) - t.head(N - 1)).maxCoeff() : 0;
    const double share = kSharing * longest / static_cast<double>(N);
    const double spacing = size_ > 0 ? std::clamp(share, kNearest / size_, kFarthest / size_) : kInfinity;
    if (spacing != spacing_) kept_.clear();
    spacing_ = spacing;
}

const StepMatrices& IrregularFilter::kept_step(std::size_t number) {
    if (number >= kept_.size()) kept_.resize(number + 1);
    StepMatrices& step = kept_[number];
    if (step.F.size() == 0) step = exact_step(A_, B_, static_cast<double>(number) * spacing_);
    return step;
}

/// The state after a step along which the input runs straight between two values.
template <class State>
void IrregularFilter::advance(State& x, double from, double to, double length) {
    if (x.size() == 0) return;
    constexpr int kOrder = State::RowsAtCompileTime;
    const double slope = (to - from) / length;
    const double number = std::isfinite(spacing_) ? std::floor(length / spacing_ + 0.5) : 0;
    if (!(number < static_cast<double>(kMostKept))) {
        const StepMatrices step = exact_step(A_, B_, length);
        x = (step.F * x + step.H0.col(0) * from + step.H1.col(0) * to).eval();
        return;
    }
    double rest = length;
    if (number > 0) {
        const StepMatrices& step = kept_step(static_cast<std::size_t>(number));
        const double kept = number * spacing_;
        const Eigen::Map<const Eigen::Matrix<double, kOrder, kOrder>> F(step.F.data(), x.size(), x.size());
        const Eigen::Map<const State> G(step.G.data(), x.size()), H1(step.H1.data(), x.size());
        x = (F.lazyProduct(x) + G * from + H1 * (slope * kept)).eval();
        from += slope * kept;
        rest -= kept;
    }
    const Eigen::Map<const Eigen::Matrix<double, kOrder, kOrder>> A(A_.data(), x.size(), x.size());
    const Eigen::Map<const State> B(B_.data(), x.size());
    // The terms rest^k/k! d^k x/dt^k, whose input ends with the second derivative.
    State term = rest * (A.lazyProduct(x) + B * from);
    x += term;
    term = (0.5 * rest * (A.lazyProduct(term) + B * (slope * rest))).eval();
    x += term;
    double bound = 0.5 * size_ * rest * size_ * rest;
    for (int k = 3; bound > kNegligibleTerm; ++k) {
        term = (rest / k * A.lazyProduct(term)).eval();
        x += term;
        bound *= std::abs(size_ * rest) / k;
    }
}

/// The delayed input at `time`, on the segment that begins with sample `segment` (-1: not yet begun).
double IrregularFilter::input_at(const VectorView& u, const VectorView& t, Index segment, double time) const {
    if (segment < 0) return 0;
    if (hold_ == Hold::kZoh || segment + 1 == u.size()) return u(segment);
    const double fraction = (time - delay_ - t(segment)) / (t(segment + 1) - t(segment));
    return u(segment) + fraction * (u(segment + 1) - u(segment));
}

template <int kOrder>
Matrix IrregularFilter::run_sized(const VectorView& u, const VectorView& t, const Vector& start) {
    using State = Eigen::Matrix<double, kOrder, 1>;
    const Index N = u.size();
    State x = start.cwiseQuotient(scale_);
    Matrix y(C_.rows(), N);
    Index segment = delay_ > 0 ? -1 : 0;
    double time = t(0);
    for (Index k = 0; k < N; ++k) {
        while (time < t(k)) {
            // With no delay the samples of the input are the sampling instants themselves, free of rounding.
            const double segment_end =
                segment + 1 < N ? t(segment + 1) + delay_ : std::numeric_limits<double>::infinity();
            const double stop = std::min(t(k), segment_end);
            if (stop > time) advance(x, input_at(u, t, segment, time), input_at(u, t, segment, stop), stop - time);
            time = stop;
            if (stop == segment_end) ++segment;
        }
        y.col(k) = C_.lazyProduct(x) + D_ * input_at(u, t, segment, time);
    }
    return y.transpose();
}

Matrix IrregularFilter::run(const VectorView& u, const VectorView& t, const Vector& x) {
    set_spacing(t);
    switch (A_.rows()) {
        case 1:
            return run_sized<1>(u, t, x);
        case 2:
            return run_sized<2>(u, t, x);
        case 3:
            return run_sized<3>(u, t, x);
        case 4:
            return run_sized<4>(u, t, x);
        case 5:
            return run_sized<5>(u, t, x);
        case 6:
            return run_sized<6>(u, t, x);
        case 8:
            return run_sized<8>(u, t, x);
        case 10:
            return run_sized<10>(u, t, x);
        default:
            return run_sized<Eigen::Dynamic>(u, t, x);
    }
}

}  // namespace dynlab::inline numerics
