#pragma once
#include "numerics/fit/closed_loop/loop_signals.h"
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// The model of argument `index` or on the stack there as the controller of a loop; a number is a gain in continuous
/// time. Throws InvalidArgument for one with several inputs or outputs.
LoopController controller_at(const Call& call, int index);

/// The option ComputingDelay: whole samples; 0 unless given.
Index computing_delay_of(const Options& options);

/// The options controller, ComputingDelay and hold_r; without ComputingDelay the record decides between none and one
/// sample.
LoopKnowledge loop_knowledge(const Options& options);

}  // namespace dynlab::inline scripting
