#pragma once
#include <functional>
#include <string>
#include <vector>

#include "numerics/fit/discrete/polynomial_fit.h"
#include "numerics/fit/discrete/sriv_iteration.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// How a method finds the parameters of a DiscreteOutput from the measured rows.
using DiscreteSearch = std::function<InstrumentSolution(const DiscreteOutput& model, const Vector& y)>;

/// The smallest output error: a few rough instrument iterations, then damped Gauss-Newton from where they lead.
DiscreteSearch output_error_search(const FitOptions& options);

/// The experiments as the search sees them; the operating points are to be taken off before (centered_for).
std::vector<SampledExperiment> sampled_experiments(const IdData& data);

/// What oe and sriv have in common: checks data and orders (nb, nf and nk), takes the operating point off when
/// `offset` is "remove", fits the start conditions that the options and the inputs allow (those that the options leave
/// open only where a fit from rest gives reason to, see fit/start_choice.h), keeps the one of smallest BIC, and
/// describes the result. `method` begins messages. Throws InvalidArgument as
/// estimators/oe.h says; warnings and references: see estimators/oe.h and sriv.h.
Fit fit_discrete_output(const std::string& method, const IdData& data, const PolynomialOrders& orders,
                        const FitOptions& options, const DiscreteSearch& search);

}  // namespace dynlab::inline numerics
