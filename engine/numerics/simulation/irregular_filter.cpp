#include "numerics/simulation/irregular_filter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kShortestStep = 2e-3;     // kept, times the norm of A
constexpr std::int64_t kBase = 32;         // of the digits
constexpr double kMostUnits = 1 << 30;     // longer steps are made one by one
constexpr double kNegligibleTerm = 1e-17;  // of the state

}  // namespace

IrregularFilter::IrregularFilter(const Matrix& A, const Vector& B, const Matrix& C, Vector D, Hold hold, double delay)
    : A_(A), D_(std::move(D)), hold_(hold), delay_(delay) {
    scale_ = A_.size() > 0 ? Vector(balance(A_)) : Vector();
    B_ = B.cwiseQuotient(scale_);
    C_ = C * scale_.asDiagonal();
    size_ = A_.size() > 0 ? A_.cwiseAbs().colwise().sum().maxCoeff() : 0;
    unit_ = size_ > 0 ? kShortestStep / size_ : kInfinity;
}

/// F, G and R, the answers to a constant one and to a ramp of one a second, of steps from one to `kBase` - 1 units.
const Matrix& IrregularFilter::kept_steps(std::size_t digit) {
    for (std::size_t next = kept_.size(); next <= digit; ++next) {
        const double unit = unit_ * std::pow(static_cast<double>(kBase), static_cast<double>(next));
        const StepMatrices one = exact_step(A_, B_, unit);
        const Index n = A_.rows(), width = n + 2;
        Matrix steps(n, (kBase - 1) * width);
        steps.leftCols(width) << one.F, one.G, unit * one.H1;
        for (Index i = 1; i < kBase - 1; ++i) {  // i units, and one more
            const auto before = steps.middleCols((i - 1) * width, width);
            auto step = steps.middleCols(i * width, width);
            step.leftCols(n) = one.F.lazyProduct(before.leftCols(n));
            step.col(n) = one.F.lazyProduct(before.col(n)) + one.G;
            step.col(n + 1) =
                one.F.lazyProduct(before.col(n + 1)) + static_cast<double>(i) * unit * one.G + unit * one.H1;
        }
        kept_.push_back(std::move(steps));
        units_.push_back(unit);
    }
    return kept_[digit];
}

/// The state after a step along which the input runs straight between two values.
template <class State>
void IrregularFilter::advance(State& x, double from, double to, double length) {
    if (x.size() == 0) return;
    constexpr int kOrder = State::RowsAtCompileTime;
    const double slope = (to - from) / length;
    const double units = std::isfinite(unit_) ? std::floor(length / unit_ + 0.5) : 0;
    if (!(units < kMostUnits)) {
        const StepMatrices step = exact_step(A_, B_, length);
        x = (step.F * x + step.H0.col(0) * from + step.H1.col(0) * to).eval();
        return;
    }
    double rest = length;
    auto number = static_cast<std::int64_t>(units);
    for (std::size_t place = 0; number > 0; ++place, number /= kBase) {
        const Index digit = number % kBase;
        if (digit == 0) continue;
        const double* step = kept_steps(place).data() + (digit - 1) * x.size() * (x.size() + 2);
        const Eigen::Map<const Eigen::Matrix<double, kOrder, kOrder>> F(step, x.size(), x.size());
        const Eigen::Map<const State> G(step + x.size() * x.size(), x.size());
        const Eigen::Map<const State> R(step + x.size() * (x.size() + 1), x.size());
        x = (F.lazyProduct(x) + G * from + R * slope).eval();
        const double kept = static_cast<double>(digit) * units_[place];
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
    const double ratio = std::abs(size_ * rest);
    double bound = 0.5 * ratio * ratio;
    for (int k = 3; (bound *= ratio / k) > kNegligibleTerm; ++k) {
        term = (rest / k * A.lazyProduct(term)).eval();
        x += term;
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
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, kOrder>> C(C_.data(), C_.rows(), C_.cols());
    State x = start.cwiseQuotient(scale_);
    Matrix y(C_.rows(), N);
    Index segment = delay_ > 0 ? -1 : 0;
    double time = t(0);
    for (Index k = 0; k < N; ++k) {
        while (time < t(k)) {
            // Samples that change nothing of a held input make no step of their own.
            while (hold_ == Hold::kZoh && segment >= 0 && segment + 1 < N && u(segment + 1) == u(segment)) ++segment;
            // With no delay the samples of the input are the sampling instants themselves, free of rounding.
            const double segment_end =
                segment + 1 < N ? t(segment + 1) + delay_ : std::numeric_limits<double>::infinity();
            const double stop = std::min(t(k), segment_end);
            if (stop > time) advance(x, input_at(u, t, segment, time), input_at(u, t, segment, stop), stop - time);
            time = stop;
            if (stop == segment_end) ++segment;
        }
        y.col(k) = C.lazyProduct(x) + D_ * input_at(u, t, segment, time);
    }
    return y.transpose();
}

Matrix IrregularFilter::run(const VectorView& u, const VectorView& t, const Vector& x) {
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
