#include "numerics/simulation/irregular_filter.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

/// Between two entries, times the norm of A. The first term left out is 4e-17 of the state.
constexpr double kTabulated = 0.125;
constexpr Index kLastTerm = 8;
constexpr Index kSeveral = 8;           // units; entries are made of few steps, for each rounds
constexpr std::int64_t kBase = 64;      // entries, and of the digits of longer steps
constexpr double kMostUnits = 1 << 30;  // longer steps are made one by one

/// [F G R] of a step behind another of `before` seconds with these, R the answer to a ramp of one a second.
void append_step(const StepMatrices& step, double length, double before, const Eigen::Ref<const Matrix>& first,
                 Eigen::Ref<Matrix> both) {
    const Index n = step.F.rows();
    both.noalias() = step.F.lazyProduct(first);
    both.col(n) += step.G;
    both.col(n + 1) += before * step.G + length * step.H1;
}

}  // namespace

template <int kOrder>
struct IrregularFilter::Moment {
    Eigen::Matrix<double, kOrder, 1> x;
    double input = 0, slope = 0;

    void advance_input(double length) { input += slope * length; }
};

IrregularFilter::IrregularFilter(const Matrix& A, const Vector& B, const Matrix& C, Vector D, Hold hold, double delay)
    : A_(A), D_(std::move(D)), hold_(hold), delay_(delay) {
    scale_ = A_.size() > 0 ? Vector(balance(A_)) : Vector();
    B_ = B.cwiseQuotient(scale_);
    C_ = C * scale_.asDiagonal();
    const double size = A_.size() > 0 ? A_.cwiseAbs().colwise().sum().maxCoeff() : 0;
    unit_ = size > 0 ? kTabulated / size : kInfinity;
}

/// The entries up to this one.
void IrregularFilter::tabulate(Index entry) {
    const Index n = A_.rows(), width = n + 2, size = n * width;
    if (entry > 0 && one_.F.size() == 0) {
        one_ = exact_step(A_, B_, unit_);
        several_ = exact_step(A_, B_, kSeveral * unit_);
    }
    for (; entries_ <= entry; ++entries_) {
        const double at = entries_ == 0 ? 0 : static_cast<double>(entries_) * unit_;
        to_state_.resize(to_state_.size() + (kLastTerm + 1) * size, 0);
        double* const terms = to_state_.data() + entries_ * (kLastTerm + 1) * size;
        const auto term = [&](Index k) { return Eigen::Map<Matrix>(terms + k * size, n, width); };
        if (entries_ == 0) {
            term(0).leftCols(n).setIdentity();
        } else {
            const Index back = entries_ % kSeveral == 0 ? kSeveral : 1;
            const double length = static_cast<double>(back) * unit_;
            append_step(back == 1 ? one_ : several_, length, at - length,
                        Eigen::Map<Matrix>(terms - back * (kLastTerm + 1) * size, n, width), term(0));
        }
        for (Index k = 1; k <= kLastTerm; ++k) {
            term(k).noalias() = A_.lazyProduct(term(k - 1));
            if (k == 1) {
                term(k).col(n) += B_;
                term(k).col(n + 1) += at * B_;
            } else if (k == 2) {
                term(k).col(n + 1) += B_;
            }
            term(k) /= static_cast<double>(k);
        }
        if (C_.rows() > 1) continue;
        for (Index k = 0; k <= kLastTerm; ++k) {
            Eigen::RowVectorXd row = C_ * term(k);
            if (k == 0) row.tail<2>() += D_[0] * Eigen::RowVector2d(1, at);
            if (k == 1) row[n + 1] += D_[0];
            to_output_.insert(to_output_.end(), row.begin(), row.end());
        }
    }
}

/// [F G R] of steps from one to `kBase` - 1 times kBase^(digit + 1) units.
const Matrix& IrregularFilter::kept_steps(std::size_t digit) {
    for (std::size_t next = long_steps_.size(); next <= digit; ++next) {
        const double length = unit_ * std::pow(static_cast<double>(kBase), static_cast<double>(next + 1));
        const StepMatrices one = exact_step(A_, B_, length);
        const Index n = A_.rows(), width = n + 2;
        Matrix steps(n, (kBase - 1) * width);
        steps.leftCols(width) << one.F, one.G, length * one.H1;
        for (Index i = 1; i < kBase - 1; ++i)
            append_step(one, length, static_cast<double>(i) * length, steps.middleCols((i - 1) * width, width),
                        steps.middleCols(i * width, width));
        long_steps_.push_back(std::move(steps));
    }
    return long_steps_[digit];
}

