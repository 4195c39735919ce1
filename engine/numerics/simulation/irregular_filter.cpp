#include "numerics/simulation/irregular_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSideBySide = 8;
/// Steps up to so many times 1/|A| need the terms of the series up to the 4th, 6th, ..., 14th: what is left out is
/// 4e-17 of the state.
constexpr double kReach[] = {1.3e-3, 0.015, 0.062, 0.15, 0.3, 0.5};
constexpr Index kFirstTerms = 4, kLastTerm = 14;
constexpr double kUnit = 64;            // times 1/|A|
constexpr std::int64_t kBase = 64;      // of the digits of longer steps
constexpr double kMostUnits = 1 << 24;  // longer steps are made one by one
constexpr Index kBesideF = 2;           // columns: G and R
constexpr Index kTogether = 4;          // entries, which wait for each other less than terms of one do

using Eight = Eigen::Array<double, kSideBySide, 1>;

/// [F G R] of a step behind another of `before` seconds with these, R the answer to a ramp of one a second.
void append_step(const StepMatrices& step, double length, double before, const Eigen::Ref<const Matrix>& first,
                 Eigen::Ref<Matrix> both) {
    const Index n = step.F.rows();
    both.noalias() = step.F.lazyProduct(first);
    both.col(n) += step.G;
    both.col(n + 1) += before * step.G + length * step.H1;
}

/// [F G R] of eight steps, entry by entry. No state acts on the first kLeading ones but they themselves.
template <int kOrder, int kLeading>
class EightSteps {
  public:
    /// Of `entries` the power series (one column each, and further ones) are given; the others are zero.
    EightSteps(Index order, bool ramps, const std::vector<Index>& entries, const Matrix& series)
        : order_(order), ramps_(ramps), entries_(entries), series_(series) {
        const auto size = static_cast<std::size_t>(order * (order + kBesideF));
        all_.assign(size, Eight::Zero());
        doubled_ = all_;
    }

    /// For steps of `length` (s), the longest of which is `longest` times 1/|A|.
    void set(Eight length, double longest) {
        int doublings = 0;
        for (; longest > kReach[std::size(kReach) - 1]; longest /= 2) ++doublings;
        length *= std::ldexp(1.0, -doublings);
        Index last = kFirstTerms;
        for (const double* reach = kReach; longest > *reach; ++reach) last += 2;
        const double* terms = series_.data();
        const Index rows = series_.rows();
        for (std::size_t first = 0; first < entries_.size(); first += kTogether, terms += kTogether * rows) {
            Eight sums[kTogether];
            for (Index i = 0; i < kTogether; ++i) sums[i].setConstant(terms[i * rows + last]);
            for (Index k = last; k-- > 0;)
                for (Index i = 0; i < kTogether; ++i) sums[i] = sums[i] * length + terms[i * rows + k];
            const std::size_t count = std::min<std::size_t>(kTogether, entries_.size() - first);
            for (std::size_t i = 0; i < count; ++i) all_[static_cast<std::size_t>(entries_[first + i])] = sums[i];
        }
        for (; doublings > 0; --doublings, length *= 2) double_steps(length);
    }

    /// The state behind the step at this place.
    template <class State>
    State behind(Index place, const State& x, double input, double slope) const {
        const Index n = order();
        const double* entry = all_.front().data() + place;
        const double* const beside = entry + n * n * kSideBySide;
        State next(n);
        for (Index row = 0; row < n; ++row) {
            double sum = beside[row * kSideBySide] * input + beside[(n + row) * kSideBySide] * slope;
            for (Index column = 0; column < last_for(row); ++column)
                sum += entry[(column * n + row) * kSideBySide] * x[column];
            next[row] = sum;
        }
        return next;
    }

  private:
    Index order() const { return kOrder == Eigen::Dynamic ? order_ : kOrder; }
    /// The states that act on state `row` end before this one; those that state `column` acts on begin with the other.
    Index last_for(Index row) const { return row < kLeading ? kLeading : order(); }
    Index first_of(Index column) const { return column < kLeading || kLeading == Eigen::Dynamic ? 0 : kLeading; }

    void double_steps(const Eight& length) {
        const Index n = order();
        const Eight* const F = all_.data();
        const Eight *const G = F + n * n, *const R = G + n;
        const auto product = [&](Index row, const Eight* column, Index first) {
            Eight sum = F[first * n + row] * column[first];
            for (Index i = first + 1; i < last_for(row); ++i) sum += F[i * n + row] * column[i];
            return sum;
        };
        Eight* next = doubled_.data();
        for (Index column = 0; column < n; ++column, next += n)
            for (Index row = first_of(column); row < n; ++row)
                next[row] = product(row, F + column * n, first_of(column));
        for (Index row = 0; row < n; ++row) *next++ = product(row, G, 0) + G[row];
        if (ramps_)
            for (Index row = 0; row < n; ++row) *next++ = product(row, R, 0) + R[row] + length * G[row];
        all_.swap(doubled_);
    }

