#pragma once
#include <vector>

#include "numerics/validation/compare.h"
#include "scripting/arguments/arguments.h"

namespace dynlab::inline scripting {

/// The options InitialState and Offset of functions that simulate a model on a record.
CompareOptions compare_options(const Options& options, const char* initial_state = "auto");

/// The transfer functions of a model argument, one per input.
std::vector<TransferFunction> channels_argument(const Call& call, int index, const char* what);

}  // namespace dynlab::inline scripting
