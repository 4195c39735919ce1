#pragma once
#include <array>

#include "numerics/fit/closed_loop/loop_signals.h"
#include "scripting/arguments/estimator_options.h"

namespace dynlab::inline scripting {

/// The model of argument `index` or on the stack there as the controller of a loop; a number is a gain in continuous
/// time. Throws InvalidArgument for one with several inputs or outputs.
LoopController controller_at(const Call& call, int index);

/// The option ComputingDelay: number of samples. Default: 0.
Index computing_delay_of(const Options& options);

inline constexpr std::array kLoopOptions = {
    OptionEntry{"controller", ValueKind::kModel,
                about("controller of the loop: a continuous-time model, a discrete-time model with the sampling time "
                      "of the data, or a number; optional")},
    OptionEntry{"ComputingDelay", ValueKind::kCount,
                about("delay of a sampled controller in samples; by default 0 or 1, determined from the data")},
    option<&LoopKnowledge::hold_r>("hold_r",
                                   about("intersample behavior of the reference for a continuous-time controller"),
                                   {.initial = "\"zoh\"", .choices = kHolds})};
/// Reads kLoopOptions. Without ComputingDelay, the data decide between no delay and one sample.
LoopKnowledge loop_knowledge(const Options& options);

}  // namespace dynlab::inline scripting
