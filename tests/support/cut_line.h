#pragma once
#include <atomic>
#include <cstddef>
#include <list>
#include <mutex>
#include <string>
#include <thread>

#include "platform/system_call.h"

namespace dynlab::test {

/// A line between a browser and a server of this machine that can be cut, and that counts what the server sends: it
/// listens at a port with as many digits as the server's and passes everything on, its own port in requests replaced by
/// that of the server.
class CutLine {
  public:
    explicit CutLine(const std::string& address);  ///< of the server; throws std::runtime_error
    ~CutLine();
    /// Of a page of the server, by this line.
    std::string address(const std::string& of_server) const;
    void cut();  ///< ends all connections and takes no new ones
    void restore() { cut_ = false; }
    std::size_t bytes_from_server() const { return bytes_from_server_; }

  private:
    struct Connection {
        FileDescriptor from, to;
    };
    void listen();
    void pass_on(Connection& connection);

    std::string name_;  ///< of the server's host
    int server_ = 0, port_ = 0;
    FileDescriptor socket_;
    std::atomic<std::size_t> bytes_from_server_ = 0;
    std::atomic<bool> cut_ = false, over_ = false;
    std::mutex mutex_;
    std::list<Connection> connections_;
    std::list<std::thread> workers_;
    std::thread listener_;
};

}  // namespace dynlab::test
