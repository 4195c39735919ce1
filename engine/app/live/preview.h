#pragma once
#include <functional>
#include <string>

#include "app/server/web_server.h"

namespace dynlab::inline app {

struct PreviewOptions {
    std::string document;  ///< a script, a folder with analysis.lua and report.md, or a lesson
    int port = 0;          ///< any free one
    bool run_at_once = false;
    bool edit = false;  ///< the page changes the document's files, too
    std::function<void(const std::string& address, Visit)> opened = [](const std::string&, Visit) {};
};

/// Serves a document that follows its source until Ctrl-C (which throws Interrupted). Returns at once if another
/// program already serves it. For a folder whose scripts are not allowed to run yet, the page shows the document and
/// asks for permission. Call this function before the program has threads. Throws DocumentError and EnvironmentError
/// for files that cannot be opened.
void preview(const PreviewOptions& options);

}  // namespace dynlab::inline app
