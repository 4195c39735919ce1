#pragma once
#include <string>

#include "course/intake/issue.h"
#include "documents/percent_script.h"

namespace dynlab::inline course {

/// Adds the hint script-empty if the script has no code: a script of text alone passes all other checks. `place`: where
/// the code belongs.
void add_if_without_code(const PercentScript& script, const std::string& place, Issues& findings);

}  // namespace dynlab::inline course
