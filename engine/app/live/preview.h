#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace dynlab::inline app {

struct PreviewOptions {
    std::string document;  ///< a script, a folder with analysis.lua and report.md, or a lesson
    int port = 0;          ///< any free one
    bool run_at_once = false;
    /// Gets the page's address once it answers.
    std::function<void(const std::string& address)> opened = [](const std::string&) {};
};

/// Serves a document that follows its source until Ctrl-C (which throws Interrupted). A folder whose scripts nobody has
/// allowed to run yet is shown and asked about. To be called before the program has threads. Throws DocumentError and
/// EnvironmentError for what cannot be opened.
void preview(const PreviewOptions& options);

}  // namespace dynlab::inline app
