#pragma once
#include "scripting/arguments/estimator_arguments.h"

namespace dynlab::inline scripting {

EstimationReaders transfer_estimation_readers();
EstimationReaders noise_model_readers();
EstimationReaders loop_readers();
EstimationReaders recursive_readers();

/// The reader of a method's arguments by its Lua name; nullptr for a method that has none.
EstimationReader find_estimation_reader(const std::string& method);
/// Names of all methods that have one.
std::vector<std::string> estimation_names();

}  // namespace dynlab::inline scripting
