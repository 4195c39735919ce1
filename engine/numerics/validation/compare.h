#pragma once
#include <string>

#include "numerics/kernels/initial_conditions.h"
#include "numerics/models/transfer_function.h"
#include "numerics/signals/iddata.h"

namespace dynlab {

struct CompareOptions {
    InitialState initial_state = InitialState::kAuto;
    Offset offset = Offset::kAuto;
};

struct CompareResult {
    Vector output;  ///< N, simulated (never predicted from measured outputs), offset included
    double fit_percent = 0;
    StartCondition start{};  ///< what was assumed or chosen
    Vector initial_values;   ///< weights of the free motions of 1/den (n), empty unless estimated
    double offset = 0;       ///< the estimated constant, or the operating point "remove" took off the output
    std::string message;     ///< one sentence
};

/// Simulates G on the input of one experiment with one input and one output and compares with its output. What the
/// model cannot know, the initial state and a constant, is handled as the options say (kernels/initial_conditions.h):
/// it enters the output linearly and is found by least squares; "auto" takes the condition of smallest BIC. With zero
/// and none the plain lsim is compared. Throws InvalidArgument for an improper G, a discrete G of another sampling
/// time, other data, or a constant output.
CompareResult compare(const IdData& data, const TransferFunction& G, const CompareOptions& options = {});

}  // namespace dynlab
