#pragma once
#include <string>

#include "documents/percent_script.h"
#include "documents/run_record.h"

namespace dynlab::inline workflow {

/// An error of a script as a terminal shows it: the sentence behind `path:line:`, the path as the script's was given,
/// so that editors find the place; below it the line itself; then the calls that led there, each with its place and
/// its line. Lines of files that the script required are read from its folder; one that is not there is left out.
Message error_message(const RecordedError& error, const PercentScript& script);
/// In the language of the script.
std::string error_text(const RecordedError& error, const PercentScript& script);

}  // namespace dynlab::inline workflow
