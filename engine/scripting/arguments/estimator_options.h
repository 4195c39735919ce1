#pragma once
#include <array>

#include "numerics/fit/fit.h"
#include "scripting/conversions/option_member.h"

namespace dynlab::inline scripting {

/// The options and arguments that families of estimators share. What is a member of FitOptions is read by
/// read_fit_options() (estimator_arguments.h).

inline constexpr std::array kHolds = {"zoh", "foh"};  // in the order of Hold
inline constexpr std::array kInitialStates = {"none", "steady", "estimate", "auto"};
inline constexpr std::array kOffsets = {"none", "remove", "estimate", "auto"};

/// Of an options struct that has the member.
template <class T>
inline constexpr OptionEntry kHoldOfOutput =
    option<&T::hold_y>("hold_y",
                       about("intersample behavior of the output in the filters: linear interpolation (\"foh\") or "
                             "zero-order hold (\"zoh\")"),
                       {.initial = "\"foh\"", .choices = kHolds});

inline constexpr std::array kFirstFilterOptions = {
    option<&FitOptions::lambda>(
        "lambda",
        about(
            "cutoff frequency of the filter of the initial estimate; by default, the method tries several frequencies"),
        {.unit = "rad/s"}),
    option<&FitOptions::hold_y>(
        "hold_y", about("intersample behavior of the output in the filters; this option does not affect the result"),
        {.initial = "\"foh\"", .choices = kHolds})};

inline constexpr std::array kStartOptions = {
    option<&FitOptions::initial_state>(
        "InitialState",
        about("initial state: at rest with zero input (\"none\"), at rest with the first input value (\"steady\"), "
              "estimated (\"estimate\"), or the choice with the smallest BIC (\"auto\")"),
        {.initial = "\"auto\"", .choices = kInitialStates, .former = "zero", .member = "initial_state"}),
    option<&FitOptions::offset>(
        "Offset",
        about("constant offset of the output: zero (\"none\"), removed with the operating point before the estimation "
              "(\"remove\"), estimated (\"estimate\"), or the better of \"none\" and \"estimate\" by BIC (\"auto\"). "
              "If you specify only one of InitialState and Offset, the other option remains \"auto\""),
        {.initial = "\"auto\"", .choices = kOffsets, .member = "offset"})};

inline constexpr OptionEntry kTolerance = option<&FitOptions::tolerance>(
    "Tol", about("the search stops when the relative change of the parameters is below this value"),
    {.initial = "1e-6", .member = "tolerance"});
inline constexpr std::array kIterationOptions = {
    option<&FitOptions::max_iterations>("MaxIter",
                                        about("maximum number of iterations. By default, a search that has not "
                                              "converged after 50 iterations continues for up to 500 more iterations"),
                                        {.minimum = 0, .member = "max_iterations"}),
    kTolerance};
/// Of methods that end there in any case.
inline constexpr std::array kLimitOptions = {
    option<&FitOptions::max_iterations>("MaxIter", about("maximum number of iterations"),
                                        {.minimum = 0, .member = "max_iterations"}),
    kTolerance};

inline constexpr std::array kIntegrationOptions = {option<&FitOptions::integration>(
    "Integration", about("true adds an integrator to the model, G = B/(s F); only for inputs with zero-order hold"),
    {.member = "integration"})};

inline constexpr OptionEntry kCommonDenominator = {
    "CommonDenominator", ValueKind::kFlag, about("true uses one denominator F for all channels"), {.initial = "false"}};
inline constexpr std::array kSharingOptions = {kCommonDenominator};

inline constexpr OptionEntry kStableOption = option<&FitOptions::stable>(
    "Stable",
    about(
        "true allows only models with all poles in the left half-plane; false returns the best fit regardless of its "
        "poles. By default, an unstable model is returned only if its loss is at least 2 % lower than that of the best "
        "stable model"),
    {.member = "stable"});
inline constexpr OptionEntry kFixedOption = option<&FitOptions::fixed>(
    "Fixed", about("known parameters that are not estimated, such as {a2 = 4}"), {.member = "fixed"});
inline constexpr std::array kSearchOptions = {
    kStableOption, kFixedOption,
    option<&FitOptions::output_weights>("OutputWeights",
                                        about("weights of the errors, one per output if there are several outputs; by "
                                              "default 1/(standard deviation of the errors)"),
                                        {.member = "output_weights"})};

/// With the description of TdMax, whose default and limits depend on the function.
constexpr std::array<OptionEntry, 3> delay_search_options(MessageId<> largest_delay) {
    return {
        option<&FitOptions::least_delay>("TdMin", about("smallest delay in the search"),
                                         {.unit = "s", .member = "least_delay"}),
        option<&FitOptions::largest_delay>("TdMax", largest_delay, {.unit = "s", .member = "largest_delay"}),
        option<&FitOptions::delay_count>("NumTd", about("maximum number of delays on the initial grid of the search"),
                                         {.member = "delay_count"})};
}
inline constexpr std::array kDelayOptions = delay_search_options(
    about("largest delay in the search, by default a bound computed from the data; 0 for no delay"));
/// Read by structure_of_counts().
inline constexpr OptionEntry kKnownDelayOption = {"IODelay",
                                                  ValueKind::kVector,
                                                  about("known delay, which is not estimated; with several channels, "
                                                        "one number for all or a table with one per channel"),
                                                  {.unit = "s", .member = "delay"}};
inline constexpr std::array kFixedDelayOptions = {kKnownDelayOption};
/// Read by started_structure().
inline constexpr std::array kKnownDelayOptions = {
    kKnownDelayOption, OptionEntry{"Td0",
                                   ValueKind::kVector,
                                   about("initial value of the delay for the search, instead of a grid"),
                                   {.unit = "s"}}};

inline constexpr ArgumentEntry kDataArgument = {"data", ValueKind::kData,
                                                about("data object or measured frequency response (idfrd)")};
inline constexpr ArgumentEntry kOneOutputData = {
    "data", ValueKind::kData,
    about("regularly sampled data object with one output, and with one or several inputs and experiments")};
inline constexpr ArgumentEntry kFilterFrequency = {
    "lambda", ValueKind::kNumber,
    about("cutoff frequency of the filter in rad/s, usually slightly above the bandwidth of the system")};
inline constexpr ArgumentEntry kPoleCount = {
    "np", ValueKind::kCount,
    about("number of poles; with several inputs or outputs, one number for all or a table with one per channel")};
inline constexpr ArgumentEntry kZeroCount = {
    "nz", ValueKind::kCount,
    about("number of zeros; with several inputs or outputs, one number for all or a table with one per channel")};

}  // namespace dynlab::inline scripting
