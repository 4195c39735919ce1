#pragma once
#include <httplib.h>

#include "platform/system_call.h"

namespace dynlab::inline app {

/// An HTTP server that leaves a connection its time, and yet ends at once.
///
/// Browsers open connections before they ask. One that is closed until the first request comes is a file that the page
/// lacks: browsers ask again only where the connection had served before. A browser that gets no processor for a second
/// (a machine under load) was too late for httplib's own loop, whose waits also hold up its end.
class PageConnections : public httplib::Server {
  public:
    PageConnections();  ///< throws EnvironmentError
    /// As stop(), without a wait for connections that have not asked anything.
    void end();

  private:
    bool process_and_close_socket(socket_t socket) override;
    bool asks(socket_t socket) const;

    FileDescriptor ending_;  ///< readable from the end on
};

}  // namespace dynlab::inline app
