#pragma once
#include <functional>

#include "scripting/objects/model.h"

namespace dynlab::inline scripting {

/// What every fit has: parameters with their errors, message and warnings, fit_percent, loss, condition_number and
/// fits. `method` is the Lua name.
Estimate basic_estimate(const char* method, const Fit& fit);
/// Pushes the table G.report of such an estimate.
void push_report(const Call& call, const Estimate& estimate);

/// The equation of a fit of transfer functions: y = B/F u + e, or A y = B u + e, whose models have fields A and B.
enum class FitForm { kOutputError, kEquationError };

/// What a script can ask of a fit. `method` is the Lua name.
Estimate estimate_of(const char* method, const Fit& fit, FitForm form = FitForm::kOutputError);
/// The same where each is computed when it is read: the fit with its simulation measured, and with standard errors.
Estimate deferred_estimate(const char* method, const Fit& fit, FitForm form, std::function<Fit()> measured,
                           std::function<Fit()> with_errors);

/// Pushes the fitted model with all its channels.
int give_fit(const Call& call, const char* method, const Fit& fit, FitForm form = FitForm::kOutputError);
/// The same of an estimation from the data at argument 1 by these options, whose diagnostics (fit/diagnostics.h) are
/// computed when the script reads them.
int give_diagnosed_fit(const Call& call, const char* method, const Fit& fit, const FitOptions& options);
/// The same of an estimate that computes something from the data at argument 1 when it is read.
int give_deferring(const Call& call, Estimate estimate, const Fit& fit);
/// The same for an estimate with additional results of the method.
int give_estimate(const Call& call, Estimate estimate, const Fit& fit);
/// The same of a fit with states, which has no theta.
int give_system(const Call& call, Estimate estimate, const Fit& fit, const StateSpace& system);

}  // namespace dynlab::inline scripting
