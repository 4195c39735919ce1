#pragma once
#include <vector>

#include "base/message.h"
#include "numerics/criteria/initial_conditions.h"
#include "numerics/models/free_run.h"
#include "numerics/models/transfer_function.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

struct CompareOptions {
    InitialState initial_state = InitialState::kAuto;
    Offset offset = Offset::kAuto;
};

/// One output of one experiment.
struct CompareResult {
    Vector output;  ///< N, simulated (never predicted from measured outputs), offset included
    double fit_percent = 0;
    StartCondition start{};  ///< what was assumed or chosen
    Vector initial_values;   ///< weights of the free motions of 1/den (n, for each den in turn), empty unless estimated
    double offset = 0;       ///< the estimated constant, or the operating point "remove" took off the output
    Message message;         ///< one sentence
};

/// Simulates G on the input of one experiment with one input and one output and compares with its output. What the
/// model cannot know, the initial state and a constant, is handled as the options say (criteria/initial_conditions.h):
/// it enters the output linearly and is found by least squares; "auto" takes the condition of smallest BIC. With zero
/// and none the plain lsim is compared. Throws InvalidArgument for an improper G, a discrete G of another sampling
/// time, other data, or a constant output.
CompareResult compare(const IdData& data, const TransferFunction& G, const CompareOptions& options = {});

struct Comparison {
    std::vector<std::vector<CompareResult>> results;  ///< [experiment][output]
    Vector fit_percent;  ///< per output over all experiments, each counted from its own mean
    /// N x ny simulated outputs of one experiment (0-based).
    Matrix outputs(std::size_t experiment) const;
};

/// The same for any number of experiments and channels. `channels` holds the ny nu transfer functions of the model, all
/// inputs of output 1, then of output 2, ...; channels of one output with the same denominator share their free motion.
/// Throws InvalidArgument as compare() does, and for another number of channels.
Comparison compare_all(const IdData& data, const std::vector<TransferFunction>& channels,
                       const CompareOptions& options = {});

/// The same for a model with a free run, which determines its start from the data. A lost run has a fit of -infinity,
/// its output is NaN from the time of the loss on, and the message states this time. Throws InvalidArgument as its
/// free_run().
Comparison compare_all(const IdData& data, const FreeRunModel& model);

/// The fits (per output, over all experiments) of the same simulations without the offsets that were estimated.
Vector fits_without_offsets(const IdData& data, const Comparison& comparison);

/// The first output of all experiments one after the other, N values, each counted from the mean of its experiment's
/// measured output; `swing`: simulated, counted from its own mean, as measures count that are blind to constant errors.
struct LevelledOutputs {
    Vector measured, simulated, swing;
};
LevelledOutputs levelled_outputs(const IdData& data, const Comparison& comparison);

}  // namespace dynlab::inline numerics