    Index order_;
    bool ramps_;
    const std::vector<Index>& entries_;
    const Matrix& series_;
    std::vector<Eight> all_, doubled_;
};

}  // namespace

IrregularFilter::IrregularFilter(const Matrix& A, const Vector& B, const Matrix& C, Vector D, Hold hold, double delay)
    : A_(A), D_(std::move(D)), hold_(hold), delay_(delay) {
    scale_ = A_.size() > 0 ? Vector(balance(A_)) : Vector();
    B_ = B.cwiseQuotient(scale_);
    C_ = C * scale_.asDiagonal();
    // Of powers it tells more than of A itself how the series falls off (Al-Mohy and Higham 2009).
    const Matrix square = A_ * A_, cube = square * A_;
    const auto norm = [](const Matrix& M) { return M.size() > 0 ? M.cwiseAbs().colwise().sum().maxCoeff() : 0; };
    size_ = std::max(std::sqrt(norm(square)), std::cbrt(norm(cube)));
    unit_ = size_ > 0 ? kUnit / size_ : kInfinity;
    set_series();
}

void IrregularFilter::set_series() {
    const Index n = A_.rows(), width = n + (hold_ == Hold::kFoh ? 2 : 1);
    Matrix all(kLastTerm + 1, n * width), term = Matrix::Identity(n, width);
    for (Index k = 0;; ++k) {
        all.row(k) = term.reshaped().transpose();
        if (k == kLastTerm) break;
        term = A_.lazyProduct(term).eval();
        if (k < width - n) term.col(n + k) += B_;
        term /= static_cast<double>(k + 1);
    }
    for (Index entry = 0; entry < all.cols(); ++entry)
        if (!all.col(entry).isZero(0)) entries_.push_back(entry);
    const auto count = static_cast<Index>(entries_.size());
    series_ = Matrix::Zero(all.rows(), (count + kTogether - 1) / kTogether * kTogether);
    series_.leftCols(count) = all(Eigen::all, entries_);
}

/// [F G R] of steps from one to `kBase` - 1 times kBase^digit units.
const Matrix& IrregularFilter::kept_steps(std::size_t digit) {
    for (std::size_t next = long_steps_.size(); next <= digit; ++next) {
        const double length = unit_ * std::pow(static_cast<double>(kBase), static_cast<double>(next));
        const StepMatrices one = exact_step(A_, B_, length);
        const Index n = A_.rows(), width = n + kBesideF;
        Matrix steps(n, (kBase - 1) * width);
        steps.leftCols(width) << one.F, one.G, length * one.H1;
        for (Index i = 1; i < kBase - 1; ++i)
            append_step(one, length, static_cast<double>(i) * length, steps.middleCols((i - 1) * width, width),
                        steps.middleCols(i * width, width));
        long_steps_.push_back(std::move(steps));
    }
    return long_steps_[digit];
}

template <int kOrder>
void IrregularFilter::make_kept_steps(double length, const Step& step, Eigen::Matrix<double, kOrder, 1>& x) {
    using State = Eigen::Matrix<double, kOrder, 1>;
    const double units = length / unit_;
    if (!(units < kMostUnits)) {
        const StepMatrices whole = exact_step(A_, B_, length);
        x = (whole.F * x + whole.G * step.input + whole.H1 * (step.slope * length)).eval();
        return;
    }
    const Index n = x.size(), size = n * (n + kBesideF);
    double input = step.input, unit = unit_;
    auto number = static_cast<std::int64_t>(units + 0.5);
    for (std::size_t place = 0; number > 0; ++place, number /= kBase, unit *= static_cast<double>(kBase)) {
        const Index digit = number % kBase;
        if (digit == 0) continue;
        const double* const kept = kept_steps(place).data() + (digit - 1) * size;
        const Eigen::Map<const Eigen::Matrix<double, kOrder, kOrder>> F(kept, n, n);
        const Eigen::Map<const State> G(kept + n * n, n), R(kept + n * n + n, n);
        x = (F.lazyProduct(x) + G * input + R * step.slope).eval();
        input += step.slope * static_cast<double>(digit) * unit;
    }
}

/// The slope of the input behind sample `segment`.
double IrregularFilter::slope_behind(const VectorView& u, const VectorView& t, Index segment) const {
    if (hold_ == Hold::kZoh || segment + 1 == u.size()) return 0;
    return (u(segment + 1) - u(segment)) / (t(segment + 1) - t(segment));
}

