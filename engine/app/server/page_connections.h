#pragma once
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>

#include "app/server/http_connection.h"

namespace dynlab::inline app {

/// The connections of a server on 127.0.0.1, each with a thread.
///
/// Every user of the machine can connect. Only a few connections that are not yet known as the user's own are kept: a
/// new connection closes the oldest of them, so that a program that opens many connections locks no one out.
class PageConnections {
  public:
    /// Serves a connection to its end; `known` says that it is the user's.
    using Serve = std::function<void(HttpConnection&, const std::function<void()>& known)>;
    struct Limits {
        std::ptrdiff_t unknown = 16, known = 64;
    };

    /// Takes `port`, or one that is free where it is 0. Throws EnvironmentError where it cannot be had.
    explicit PageConnections(int port);
    ~PageConnections();  ///< ends all
    int port() const { return port_; }
    /// `fields` begin every reply.
    void start(Serve serve, Limits limits, std::string fields);
    void end();

  private:
    struct Open {
        int socket;
        bool known = false, dropped = false;
    };
    bool take(int port);
    void accept_all();
    void begin(FileDescriptor socket);

    FileDescriptor listening_, guard_, ending_;  ///< ending_ is readable from the end on
    int port_ = 0;
    Serve serve_;
    Limits limits_;
    std::string fields_;
    std::mutex mutex_;
    std::condition_variable closed_;
    std::list<Open> open_;  ///< in the order in which they came
    std::thread accepting_;
};

}  // namespace dynlab::inline app
