#pragma once
#include <atomic>
#include <list>
#include <mutex>
#include <string>
#include <thread>

#include "platform/system_call.h"

namespace dynlab::test {

/// A line between a browser and a server of this machine that can be cut: it listens at a port with as many digits as
/// the server's and passes everything on, its own port in requests replaced by that of the server.
class CutLine {
  public:
    explicit CutLine(int port);  ///< of the server; throws std::runtime_error
    ~CutLine();
    int port() const { return port_; }
    void cut();  ///< ends all connections and takes no new ones
    void mend() { cut_ = false; }

  private:
    struct Connection {
        FileDescriptor from, to;
    };
    void listen();
    void pass_on(Connection& connection);

    int server_ = 0, port_ = 0;
    FileDescriptor socket_;
    std::atomic<bool> cut_ = false, over_ = false;
    std::mutex mutex_;
    std::list<Connection> connections_;
    std::list<std::thread> workers_;
    std::thread listener_;
};

}  // namespace dynlab::test
