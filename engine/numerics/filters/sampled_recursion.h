#pragma once
#include <vector>

#include "numerics/filters/filtered_signal.h"

namespace dynlab::inline numerics {

/// A SampledSystem sample by sample: the recursion as it is defined, which the fast filters are checked against and
/// which they leave the beginning and the end of a record to. The caller vouches for sizes and for the life of both
/// arguments.
class SampledRecursion {
  public:
    SampledRecursion(const SampledSystem& system, const Eigen::Map<const Vector>& u)
        : system_(system), u_(u), x_(Vector::Zero(system.F.rows())), next_(x_) {}

    Index output_count() const { return system_.C.rows(); }
    const Vector& state() const { return x_; }
    void set_state(const Vector& x) { x_ = x; }

    /// Output at sample k for the state there.
    template <class Output>
    void output(Index k, Output&& y) const {
        const Index now = k - system_.delay;
        y.noalias() = system_.C.lazyProduct(x_);
        if (now == 0) y += system_.first_D * u_[0];
        if (now > 0) y += system_.D.col(0) * u_[now] + system_.D.col(1) * u_[now - 1];
    }

    /// From the state at sample k to the one at k + 1; past the last sample of u nothing is defined, nor done.
    void step(Index k) {
        const Index now = k - system_.delay;
        if (now + 1 >= u_.size()) return;
        next_.noalias() = system_.F.lazyProduct(x_);
        x_.swap(next_);
        if (now == 0) x_ += system_.first_G.col(0) * u_[1] + system_.first_G.col(1) * u_[0];
        if (now > 0) x_ += system_.G.col(0) * u_[now + 1] + system_.G.col(1) * u_[now] + system_.G.col(2) * u_[now - 1];
    }

  private:
    const SampledSystem& system_;
    const Eigen::Map<const Vector>& u_;
    Vector x_, next_;
};

/// All signals sample by sample: the beginning and the end of a record, which do not fill lanes.
class SampleProducts {
  public:
    SampleProducts(const std::vector<FilteredSignal>& signals, const std::vector<Index>& left,
                   const std::vector<Index>& right, const std::vector<OutputSum>& sums)
        : left_(left), right_(right), sums_(sums), total_(Matrix::Zero(left.size(), right.size())) {
        recursions_.reserve(signals.size());
        Index outputs = 0;
        for (const FilteredSignal& signal : signals) {
            recursions_.emplace_back(signal.system, signal.signal);
            outputs += signal.system.C.rows();
        }
        outputs_.resize(outputs + static_cast<Index>(sums.size()));
        left_outputs_.resize(total_.rows());
        right_outputs_.resize(total_.cols());
    }

    void run(Index from, Index to) {
        for (Index k = from; k < to; ++k) {
            Index place = 0;
            for (SampledRecursion& recursion : recursions_) {
                const Index count = recursion.output_count();
                recursion.output(k, outputs_.segment(place, count));
                recursion.step(k);
                place += count;
            }
            for (const OutputSum& sum : sums_) {
                double value = 0;
                for (const OutputSum::Term& term : sum.terms) value += term.weight * outputs_[term.output];
                outputs_[place++] = value;
            }
            for (Index i = 0; i < total_.rows(); ++i) left_outputs_[i] = outputs_[left_[static_cast<std::size_t>(i)]];
            for (Index j = 0; j < total_.cols(); ++j) right_outputs_[j] = outputs_[right_[static_cast<std::size_t>(j)]];
            total_ += left_outputs_.lazyProduct(right_outputs_.transpose());
        }
    }
    SampledRecursion& recursion(std::size_t signal) { return recursions_[signal]; }
    const Matrix& total() const { return total_; }

  private:
    const std::vector<Index>&left_, &right_;
    const std::vector<OutputSum>& sums_;
    std::vector<SampledRecursion> recursions_;
    Vector outputs_, left_outputs_, right_outputs_;
    Matrix total_;
};

}  // namespace dynlab::inline numerics
