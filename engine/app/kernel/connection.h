#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline app {

/// What Jupyter writes for a kernel: where to listen, and the key that signs messages.
struct KernelConnection {
    std::string transport, ip, key;
    int shell = 0, control = 0, stdin_ = 0, iopub = 0, heartbeat = 0;

    std::string address(int port) const;  ///< "tcp://127.0.0.1:5555"
};

/// Throws EnvironmentError for a file that is no such description, has no key, or asks for another signature than
/// HMAC-SHA256.
KernelConnection read_connection(const std::filesystem::path& file);

}  // namespace dynlab::inline app
