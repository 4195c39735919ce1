#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline app {

/// A Jupyter kernel for the notebooks that `connection_file` names the sockets of (protocol 5.3), until it is told to
/// end. To be called before the program has threads. `version`: of dynlab. Throws EnvironmentError.
void serve_kernel(const std::filesystem::path& connection_file, const std::string& version);

}  // namespace dynlab::inline app
