#pragma once
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// Calls `body`, or gives what an equal call of the same function gave that took long: the values, what it printed, the
/// figures it made. Calls are equal when all their arguments are, by content; those with functions of the script among
/// their arguments are made anew, and so are all without RunOptions::call_cache.
int run_memoized_call(Call& call, Binding body);

/// A binding of which this is worth it: `guarded<memoized_call<body>>`. What it does must follow from its arguments
/// alone, and it must leave what they hold as it is.
template <Binding kBody>
int memoized_call(Call& call) {
    return run_memoized_call(call, kBody);
}

}  // namespace dynlab::inline scripting
