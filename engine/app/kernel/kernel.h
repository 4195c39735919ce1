#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline app {

/// A Jupyter kernel for the notebooks whose sockets `connection_file` names (protocol 5.3). It runs until a message
/// requests its end. Call this function before the program has threads. `version`: of dynlab. Throws EnvironmentError.
void serve_kernel(const std::filesystem::path& connection_file, const std::string& version);

}  // namespace dynlab::inline app
