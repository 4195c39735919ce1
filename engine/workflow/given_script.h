#pragma once
#include <filesystem>
#include <string>

#include "base/message.h"

namespace dynlab::inline workflow {

/// What `given` is where its ending tells that it is neither script nor notebook, and what `dynlab COMMAND` wants
/// instead: "report.md is the report's text: give the folder, dynlab report my-work". Empty for whatever else, folders
/// and what is not there among it.
Message why_no_script(const std::filesystem::path& given, const std::string& command);

/// What stands in `folder` instead of the file `name`, behind a comma in a sentence that it is missing: "but
/// Analysis.lua: call it analysis.lua". Empty where nothing is called nearly so.
Message nearly_called(const std::filesystem::path& folder, const std::string& name);

/// The script that is meant: the file itself, or the analysis.lua of a folder. Throws EnvironmentError for a folder
/// without one, and for a file that is not there while another is called nearly so.
std::filesystem::path meant_script(const std::filesystem::path& given);

/// The language of a folder with an analysis.lua, of a script or of a notebook: that of the header of report.md
/// (`lang: fr`), else that of the script (`language: fr`). Empty where neither can be read.
std::string language_of_work(const std::filesystem::path& work);

}  // namespace dynlab::inline workflow
