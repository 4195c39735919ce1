#pragma once
#include "numerics/validation/advice.h"

namespace dynlab::inline numerics {

/// Of irregular instants: "mixed_sampling", two clocks one after the other (at least a twentieth of the steps in a row
/// differ from the usual one by more than 5 %), or "gaps", a clock with samples missing (steps of more than one and a
/// half usual ones). A clock that is now a bit late and now a bit early is neither, and no fault.
void find_sampling(const IdData& data, std::vector<DataIssue>& findings);

}  // namespace dynlab::inline numerics
