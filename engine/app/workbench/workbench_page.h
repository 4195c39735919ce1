#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "app/server/web_server.h"

namespace dynlab::inline app {

struct WorkbenchOptions {
    std::string subject;       ///< a data file, a data set, a lesson, or a script; empty: a session without a record
    int port = 0;              ///< any free one
    bool run_at_once = false;  ///< the scripts of this folder are allowed from now on
    /// Gets the session's script, too.
    std::function<void(const std::string& address, Visit, const std::filesystem::path& script)> opened =
        [](const std::string&, Visit, const std::filesystem::path&) {};
};

/// Serves a session until Ctrl-C (which throws Interrupted). A script is opened as it is; of a record a new script is
/// begun, in the current folder, under the record's name. To be called before the program has threads. Throws
/// EnvironmentError for what cannot be opened.
void serve_workbench(const WorkbenchOptions& options);

}  // namespace dynlab::inline app
