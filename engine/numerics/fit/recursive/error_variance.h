#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Weights w of samples that are forgotten.
class FadingWeights {
  public:
    /// The weights of all so far are multiplied by `weight`.
    void add(double weight) {
        sum_ = weight * sum_ + 1;
        squares_ = weight * weight * squares_ + 1;
    }
    /// sum w^2/sum w: what white errors leave of the variance (sum w z z')^-1 of an estimate.
    double factor() const { return squares_ / sum_; }

  private:
    double sum_ = 0, squares_ = 0;
};

/// The mean square of weighted errors that arrive one at a time. kInstruments: of the last half to three quarters of
/// them, because the first errors belong to a theta that is still imprecise; otherwise of all.
template <bool kInstruments>
class ErrorVariance {
  public:
    /// The weights of all so far are multiplied by `weight`; `known`: the theta of this error is.
    void add(double error, double weight, bool known) {
        squares_ = weight * squares_ + error * error;
        rows_ = weight * rows_ + 1;
        earlier_squares_ *= weight;
        earlier_rows_ *= weight;
        if (!kInstruments || rows_ < 2 * earlier_rows_ || !known) return;
        earlier_squares_ = squares_;
        earlier_rows_ = rows_;
        squares_ = rows_ = 0;
    }
    /// With `parameters` found from these errors; infinite without more of them.
    double value(int parameters) const {
        const double rows = rows_ + earlier_rows_ - (kInstruments ? 0 : parameters);
        return rows > 0 ? (squares_ + earlier_squares_) / rows : kInfinity;
    }

  private:
    double rows_ = 0, squares_ = 0, earlier_rows_ = 0, earlier_squares_ = 0;
};

}  // namespace dynlab::inline numerics
