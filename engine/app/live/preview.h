#pragma once
#include <functional>
#include <string>

namespace dynlab::inline app {

struct PreviewOptions {
    std::string document;  ///< a script, a folder with analysis.lua and report.md, or a lesson
    int port = 0;          ///< the document's own where it is free, else any
    bool run_at_once = false;
    bool edit = false;  ///< the page changes the document's files, too
    /// Gets the page's address once it answers; `elsewhere`: another program shows this document there already.
    std::function<void(const std::string& address, bool elsewhere)> opened = [](const std::string&, bool) {};
};

/// Serves a document that follows its source until Ctrl-C (which throws Interrupted); returns at once when another
/// program does. A folder whose scripts nobody has
/// allowed to run yet is shown and asked about. To be called before the program has threads. Throws DocumentError and
/// EnvironmentError for what cannot be opened.
void preview(const PreviewOptions& options);

}  // namespace dynlab::inline app
