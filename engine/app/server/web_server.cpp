#include "app/server/web_server.h"

#include <fmt/format.h>

#include <mutex>

#include "app/server/event_streams.h"
#include "app/server/page_connections.h"
#include "base/error.h"
#include "platform/error.h"

namespace dynlab::inline app {
namespace {

using namespace std::chrono_literals;

/// Beside those of streams; a browser opens six.
constexpr int kConnectionsForRequests = 32;
/// How often a silent stream looks whether its tab is gone, which gives its place to another, ...
constexpr auto kLook = 250ms;
/// ... and how often it says that it lives.
constexpr auto kSignOfLife = 20s;

/// What begins every reply. The pages' own scripts, styles and pictures only; no other site may frame or read them.
constexpr const char* kFields =
    "Content-Security-Policy: default-src 'self'; img-src 'self' data:; style-src 'self' 'unsafe-inline'; object-src "
    "'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'self'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Cross-Origin-Opener-Policy: same-origin\r\n"
    "Cache-Control: no-store\r\n";

}  // namespace

class WebServer::Work {
  public:
    explicit Work(Options options)
        : options_(options),
          streams_(static_cast<std::size_t>(options.max_streams)),
          connections_(options.port),
          entrance_(connections_.port()) {}

    ~Work() {
        streams_.end();
        connections_.end();
    }

    void start() {
        connections_.start([this](HttpConnection& connection, const auto& known) { serve(connection, known); },
                           {.known = options_.max_streams + kConnectionsForRequests}, kFields);
    }

    const Options options_;
    EventStreams streams_;
    PageConnections connections_;
    Entrance entrance_;
    std::map<std::string, Handler> gets_, posts_;  ///< by their paths
    std::function<std::string()> first_;
    std::function<void()> on_late_visit_ = [] {};
    std::mutex sending_;  ///< keeps news that are sent while first_() runs from overtaking it

  private:
    void serve(HttpConnection& connection, const std::function<void()>& known) {
        try {
            while (const auto head = connection.next_head())
                if (!answer(connection, *head, known)) return;
        } catch (const LastReply& last) {
            end(connection, last.reply);
        } catch (const std::exception& error) {  // no memory, for one
            end(connection, {500, kPlainText, error.what()});
        }
    }

    void end(HttpConnection& connection, const HttpReply& reply) {
        connection.reply(reply, true);
        connection.close();
        if (entrance_.had_late_visit()) on_late_visit_();
    }

    /// Whether the connection goes on.
    bool answer(HttpConnection& connection, const RequestHead& head, const std::function<void()>& known) {
        entrance_.admit(head);
        known();
        if (head.method == "GET" && head.path == "/events") return stream(connection), false;
        const Handler& handler = handler_of(head);
        if (*head.body > options_.largest_body)
            throw LastReply{{413, kPlainText, fmt::format("More than {} MB were sent.", options_.largest_body >> 20)}};
        std::optional<std::string> body = connection.body(*head.body);
        if (!body) return false;
        const HttpReply reply = made({head.path, head.parameters, std::move(*body)}, handler);
        const bool closes = !head.keeps_alive || connection.has_unread();
        return connection.reply(reply, closes, head.method == "HEAD") && !closes;
    }

    const Handler& handler_of(const RequestHead& head) const {
        const auto& handlers = head.method == "POST" ? posts_ : gets_;
        auto found = handlers.find(head.path);
        if (found == handlers.end()) found = handlers.find(head.path.substr(0, head.path.rfind('/') + 1) + "*");
        if (found == handlers.end()) throw LastReply{{404, kPlainText, "This page does not exist."}};
        return found->second;
    }

    HttpReply made(const PageRequest& request, const Handler& handler) const {
        try {
            PageReply reply = handler(request);
            return {reply.status, std::move(reply.type), std::move(reply.body)};
        } catch (const std::exception& error) {
            return {500, kPlainText, options_.translated ? options_.translated(message_of(error)) : error.what()};
        }
    }

    void stream(HttpConnection& connection) {
        std::unique_lock sending(sending_);
        const std::shared_ptr<EventStreams::Stream> stream = streams_.open();
        if (!stream) throw LastReply{{503, kPlainText, "Too many tabs of this page are open; close some."}};
        const std::shared_ptr<void> place(nullptr, [&](void*) { streams_.close(stream); });
        if (first_) stream->put(EventStreams::written("page", first_()));
        sending.unlock();
        bool open = connection.begin_stream("text/event-stream");
        auto silent = 0ms;
        while (open) {
            const std::optional<std::string> next = stream->take(kLook);
            silent = !next || next->empty() ? silent + kLook : 0ms;
            if (!next) break;
            if (next->empty())
                open = connection.is_open() && (silent < kSignOfLife || connection.write(": still here\n\n"));
            else
                open = connection.write(*next);
            if (silent >= kSignOfLife) silent = 0ms;
        }
        connection.close();
    }
};

const std::string& PageRequest::parameter(const std::string& name) const {
    const auto found = parameters.find(name);
    if (found == parameters.end()) throw EnvironmentError("the request lacks the parameter \"{}\"", name);
    return found->second;
}

WebServer::WebServer(Options options) : work_(std::make_unique<Work>(options)) {}
WebServer::~WebServer() = default;

void WebServer::on_get(const std::string& path, Handler handler) {
    work_->gets_[path] = std::move(handler);
}

void WebServer::on_post(const std::string& path, Handler handler) {
    work_->posts_[path] = std::move(handler);
}

void WebServer::on_stream(std::function<std::string()> first) {
    work_->first_ = std::move(first);
}

void WebServer::on_late_visit(std::function<void()> notify) {
    work_->on_late_visit_ = std::move(notify);
}

void WebServer::start() {
    work_->start();
}

int WebServer::port() const {
    return work_->connections_.port();
}

const EntranceKey& WebServer::key() const {
    return work_->entrance_.key();
}

void WebServer::send(const std::string& event, const std::string& data) {
    const std::lock_guard lock(work_->sending_);
    work_->streams_.send(event, data);
}

int WebServer::streams() const {
    return static_cast<int>(work_->streams_.count());
}

}  // namespace dynlab::inline app
