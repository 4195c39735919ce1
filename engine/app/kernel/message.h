#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/error.h"

namespace dynlab::inline app {

/// A message of Jupyter's protocol: https://jupyter-client.readthedocs.io/en/stable/messaging.html
struct KernelMessage {
    std::vector<std::string> identities;  ///< of who asked; a topic, where all hear it
    nlohmann::json header = nlohmann::json::object(), parent = nlohmann::json::object(),
                   content = nlohmann::json::object();

    std::string type() const { return header.value("msg_type", ""); }
};

/// Frames that are no message, or not signed with our key.
class BadMessage : public EnvironmentError {
  public:
    using EnvironmentError::EnvironmentError;
};

/// Takes messages apart and puts them together; with an empty key nothing is signed.
class MessageWire {
  public:
    explicit MessageWire(std::string key);
    KernelMessage read(const std::vector<std::string>& frames) const;  ///< throws BadMessage
    std::vector<std::string> write(const KernelMessage& message) const;

    /// A message of our own that follows from `parent`.
    KernelMessage made(const std::string& type, nlohmann::json content, const KernelMessage& parent);

  private:
    std::string key_, session_;
    std::size_t count_ = 0;
};

}  // namespace dynlab::inline app
