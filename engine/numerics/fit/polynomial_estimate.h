#pragma once
#include <functional>
#include <string>
#include <vector>

#include "numerics/criteria/initial_conditions.h"
#include "numerics/fit/termination.h"
#include "numerics/models/polynomial_model.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// What the iterative discrete-time methods have in common. Fields named as options of the scripting language carry
/// those names.
struct PolynomialOptions {
    InitialState initial_state = InitialState::kZero;
    Offset offset = Offset::kNone;
    int MaxIter = 50;
    double Tol = 1e-6;             ///< on the largest relative parameter change
    std::function<bool()> cancel;  ///< asked before every iteration

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

struct PolynomialIteration {
    double loss = 0;    ///< mean square of the simulation error after the iteration
    double change = 0;  ///< largest relative parameter change
};

struct PolynomialEstimate {
    PolynomialOrders orders;
    PolynomialModel model;
    std::vector<std::string> names;  ///< of theta, as the orders give them
    Vector theta, std;
    Matrix covariance;          ///< noise_variance (Psi'Psi)^-1, Psi the regressors, instruments or sensitivities
    double noise_variance = 0;  ///< sum of squared errors/(N - d), d all estimated values
    double loss = 0;            ///< sum of squared errors/N: one-step errors for arx, simulation errors otherwise
    double fit_percent = 0;     ///< simulation, over all experiments; see the method for its initial state
    double prediction_fit_percent =
        0;                        ///< one step ahead; the same as fit_percent when the noise is white at the output
    double condition_number = 0;  ///< of the column-scaled Psi

    StartCondition start{InitialState::kZero, false};  ///< assumed or chosen; kEstimate where nothing is assumed
    Vector offsets;                                    ///< per experiment: constant that the simulation adds

    Termination termination = Termination::kConverged;
    std::vector<PolynomialIteration> trace;
    std::vector<std::string> warnings;  ///< whole sentences
    std::string message;                ///< one sentence, then the warnings

    PolynomialEstimate(const PolynomialOrders& fitted, const VectorView& values, double Ts)
        : orders(fitted), model(fitted, values, Ts), names(fitted.parameter_names()), theta(values) {}
};

/// Beyond this condition number the regressors are not told apart.
inline constexpr double kAmbiguousCondition = 1e10;

/// Tells of an ambiguous condition number, otherwise of parameters whose standard error is larger than their value.
void warn_of_doubtful_parameters(PolynomialEstimate& estimate);

/// Tells of a search that did not come to its end.
void warn_of_termination(PolynomialEstimate& estimate, int max_iterations);
/// "Converged after 5 iterations", or "Stopped after".
std::string ending_text(const PolynomialEstimate& estimate);

/// 100 (1 - |error|/|y - mean(y)|), the means taken experiment by experiment, from the two sums of squares.
double fit_percent_of_sums(double squared_errors, double squared_variations);

/// Throws InvalidArgument that begins with `caller` unless the data are regularly sampled, with inputs none of which is
/// zero throughout, and outputs that all change.
void check_sampled_data(const std::string& caller, const IdData& data);

/// The same for one output and as many inputs as the orders have, with delays shorter than each record.
void check_polynomial_data(const std::string& caller, const IdData& data, const PolynomialOrders& orders);

}  // namespace dynlab::inline numerics
