#pragma once
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "app/server/entrance.h"
#include "base/message.h"

namespace dynlab::inline app {

/// What a page of ours asks.
struct PageRequest {
    std::string path;
    std::map<std::string, std::string> parameters;  ///< behind the question mark
    std::string body;                               ///< of a POST

    const std::string& parameter(const std::string& name) const;  ///< throws EnvironmentError when it is not given
};

struct PageReply {
    std::string body;
    std::string type = "text/html; charset=utf-8";
    int status = 200;
};

/// Why an address is printed.
enum class Visit {
    kFirst,      ///< the page answers from now on
    kElsewhere,  ///< another program shows the document there already
    kLate,       ///< a visitor opened an expired or used address
};

/// Serves pages to this machine's browser: HTTP on 127.0.0.1, requests and one stream of events a tab. Who may ask:
/// entrance.h.
class WebServer {
  public:
    struct Options {
        int port = 0;  ///< any free one
        std::size_t largest_body = std::size_t{8} << 20;
        int max_streams = 24;
        std::function<std::string(const Message&)> translated =
            {};  ///< text of a message for the reader; English without
    };
    using Handler = std::function<PageReply(const PageRequest&)>;

    /// Throws EnvironmentError when the port is taken.
    explicit WebServer(Options options);
    ~WebServer();  ///< ends all streams
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    /// Handlers run in threads of the server; what they throw becomes a reply with status 500 and its sentence. A path
    /// that ends in /* is that of all files of a folder. Call before start().
    void on_get(const std::string& path, Handler handler);
    void on_post(const std::string& path, Handler handler);
    /// The data of the event "page" with which a stream begins.
    void on_stream(std::function<std::string()> first);
    /// Called by a thread of the server when a visitor opened an expired or used address: print a new one.
    void on_late_visit(std::function<void()> notify);
    void start();

    int port() const;
    const EntranceKey& key() const;
    std::string address() const { return key().address(); }  ///< another one each time, for one visit within a minute
    /// An event for all streams; a tab that does not keep up with 64 MB of them is dropped and comes again.
    void send(const std::string& event, const std::string& data);
    int streams() const;

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace dynlab::inline app
