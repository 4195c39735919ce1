#pragma once
#include <optional>
#include <string>
#include <vector>

#include "numerics/validation/compare.h"
#include "numerics/validation/prediction.h"
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// The options InitialState and Offset of functions that simulate a model on a record.
CompareOptions compare_options(const Options& options, const char* initial_state = "auto");

/// The option hold: how inputs go on between samples.
Hold hold_option(const Options& options, Hold fallback);

/// The transfer functions of a model argument, one a channel: all inputs of the first output, then of the second.
std::vector<TransferFunction> channels_argument(const Call& call, int index, ArgumentName what);

/// A model argument simulated on data, as the options InitialState and Offset say; of a free run that is lost it
/// prints when.
Comparison comparison_argument(const Call& call, int index, const IdData& data, const Options& options);

/// A model argument with what it says of its noise.
NoisyModel noisy_model_argument(const Call& call, int index, ArgumentName what);

/// What predict() gives of a model argument on the data.
Predictions prediction_argument(const Call& call, int index, const IdData& data, const PredictionOptions& options);

/// The signal that drives the linear part of the model argument: f(u) of one that begins with a static characteristic f
/// (hammerstein), u itself of all others.
Matrix driving_input(const Call& call, int index, const Matrix& u);
/// The data with that in the place of the input: in `storage` where something changes.
const IdData& driving_data(const Call& call, int index, const IdData& data, IdData& storage);

/// Makes a number at `index`, where options may stand, the table {k = number}: compare(data, G, 5).
void read_steps_as_option(const Call& call, int index);
/// The option k: a whole number of steps from 1 on, or nothing for math.huge, a simulation.
std::optional<Index> steps_option(const Options& options, std::optional<Index> fallback);
/// A model's name in a legend: "arx, 5 steps ahead", or the name alone for a simulation.
Message with_steps(const Message& name, const std::optional<Index>& steps);

}  // namespace dynlab::inline scripting
