#pragma once
#include <optional>
#include <string>

#include "platform/system_call.h"

namespace dynlab::inline app {

/// One end of a line between two processes: messages of any length, each with an open file if wanted.
class Channel {
  public:
    struct Message {
        std::string bytes;
        FileDescriptor file;
    };

    explicit Channel(FileDescriptor end) : end_(std::move(end)) {}
    static std::pair<Channel, Channel> pair();  ///< throws EnvironmentError

    /// False when the other side is gone.
    bool send(const std::string& bytes, int file = -1);
    /// Waits; nothing when the other side is gone.
    std::optional<Message> receive();
    int descriptor() const { return end_.get(); }  ///< to be polled
    FileDescriptor release() { return std::move(end_); }

  private:
    FileDescriptor end_;
};

}  // namespace dynlab::inline app
