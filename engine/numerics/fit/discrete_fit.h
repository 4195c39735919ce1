#pragma once
#include <functional>
#include <string>
#include <vector>

#include "numerics/fit/instrument_iteration.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// How a method finds the parameters of a DiscreteOutput from the measured rows.
using DiscreteSearch = std::function<InstrumentSolution(const DiscreteOutput& model, const Vector& y)>;

/// The smallest output error: a few rough instrument iterations, then damped Gauss-Newton from where they lead.
DiscreteSearch output_error_search(const PolynomialOptions& options);

/// The experiments as the search sees them: less their operating point when Offset is "remove" (with several inputs
/// the means), whose outputs, one per experiment, then stand in `removed_outputs` unless it is null.
std::vector<SampledExperiment> sampled_experiments(const IdData& data, Offset offset,
                                                   Vector* removed_outputs = nullptr);

/// What oe and sriv have in common: checks data and orders (nb, nf and nk), takes the operating point off when
/// Offset is "remove" (with several inputs the means), fits every start condition the options and the inputs allow and
/// keeps the one of smallest BIC, and describes the result. `method` begins messages. Errors, warnings and references:
/// see estimators/oe.h and sriv.h.
PolynomialEstimate fit_discrete_output(const std::string& method, const IdData& data, const PolynomialOrders& orders,
                                       const PolynomialOptions& options, const DiscreteSearch& search);

}  // namespace dynlab::inline numerics
