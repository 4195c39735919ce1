#pragma once
#include <functional>
#include <string>

#include "numerics/kernels/instrument_iteration.h"
#include "numerics/signals/iddata.h"

namespace dynlab {

/// How a method finds the parameters of a DiscreteOutput from the measured rows.
using DiscreteSearch = std::function<InstrumentSolution(const DiscreteOutput& model, const Vector& y)>;

/// What oe and sriv have in common: checks data and orders (nb, nf and nk), takes the operating point off when
/// Offset is "remove" (with several inputs the means), fits every start condition the options and the inputs allow and
/// keeps the one of smallest BIC, and describes the result. `method` begins messages. Errors, warnings and references:
/// see estimators/oe.h and sriv.h.
PolynomialEstimate fit_discrete_output(const std::string& method, const IdData& data, const PolynomialOrders& orders,
                                       const PolynomialOptions& options, const DiscreteSearch& search);

}  // namespace dynlab
