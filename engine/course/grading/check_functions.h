#pragma once
#include "scripting/runtime/function_entry.h"

namespace dynlab::inline course {

/// What checks.lua may call besides everything that lessons may, and besides check_record_functions: check, near,
/// points_between, all_of, any_of, differs, has_figure, has_value, no_finding. Their state is the service CheckSession.
FunctionEntries check_functions();

/// One more, for the engine: _verdict(k) tries the k-th declared check and leaves its verdict in the session.
FunctionEntries verdict_function();

}  // namespace dynlab::inline course
