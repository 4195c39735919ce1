#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "app/server/web_server.h"

namespace dynlab::inline app {

struct OfficeOptions {
    std::filesystem::path course = ".";  ///< the folder, or one below it
    int port = 0;                        ///< any free one
    std::function<void(const std::string& address, Visit)> opened = [](const std::string&, Visit) {};
};

/// Serves the instructor's page of a course until Ctrl-C (which throws Interrupted). The page itself changes nothing:
/// each of its actions is a command of `dynlab course` that runs as a separate process. Throws EnvironmentError if
/// there is no course.
void serve_office(const OfficeOptions& options);

}  // namespace dynlab::inline app
