#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "base/message.h"

namespace dynlab::inline workflow {

/// If the ending of `given` shows that it is neither script nor notebook: what it is, and what `dynlab COMMAND` expects
/// instead: "report.md is the report's text: give the folder, dynlab report my-work". Empty for all other arguments,
/// including folders and missing files.
Message why_no_script(const std::filesystem::path& given, const std::string& command);

/// The file in `folder` with a name similar to the missing file `name`, for the end of a sentence after a comma: "but
/// Analysis.lua: call it analysis.lua". Empty if no file has a similar name.
Message nearly_called(const std::filesystem::path& folder, const std::string& name);

/// The script, notebook or folder of work next to the missing `given` whose name is nearest, as the user would type it.
std::optional<std::filesystem::path> nearest_work(const std::filesystem::path& given);

/// The error message for a script or a folder that does not exist. Suggests nearest_work().
Message no_such_work(const std::filesystem::path& given);

/// The script that is meant: the file itself, or the analysis.lua of a folder. Throws EnvironmentError for a folder
/// without one, and no_such_work() for a file that does not exist.
std::filesystem::path meant_script(const std::filesystem::path& given);

/// The language of a folder with an analysis.lua, of a script or of a notebook: that of the header of report.md
/// (`lang: fr`), else that of the script (`language: fr`). Empty where neither can be read.
std::string language_of_work(const std::filesystem::path& work);

}  // namespace dynlab::inline workflow
