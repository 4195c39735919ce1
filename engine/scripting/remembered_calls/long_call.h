#pragma once
#include "scripting/arguments/arguments.h"

namespace dynlab::inline scripting {

/// Calls `body`, or gives what an equal call of the same function gave that took long: the values, what it printed, the
/// figures it made. Calls are equal when all their arguments are, by content; those with functions of the script among
/// their arguments are made anew, and so are all without RunOptions::long_calls.
int run_long_call(Call& call, Binding body);

/// A binding of which this is worth it: `guarded<long_call<body>>`. What it does must follow from its arguments alone.
template <Binding kBody>
int long_call(Call& call) {
    return run_long_call(call, kBody);
}

}  // namespace dynlab::inline scripting
