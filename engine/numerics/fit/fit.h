#pragma once
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/criteria/initial_conditions.h"
#include "numerics/fit/further_results.h"
#include "numerics/models/transfer_structure.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

struct PolynomialOrders;
struct PolynomialModel;
struct ProcessModel;

/// Why an iteration ended. None of these is an error: the best point found is always returned.
enum class Termination {
    kConverged,       ///< the parameters changed by less than the tolerance
    kIterationLimit,  ///< the allowed iterations were used up before that
    kNoProgress,      ///< no step, however short, lowered the loss any more
    kDiverged,        ///< the loss grew without bound (a step size that is too large)
    kCanceled,        ///< the cancel callback asked to stop
};

struct FitIteration {
    Vector theta;       ///< after the iteration; empty where only the loss is kept
    double loss = 0;    ///< mean square of the errors there
    double change = 0;  ///< largest relative parameter change
};

/// What all iterative estimators ask. Methods for difference equations have no use for lambda, hold_y and delays.
struct FitOptions {
    /// With kAuto a model that starts from rest is kept where no other start promises a lower BIC (fit/start_choice.h).
    InitialState initial_state = InitialState::kAuto;
    Offset offset = Offset::kAuto;
    double least_delay = 0;               ///< s; of a free delay
    std::optional<double> largest_delay;  ///< s; default: from the data
    int delay_count = 100;                ///< most delays on the grid between the two
    int max_iterations = 50;
    bool extend_iterations = true;  ///< a search that has not settled then, up to 500 iterations
    double tolerance = 1e-6;        ///< on the largest relative parameter change, made or still to come
    std::optional<double> lambda;   ///< rad/s, cut-off of the filter of the first estimate; several are tried without
    Hold hold_y = Hold::kFoh;       ///< how the output behaves between its samples inside the filters
    /// Searches: true keeps to models with all poles in the left half plane; without, an unstable one is given only
    /// where it is clearly better; false gives whatever has the smallest loss.
    std::optional<bool> stable;
    std::map<std::string, double> fixed;  ///< searches: parameters that are not estimated, by name, in seconds
    Vector output_weights;                ///< of each output's errors; one over their standard deviations when empty
    bool precision = true;                ///< a search ends with the covariance
    /// The model has an integrator in addition to its poles (fit/integrated_input.h): srivc, coe, rivc, oe, sriv, bj
    /// and armax.
    bool integration = false;
    std::function<bool()> cancel;  ///< asked before every iteration, by several threads at once

    /// Throws InvalidArgument naming the option.
    void validate() const;
    /// The same for data that begin at rest at zero input and without offset, such as simulated ones.
    FitOptions from_rest() const { return started({InitialState::kZero, false}); }
    FitOptions started(const StartCondition& condition) const;
    /// The same with other limits, for a step on the way to a fit.
    FitOptions limited(int iterations, double limit) const;
    /// The same for a search that only shows where another begins: without covariance.
    FitOptions rough(int iterations, double limit) const;
};

/// The result of every estimator of transfer functions and difference equations. e are the errors that its model takes
/// as white: of the simulation (srivc, coe, procsrivc, hammerstein, oe, sriv), of the prediction (rivc, armax, bj), of
/// the equation (arx, iv4, lssvf, ivsvf).
struct Fit {
    TransferStructure structure;                     ///< of continuous-time models
    std::vector<TransferFunction> models;            ///< continuous-time: of the channels, row by row
    std::shared_ptr<const ProcessModel> process;     ///< time constants in falling order
    std::shared_ptr<const PolynomialOrders> orders;  ///< of difference equations, as the model
    std::shared_ptr<const PolynomialModel> polynomial;
    std::optional<StaticCharacteristic> characteristic;
    std::optional<NoiseModel> noise;                  ///< of rivc
    std::shared_ptr<const ParameterHistory> history;  ///< of rlssvf, rivsvf and rsrivc

    std::vector<std::string> names;  ///< of theta
    Vector theta, std;               ///< in seconds and rad/s; see the structure, the process model or the orders
    Matrix covariance;               ///< noise_variance (Psi'Psi)^-1, Psi the regressors, instruments or sensitivities
    Matrix noise_covariance;         ///< rivc: of [c_1..c_nc d_1..d_nd]
    Vector noise_variance;           ///< per output, of e: sum of squares/(N - d), d the values that bear on the output
    Vector output_weights;           ///< those asked for that outputs were fitted together with; empty otherwise
    Vector fit_percent;              ///< per output: simulation, over all experiments
    double prediction_fit_percent = 0;  ///< difference equations: one step ahead
    double loss = 0;                    ///< mean square of e over all outputs; for rivc of the simulation error
    double condition_number = 0;        ///< of the column-scaled Psi
    std::vector<bool> at_bound;         ///< of a search: the parameter lies on a bound and wants to leave through it

    StartCondition start{InitialState::kZero, false};  ///< assumed or chosen; kEstimate where nothing is assumed
    std::vector<Vector> initial_values;  ///< per experiment, when estimated: y, dy/dt, ... of each output's free motion
    Matrix offsets;                      ///< experiments x outputs, added to the simulation; zeros without
    /// Per experiment, of each output: the operating point that Offset::kRemove took off; empty otherwise.
    std::vector<std::vector<JointOperatingPoint>> removed;
    Vector output;                  ///< of a search: simulated; procsrivc adds the operating point
    Vector delay_grid, delay_loss;  ///< s and mean square error, when a delay was looked for

    Termination termination = Termination::kConverged;
    std::vector<FitIteration> trace;
    std::vector<Message> warnings;  ///< whole sentences
    Message message;                ///< one sentence: how the estimation ended

    /// The message, then the warnings.
    Message full_message() const;

    // Compiled once (fit.cpp): most sources of the later layers copy or destroy fits.
    Fit();
    Fit(const Fit&);
    Fit(Fit&&) noexcept;
    Fit& operator=(const Fit&);
    Fit& operator=(Fit&&) noexcept;
    ~Fit();
};

/// 100 (1 - |error|/|y - mean(y)|), the means taken experiment by experiment, from the two sums of squares;
/// -infinity where the errors are not finite.
double fit_percent_of_sums(double squared_errors, double squared_variations);

/// Per output: the sum of squares about the mean of each experiment, and the mean square.
Vector output_variations(const IdData& data);
Vector output_powers(const IdData& data);

}  // namespace dynlab::inline numerics
