#pragma once
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// Functions on a data object or a signal that are methods of data objects as well: detrend(data, ...) is
/// data:detrend(...).
int detrend_signals(Call& call);
int filter_signals(Call& call);
int resample_signals(Call& call);
int keep_parts(Call& call);
int discard_parts(Call& call);
int merge_data(Call& call);

}  // namespace dynlab::inline scripting
