#pragma once
#include <vector>

#include "numerics/models/polynomial_model.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Least squares of A y = sum_j B_j u_j + e with some 10 log10 N coefficients in each polynomial. With so many it comes
/// near every linear model with a noise model: its errors show how well the output can be predicted, and A makes the
/// noise white. A search for a model with a noise model begins where the simulation error is smallest; where the noise
/// drifts, that model follows the drift, and the search may end there. The regression reveals such an end and gives
/// data to start from instead. One output, regular sampling.
class LongRegression {
  public:
    /// Inputs may be late by up to `max_delay_samples` samples. Keeps a reference to the data.
    LongRegression(const IdData& data, Index max_delay_samples);

    /// Whether the regression predicts better, beyond chance, than a model whose errors have this variance.
    bool predicts_better_than(double variance) const;

    /// What an input makes of the output of each experiment, from rest, with poles brought into the unit circle;
    /// nothing for data that are too short.
    std::vector<Vector> share(Index input) const;

    /// The data with inputs and outputs filtered by A, in which the noise is nearly white, and differenced (1 - q^-1),
    /// in which it does not drift. A model of the data is one of the filtered data, too. Before the first sample the
    /// output is taken to be what it is there; the inputs are taken to be zero if the data begin from rest.
    std::vector<IdData> filtered_data(bool from_rest) const;

  private:
    const IdData& data_;
    PolynomialOrders orders_;
    Vector theta_;
    double variance_ = 0;
    Index samples_ = 0;
};

}  // namespace dynlab::inline numerics
