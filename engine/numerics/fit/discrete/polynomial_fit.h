#pragma once
#include <string>

#include "numerics/fit/diagnosis.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

// What all fits of difference equations have in common.

/// Throws InvalidArgument, with a message that begins with `method`, for data with several outputs, a number of inputs
/// other than that of the orders, and delays not shorter than each experiment.
void check_polynomial_channels(const std::string& method, const IdData& data, const PolynomialOrders& orders);
/// The same, and all errors of check_sampled_data.
void check_polynomial_data(const std::string& method, const IdData& data, const PolynomialOrders& orders);

/// A fit with its model, sampled every Ts (s), and names made from the values; all else is to be filled.
Fit polynomial_fit(const PolynomialOrders& orders, const VectorView& theta, double Ts);

/// The same of a search whose parameters begin with those of the orders: their values, covariance and standard errors.
void make_polynomial(Fit& fit, const PolynomialOrders& orders, double Ts);

/// Warns of a model that is not stable, and says what helps.
void warn_of_unstable_polynomials(Fit& fit);

}  // namespace dynlab::inline numerics
