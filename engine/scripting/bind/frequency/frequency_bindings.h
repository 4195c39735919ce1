#pragma once
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// srivc, coe, tfsrivc and tfcoe of a response at argument 1, by the name the script called.
int fit_response(Call& call);
/// lssvf of one.
int filter_response(Call& call);

}  // namespace dynlab::inline scripting
