#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "numerics/criteria/initial_conditions.h"
#include "numerics/fit/termination.h"
#include "numerics/models/transfer_structure.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// What the output-error methods for transfer functions (srivc, coe and their tf twins, rivc) have in common. Fields
/// named as the options of the scripting language carry those names.
struct TransferOptions {
    std::optional<double>
        lambda;                ///< rad/s, cut-off of the filter of the first estimate; several are tried unless given
    Hold hold_y = Hold::kFoh;  ///< how the output behaves between its samples inside the filters
    InitialState initial_state = InitialState::kZero;
    Offset offset = Offset::kNone;
    double TdMin = 0;             ///< s; with free delays only
    std::optional<double> TdMax;  ///< s; from the input-output cross-correlation unless given
    int NumTd = 100;              ///< most delays on the grid between the two
    int MaxIter = 50;
    double Tol = 1e-6;             ///< on the largest relative parameter change, made or still to come
    std::function<bool()> cancel;  ///< asked before every iteration

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

struct TransferIteration {
    Vector theta;       ///< after the iteration
    double loss = 0;    ///< mean square of the simulation error there
    double change = 0;  ///< largest relative parameter change
};

struct TransferEstimate {
    TransferStructure structure;
    Vector theta, std;  ///< in the order of the structure, its names in `names`
    std::vector<std::string> names;
    std::vector<TransferFunction> models;  ///< of the channels, row by row
    Matrix covariance;                     ///< noise_variance (Psi'Psi)^-1, Psi the instruments or sensitivities
    Vector noise_variance;                 ///< per output: squares/(N - d), d the values that bear on the output
    Vector fit_percent;                    ///< per output: simulation, over all experiments
    double loss = 0;                       ///< mean square of the simulation error over all outputs
    double condition_number = 0;           ///< of the column-scaled equations

    StartCondition start{InitialState::kZero, false};  ///< what was assumed or chosen
    std::vector<Vector> initial_values;  ///< per experiment, when estimated: y, dy/dt, ... of each output's free motion
    Matrix offsets;                      ///< experiments x outputs, added to the simulation; zeros without
    Vector delay_grid, delay_loss;       ///< s and mean square error, when a delay was looked for

    Termination termination = Termination::kIterationLimit;
    std::vector<TransferIteration> trace;
    std::vector<std::string> warnings;  ///< whole sentences
    std::string message;                ///< one sentence, then the warnings
};

}  // namespace dynlab::inline numerics
