#pragma once
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {

/// What a script can ask of a fit; its sentences name the options as scripts do. `method` is the Lua name.
Estimate estimate_of(const char* method, const Fit& fit);

/// Pushes the fitted model with all its channels.
int give_fit(const Call& call, Estimate estimate, const Fit& fit);

}  // namespace dynlab::inline scripting
