#pragma once
#include "numerics/estimators/grey_box/greyest.h"
#include "numerics/validation/compare.h"

namespace dynlab::inline numerics {

/// Where an estimate starts from on other data: as it did on its own, an estimated initial state estimated again.
GreyStart usual_start(const GreyFit& grey);

/// Simulates an estimated grey-box model on the inputs of every experiment and compares with its outputs. An initial
/// state that is estimated is found by a search over it alone. Throws InvalidArgument for data of other channels than
/// the model and where a simulation breaks down.
Comparison compare_grey(const IdData& data, const GreyFit& grey, GreyStart initial_state);

}  // namespace dynlab::inline numerics