/// From the first sample to the last; and the input at all of them.
std::vector<IrregularFilter::Step> IrregularFilter::steps(const VectorView& u, const VectorView& t,
                                                          Vector& input) const {
    const Index N = u.size();
    std::vector<Step> steps(static_cast<std::size_t>(delay_ > 0 ? 2 * N : N));  // without delay all changes are samples
    auto step = steps.begin();
    input.resize(N);
    double since = t(0), until = t(0) + delay_, value = 0, slope = 0;
    Index next = 0;  // the sample with which the input changes
    for (Index k = 0; k < N; ++k) {
        bool arrived = false;
        for (; until <= t(k); until = next < N ? t(next) + delay_ : kInfinity) {
            arrived = until == t(k) && (arrived || until > since);
            if (until > since) *step++ = {until - since, value, slope, -1};
            since = until;
            value = u(next);
            slope = slope_behind(u, t, next);
            // Samples that change nothing of a held input make no step of their own.
            for (++next; hold_ == Hold::kZoh && next < N && u(next) == value;) ++next;
        }
        if (!arrived) {
            *step++ = {t(k) - since, value, slope, -1};
            value += slope * (t(k) - since);
            since = t(k);
        }
        (step - 1)->sample = k;
        input[k] = value;
    }
    steps.erase(step, steps.end());
    return steps;
}

template <int kOrder, int kLeading>
void IrregularFilter::run_sized(const std::vector<Step>& steps, const Vector& start, Matrix& states) {
    Eigen::Matrix<double, kOrder, 1> x = start.cwiseQuotient(scale_);
    const auto kept_of = [&](const Eight& length) -> Eight {
        const Eight units = length / unit_;
        return (units < kMostUnits).select(units.floor() * unit_, length);
    };
    EightSteps<kOrder, kLeading> rests(x.size(), hold_ == Hold::kFoh, entries_, series_);
    for (std::size_t first = 0; first < steps.size(); first += kSideBySide) {
        const std::size_t count = std::min<std::size_t>(kSideBySide, steps.size() - first);
        Eight length = Eight::Zero();
        for (std::size_t i = 0; i < count; ++i) length[static_cast<Index>(i)] = steps[first + i].length;
        const Eight kept = length.maxCoeff() < unit_ ? Eight(Eight::Zero()) : kept_of(length);
        length -= kept;
        rests.set(length, length.maxCoeff() * size_);
        for (Index i = 0; i < static_cast<Index>(count); ++i) {
            const Step& step = steps[first + static_cast<std::size_t>(i)];
            if (kept[i] > 0) make_kept_steps<kOrder>(kept[i], step, x);
            x = rests.behind(i, x, step.input + step.slope * kept[i], step.slope);
            if (step.sample < 0) continue;
            for (Index row = 0; row < x.size(); ++row) states(step.sample, row) = x[row];
        }
    }
}

void IrregularFilter::run_single(const std::vector<Step>& steps, const Vector& start, Matrix& states) {
    switch (A_.rows()) {
        case 1:
            return run_sized<1, 1>(steps, start, states);
        case 2:
            return run_sized<2, 2>(steps, start, states);
        case 3:
            return run_sized<3, 3>(steps, start, states);
        case 4:
            return run_sized<4, 4>(steps, start, states);
        case 5:
            return run_sized<5, 5>(steps, start, states);
        default:
            return run_sized<Eigen::Dynamic, Eigen::Dynamic>(steps, start, states);
    }
}

/// The second half of the states does not act on the first, as with sensitivities.
void IrregularFilter::run_cascade(const std::vector<Step>& steps, const Vector& start, Matrix& states) {
    switch (A_.rows()) {
        case 2:
            return run_sized<2, 1>(steps, start, states);
        case 4:
            return run_sized<4, 2>(steps, start, states);
        case 6:
            return run_sized<6, 3>(steps, start, states);
        case 8:
            return run_sized<8, 4>(steps, start, states);
        case 10:
            return run_sized<10, 5>(steps, start, states);
        default:
            return run_sized<Eigen::Dynamic, Eigen::Dynamic>(steps, start, states);
    }
}

Matrix IrregularFilter::run(const VectorView& u, const VectorView& t, const Vector& x) {
    const Index N = u.size();
    Vector input;
    const std::vector<Step> all = steps(u, t, input);
    Matrix y = input * D_.transpose();
    if (A_.rows() == 0) return y;
    Matrix states(N, A_.rows());
    if (A_.rows() % 2 == 0 && A_.topRightCorner(A_.rows() / 2, A_.rows() / 2).isZero(0))
        run_cascade(all, x, states);
    else
        run_single(all, x, states);
    for (Index i = 0; i < y.cols(); ++i)
        for (Index j = 0; j < states.cols(); ++j)
            if (C_(i, j) != 0) y.col(i) += C_(i, j) * states.col(j);
    return y;
}

}  // namespace dynlab::inline numerics