/// All of a step but what the table holds; returns the length that is left.
template <int kOrder>
double IrregularFilter::make_long_steps(Moment<kOrder>& moment, double length) {
    using State = Eigen::Matrix<double, kOrder, 1>;
    const double units = length / unit_;
    if (units < static_cast<double>(kBase) - 0.5) return length;
    if (!(units < kMostUnits)) {
        const StepMatrices step = exact_step(A_, B_, length);
        moment.x = (step.F * moment.x + step.G * moment.input + step.H1 * (moment.slope * length)).eval();
        moment.advance_input(length);
        return 0;
    }
    const Index n = moment.x.size(), size = n * (n + 2);
    double unit = unit_ * static_cast<double>(kBase);
    auto number = static_cast<std::int64_t>(units + 0.5) / kBase;
    for (std::size_t place = 0; number > 0; ++place, number /= kBase, unit *= static_cast<double>(kBase)) {
        const Index digit = number % kBase;
        if (digit == 0) continue;
        const double* const step = kept_steps(place).data() + (digit - 1) * size;
        const Eigen::Map<const Eigen::Matrix<double, kOrder, kOrder>> F(step, n, n);
        const Eigen::Map<const State> G(step + n * n, n), R(step + n * n + n, n);
        moment.x = (F.lazyProduct(moment.x) + G * moment.input + R * moment.slope).eval();
        const double kept = static_cast<double>(digit) * unit;
        moment.advance_input(kept);
        length -= kept;
    }
    return length;
}

/// The state or the output behind a step within the table.
template <int kRows, int kOrder>
Eigen::Matrix<double, kRows, 1> IrregularFilter::after_short_step(const std::vector<double>& table,
                                                                  const Moment<kOrder>& moment, Index rows,
                                                                  double length) {
    constexpr int kSize = kRows == Eigen::Dynamic || kOrder == Eigen::Dynamic ? Eigen::Dynamic : kRows * (kOrder + 2);
    using Coefficients = Eigen::Array<double, kSize, 1>;
    const Index n = moment.x.size(), size = rows * (n + 2);
    const auto entry = static_cast<Index>(length / unit_ + 0.5);
    if (entry >= entries_) tabulate(entry);
    const double rest = entry == 0 ? length : length - static_cast<double>(entry) * unit_;
    const double* const terms = table.data() + entry * (kLastTerm + 1) * size;
    Coefficients sum = Eigen::Map<const Coefficients>(terms + kLastTerm * size, size);
    for (Index k = kLastTerm; k-- > 0;) sum = sum * rest + Eigen::Map<const Coefficients>(terms + k * size, size);
    const Eigen::Map<const Eigen::Matrix<double, kRows, kOrder>> F(sum.data(), rows, n);
    const Eigen::Map<const Eigen::Matrix<double, kRows, 1>> G(sum.data() + rows * n, rows),
        R(sum.data() + rows * (n + 1), rows);
    return F.lazyProduct(moment.x) + G * moment.input + R * moment.slope;
}

/// The slope of the input behind sample `segment`.
double IrregularFilter::slope_behind(const VectorView& u, const VectorView& t, Index segment) const {
    if (hold_ == Hold::kZoh || segment + 1 == u.size()) return 0;
    return (u(segment + 1) - u(segment)) / (t(segment + 1) - t(segment));
}

template <int kOrder>
void IrregularFilter::run_sized(const VectorView& u, const VectorView& t, const Vector& start, Matrix& y) {
    const Index N = u.size(), n = A_.rows(), p = C_.rows();
    const double within_table = static_cast<double>(kBase) * unit_;
    tabulate(0);
    Moment<kOrder> here{start.cwiseQuotient(scale_)};
    const auto move = [&](double length) {
        const double rest = make_long_steps(here, length);
        here.x = after_short_step<kOrder, kOrder>(to_state_, here, n, rest);
        here.advance_input(rest);
    };
    double since = t(0), until = t(0) + delay_;
    Index next = 0;  // the sample with which the input changes
    for (Index k = 0; k < N; ++k) {
        while (until <= t(k)) {
            if (until > since) move(until - since);
            here.input = u(next);
            here.slope = slope_behind(u, t, next);
            since = until;
            // Samples that change nothing of a held input make no step of their own.
            for (++next; hold_ == Hold::kZoh && next < N && u(next) == here.input;) ++next;
            until = next < N ? t(next) + delay_ : kInfinity;
        }
        if (t(k) - since >= within_table) {
            move(t(k) - since);
            since = t(k);
        }
        const double length = t(k) - since;
        if (p == 1) {
            y(k, 0) = after_short_step<1, kOrder>(to_output_, here, 1, length)[0];
            continue;
        }
        const Eigen::Matrix<double, kOrder, 1> x =
            length > 0 ? after_short_step<kOrder, kOrder>(to_state_, here, n, length) : here.x;
        const double input = here.input + here.slope * length;
        for (Index i = 0; i < p; ++i) y(k, i) = C_.row(i).dot(x) + D_[i] * input;
    }
}

Matrix IrregularFilter::run(const VectorView& u, const VectorView& t, const Vector& x) {
    if (A_.size() == 0 && delay_ == 0) return u * D_.transpose();
    Matrix y(u.size(), C_.rows());
    switch (A_.rows()) {
        case 1:
            run_sized<1>(u, t, x, y);
            break;
        case 2:
            run_sized<2>(u, t, x, y);
            break;
        case 3:
            run_sized<3>(u, t, x, y);
            break;
        case 4:
            run_sized<4>(u, t, x, y);
            break;
        case 5:
            run_sized<5>(u, t, x, y);
            break;
        case 6:
            run_sized<6>(u, t, x, y);
            break;
        case 8:
            run_sized<8>(u, t, x, y);
            break;
        case 10:
            run_sized<10>(u, t, x, y);
            break;
        default:
            run_sized<Eigen::Dynamic>(u, t, x, y);
    }
    return y;
}

}  // namespace dynlab::inline numerics
