#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "numerics/validation/compare.h"
#include "numerics/validation/prediction.h"
#include "scripting/arguments/estimator_options.h"

namespace dynlab::inline scripting {

/// The options and arguments of functions that simulate a model.

inline constexpr double kMaxSeed = 0xFFFFFFFF;

inline constexpr OptionEntry kHoldOption = {
    "hold",
    ValueKind::kChoice,
    about("intersample behavior of the input: zero-order hold (\"zoh\") or linear interpolation (\"foh\")"),
    {.initial = "\"zoh\"", .choices = kHolds}};

inline constexpr OptionEntry kStateOption = {
    "InitialState",
    ValueKind::kChoice,
    kStartOptions[0].description,
    {.initial = "\"auto\"", .choices = kInitialStates, .former = "zero", .member = "initial_state"}};
inline constexpr std::array kStatesOfComparison = {"none", "steady", "estimate", "auto", "model"};
inline constexpr OptionEntry kComparedStateOption = {
    "InitialState",
    ValueKind::kChoice,
    about("initial state, as in `srivc`; for a grey-box model also \"model\", the initial state of the model"),
    {.initial = "\"auto\"", .choices = kStatesOfComparison, .former = "zero", .member = "initial_state"}};
inline constexpr OptionEntry kOffsetOption = option<&CompareOptions::offset>(
    "Offset", kStartOptions[1].description, {.initial = "\"auto\"", .choices = kOffsets, .member = "offset"});
inline constexpr std::array kSimulationStart = {kStateOption, kOffsetOption};
/// Of functions that simulate grey-box models, too.
inline constexpr std::array kComparisonStart = {kComparedStateOption, kOffsetOption};

inline constexpr OptionEntry kLabelsOption = {"labels", ValueKind::kAny,
                                              about("legend labels: string, or list of strings")};
inline constexpr OptionEntry kConfidenceOption = {
    "confidence", ValueKind::kNumber, about("confidence level of the band"), {.initial = "0.99"}};

inline constexpr ArgumentEntry kDataSetArgument = {"data", ValueKind::kData,
                                                   about("data object with the inputs and outputs of the model")};
inline constexpr ArgumentEntry kModelArgument = {"G", ValueKind::kModel, about("model")};
inline constexpr ArgumentEntry kOneChannelModel = {
    "G", ValueKind::kModel, about("linear model with one input and one output, or number (a static gain)")};
inline constexpr std::array kDataAndModel = {kDataSetArgument, kModelArgument};

/// The options InitialState and Offset of functions that simulate a model on data.
CompareOptions compare_options(const Options& options, InitialState otherwise = InitialState::kAuto);

/// The option hold: how inputs go on between samples.
Hold hold_option(const Options& options, Hold fallback);

/// The option labels: no label, or one for each of `count` models.
std::vector<std::string> labels_option(const Options& options, std::size_t count);
/// The option confidence: a probability between 0 and 1.
double confidence_option(const Options& options);

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
/// The data with driving_input() as the input; `storage` holds the copy if the input changes.
const IdData& driving_data(const Call& call, int index, const IdData& data, IdData& storage);

/// Converts a number at `index`, the place of the options, to the table {k = number}: compare(data, G, 5).
void read_steps_as_option(const Call& call, int index);
/// The option k: a whole number of steps from 1 on, or nothing for math.huge, a simulation.
std::optional<Index> steps_option(const Options& options, std::optional<Index> fallback);
/// A model's name in a legend: "arx, 5 steps ahead", or the name alone for a simulation.
Message with_steps(const Message& name, const std::optional<Index>& steps);

}  // namespace dynlab::inline scripting
