#pragma once
#include <string>
#include <vector>

#include "scripting/runtime/function_entry.h"

namespace dynlab::inline course {

/// Functions for checks.lua in addition to those of lessons and to check_data_functions. They use the CheckSession
/// with which they are added.
FunctionEntries check_declarations();      ///< check, change_check, drop_check, declare_plant
FunctionEntries check_functions();         ///< near, points_between, all_of, any_of, differs, has_figure, ...
FunctionEntries check_source_functions();  ///< source, calls

/// An additional function for the engine: _verdict(k) runs the k-th declared check and stores its result in the
/// session.
FunctionEntries outcome_function();

/// The names of all functions that check files may call in addition to those of scripts.
std::vector<std::string> names_of_check_functions();

}  // namespace dynlab::inline course
