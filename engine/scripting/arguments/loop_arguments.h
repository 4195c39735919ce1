#pragma once
#include <array>

#include "numerics/fit/closed_loop/loop_signals.h"
#include "scripting/arguments/estimator_options.h"

namespace dynlab::inline scripting {

/// The model of argument `index` or on the stack there as the controller of a loop; a number is a gain in continuous
/// time. Throws InvalidArgument for one with several inputs or outputs.
LoopController controller_at(const Call& call, int index);

/// The option ComputingDelay: whole samples; 0 unless given.
Index computing_delay_of(const Options& options);

inline constexpr std::array kLoopOptions = {
    OptionEntry{
        "controller", ValueKind::kModel,
        about("the controller of the loop, a model with the sampling time of the data or in continuous time, or "
              "a number; it need not be known")},
    OptionEntry{
        "ComputingDelay", ValueKind::kCount,
        about("samples that a sampled controller takes to answer; if absent, the data decide between none and one")},
    option<&LoopKnowledge::hold_r>(
        "hold_r", about("how the reference behaves between its samples, with a controller in continuous time"),
        {.initial = "\"zoh\"", .choices = kHolds})};
/// Of kLoopOptions; without ComputingDelay the record decides between none and one
/// sample.
LoopKnowledge loop_knowledge(const Options& options);

}  // namespace dynlab::inline scripting
