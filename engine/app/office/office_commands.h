#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline app {

/// The folder below the course's in which the page's commands read and write files.
inline constexpr char kExchangeFolder[] = "exports";

/// A command of the page as a terminal in the course's folder takes it.
struct OfficeCommand {
    std::vector<std::string> words;  ///< "course", "mark", "lab4", ...
    std::string line;                ///< to be copied into a terminal
};

/// The command of these words. Options are --name or --name=value. Throws EnvironmentError for anything but the
/// commands that the page has, for other options, for files outside of kExchangeFolder, and for control characters.
OfficeCommand office_command(const std::vector<std::string>& words);

/// How a command went.
struct OfficeResult {
    std::string line;
    int code = 0;
    std::string words;  ///< what it printed
};
/// Runs the command as a separate process in the course's folder; its messages are in `language`.
OfficeResult run_office_command(const OfficeCommand& command, const std::filesystem::path& course,
                                const std::string& language);

}  // namespace dynlab::inline app
