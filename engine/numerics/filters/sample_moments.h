#pragma once
#include <vector>

#include "numerics/filters/filtered_signal.h"
#include "numerics/filters/tapped_recursion.h"

namespace dynlab::inline numerics {

/// All signals sample by sample: the beginning and the end of a record, which do not fill lanes.
class SampleMoments {
  public:
    SampleMoments(const std::vector<FilteredSignal>& signals, const std::vector<Index>& left,
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
            for (TappedRecursion& recursion : recursions_) {
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
    TappedRecursion& recursion(std::size_t signal) { return recursions_[signal]; }
    const Matrix& total() const { return total_; }

  private:
    const std::vector<Index>&left_, &right_;
    const std::vector<OutputSum>& sums_;
    std::vector<TappedRecursion> recursions_;
    Vector outputs_, left_outputs_, right_outputs_;
    Matrix total_;
};

}  // namespace dynlab::inline numerics
