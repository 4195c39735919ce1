#include "app/kernel/connection.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline app {

std::string KernelConnection::address(int port) const {
    return fmt::format("{}://{}{}{}", transport, ip, transport == "ipc" ? "-" : ":", port);
}

KernelConnection read_connection(const std::filesystem::path& file) {
    using nlohmann::json;
    const json reported = json::parse(read_text(file), nullptr, false);
    KernelConnection connection;
    try {
        connection.transport = reported.value("transport", "tcp");
        connection.ip = reported.at("ip").get<std::string>();
        connection.key = reported.value("key", "");
        for (const auto& [name, port] :
             {std::pair{"shell_port", &KernelConnection::shell}, std::pair{"control_port", &KernelConnection::control},
              std::pair{"stdin_port", &KernelConnection::stdin_}, std::pair{"iopub_port", &KernelConnection::iopub},
              std::pair{"hb_port", &KernelConnection::heartbeat}})
            connection.*port = reported.at(name).get<int>();
        if (connection.key.empty())
            throw EnvironmentError(
                "{} has no key, so any user of this machine could run cells. Let Jupyter write the file with a key; do "
                "not set Session.key to an empty string",
                file.string());
        const std::string scheme = reported.value("signature_scheme", "hmac-sha256");
        if (scheme != "hmac-sha256")
            throw EnvironmentError(
                "{}: the messages are signed with {}, but dynlab supports only hmac-sha256. Remove "
                "Session.signature_scheme from the configuration of Jupyter",
                file.string(), scheme);
    } catch (const json::exception&) {
        throw EnvironmentError(
            "{} is not a Jupyter connection file. Do not start the kernel yourself: run jupyter notebook, "
            "which starts the kernel",
            file.string());
    }
    return connection;
}

}  // namespace dynlab::inline app
