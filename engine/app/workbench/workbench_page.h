#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "app/server/web_server.h"

namespace dynlab::inline app {

struct WorkbenchOptions {
    std::string subject;       ///< a data file, a data set, a lesson, or a script; empty: a session without data
    int port = 0;              ///< any free one
    bool run_at_once = false;  ///< the scripts of this folder are allowed from now on
    /// Gets the session's script, too.
    std::function<void(const std::string& address, Visit, const std::filesystem::path& script)> opened =
        [](const std::string&, Visit, const std::filesystem::path&) {};
};

/// Serves a session until Ctrl-C (which throws Interrupted). A script is opened unchanged; for a data set, a new script
/// is created in the current folder, under the data set's name. Call this function before the program has threads.
/// Throws EnvironmentError for a subject that cannot be opened.
void serve_workbench(const WorkbenchOptions& options);

}  // namespace dynlab::inline app
