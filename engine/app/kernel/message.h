#pragma once
#include <deque>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_set>
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

/// Frames that are no message, not signed with our key, or a message that has come before.
class BadMessage : public EnvironmentError {
  public:
    using EnvironmentError::EnvironmentError;
};

/// Takes messages apart and puts them together.
class MessageWire {
  public:
    explicit MessageWire(std::string key);
    KernelMessage read(const std::vector<std::string>& frames);  ///< throws BadMessage; threads may share it
    std::vector<std::string> write(const KernelMessage& message) const;

    /// A message of our own that follows from `parent`.
    KernelMessage made(const std::string& type, nlohmann::json content, const KernelMessage& parent);

  private:
    void refuse_repetition(const std::string& signature);

    std::string key_, session_;
    std::mutex reading_;
    std::unordered_set<std::string> read_;  ///< signatures
    std::deque<std::string> order_;         ///< of these
    std::size_t count_ = 0;
};

}  // namespace dynlab::inline app
