#include "app/server/web_server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sodium.h>

#include <csignal>
#include <memory>
#include <mutex>
#include <thread>

#include "app/server/event_streams.h"
#include "app/server/page_connections.h"
#include "platform/error.h"
#include "platform/hash.h"

namespace dynlab::inline app {
namespace {

using namespace std::chrono_literals;

/// Threads for requests beside those that streams hold: a connection that may still ask has one, and a browser opens
/// six.
constexpr std::size_t kThreadsForRequests = 32;
/// How often a silent stream looks whether its tab is gone, which gives its place to another, ...
constexpr auto kLook = 250ms;
/// ... and how often it says that it lives.
constexpr auto kSignOfLife = 20s;

const char* const kNoEntrance =
    "<!DOCTYPE html><title>dynlab</title><p>This page belongs to a dynlab that runs in a terminal. Open the address "
    "that it printed there, with everything behind the question mark.</p>";

std::string random_token() {
    if (sodium_init() < 0) throw EnvironmentError("cannot make random numbers");
    unsigned char bytes[16];
    randombytes_buf(bytes, sizeof bytes);
    char text[2 * sizeof bytes + 1];
    sodium_bin2hex(text, sizeof text, bytes, sizeof bytes);
    return text;
}

/// The value of a cookie among "a=1; b=2".
std::string cookie_of(const std::string& cookies, const std::string& name) {
    std::size_t at = 0;
    while (at < cookies.size()) {
        const std::size_t end = std::min(cookies.find(';', at), cookies.size());
        const std::size_t begin = cookies.find_first_not_of(' ', at);
        if (begin < end && cookies.compare(begin, name.size() + 1, name + "=") == 0)
            return cookies.substr(begin + name.size() + 1, end - begin - name.size() - 1);
        at = end + 1;
    }
    return {};
}

/// A pattern for httplib: the path itself, with * at its end for what follows.
std::string pattern_of(const std::string& path) {
    std::string pattern;
    for (const char c : path) {
        if (std::string_view(".+(){}[]^$|\\").find(c) != std::string_view::npos) pattern += '\\';
        pattern += c;
    }
    if (pattern.ends_with('*')) pattern.replace(pattern.size() - 1, 1, "[^/]*");
    return pattern;
}

}  // namespace

class WebServer::Work {
  public:
    explicit Work(Options options) : streams_(static_cast<std::size_t>(options.most_streams)), token_(random_token()) {
        std::signal(SIGPIPE, SIG_IGN);  // a tab that is gone must not end the program
        const std::size_t threads = static_cast<std::size_t>(options.most_streams) + kThreadsForRequests;
        server_.new_task_queue = [threads] { return new httplib::ThreadPool(threads); };
        server_.set_payload_max_length(options.largest_body);
        server_.set_tcp_nodelay(true);
        // Not SO_REUSEPORT, which would share a port that is taken.
        server_.set_socket_options([](socket_t socket) {
            const int yes = 1;
            ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        server_.set_default_headers(
            {{"Content-Security-Policy",
              "default-src 'self'; img-src 'self' data:; style-src 'self' 'unsafe-inline'; object-src 'none'; "
              "base-uri 'none'; form-action 'none'; frame-ancestors 'self'"},
             {"X-Content-Type-Options", "nosniff"},
             {"Referrer-Policy", "no-referrer"},
             {"Cross-Origin-Resource-Policy", "same-origin"},
             {"Cache-Control", "no-store"}});
        server_.set_pre_routing_handler(
            [this](const httplib::Request& asked, httplib::Response& reply) { return let_in(asked, reply); });
        server_.Get("/events", [this](const httplib::Request&, httplib::Response& reply) { stream(reply); });
        bind(options.port, options.wished_port);
    }

    ~Work() {
        streams_.end();
        server_.end();
        if (thread_.joinable()) thread_.join();
    }

    httplib::Server::Handler handler(Handler ours) {
        return [ours = std::move(ours)](const httplib::Request& asked, httplib::Response& reply) {
            PageRequest request{asked.path, {asked.params.begin(), asked.params.end()}, asked.body};
            try {
                PageReply answer = ours(request);
                reply.status = answer.status;
                give(reply, std::move(answer));
            } catch (const std::exception& error) {
                reply.status = 500;
                reply.set_content(error.what(), "text/plain; charset=utf-8");
            }
        };
    }

    void start() {
        thread_ = std::thread([this] { server_.listen_after_bind(); });
        while (!server_.is_running()) std::this_thread::sleep_for(1ms);  // stop() before that would be lost
    }

    PageConnections server_;
    EventStreams streams_;
    std::function<std::string()> first_;
    std::mutex sending_;  ///< news that are sent while first_() is made would stand before what is older
    int port_ = 0;
    const std::string token_;

  private:
    using Response = httplib::Server::HandlerResponse;

    void bind(int port, int wished_port) {
        if (port == 0 && wished_port > 0 && server_.bind_to_port("127.0.0.1", wished_port)) {
            port_ = wished_port;
        } else if (port == 0) {
            port_ = server_.bind_to_any_port("127.0.0.1");
        } else if (server_.bind_to_port("127.0.0.1", port)) {
            port_ = port;
        }
        if (port_ <= 0) {
            throw EnvironmentError(
                fmt::format("the port {} cannot be used: another program has it, or it is not allowed; leave --port "
                            "out for a free one",
                            port));
        }
    }

    std::string cookie_name() const { return fmt::format("dynlab-{}", port_); }

    bool is_ours(const std::string& host) const {
        for (const char* name : {"127.0.0.1", "localhost", "[::1]"})
            if (host == fmt::format("{}:{}", name, port_)) return true;
        return false;
    }

    /// As it is: what is set as content is compressed by httplib for browsers, which takes far longer than to send it
    /// within the machine.
    static void give(httplib::Response& reply, PageReply answer) {
        if (answer.body.empty()) return reply.set_content("", answer.type.c_str());
        const auto body = std::make_shared<const std::string>(std::move(answer.body));
        reply.set_content_provider(body->size(), answer.type.c_str(),
                                   [body](std::size_t from, std::size_t length, httplib::DataSink& sink) {
                                       return sink.write(body->data() + from, length);
                                   });
    }

    Response refuse(httplib::Response& reply, int status, const char* text) const {
        reply.status = status;
        reply.set_content(text, "text/html; charset=utf-8");
        return Response::Handled;
    }

    Response let_in(const httplib::Request& asked, httplib::Response& reply) const {
        const std::string host = asked.get_header_value("Host"), origin = asked.get_header_value("Origin");
        if (!is_ours(host)) return refuse(reply, 403, "This address is not that of a dynlab.");
        if (asked.has_header("Origin") && origin != "http://" + host)
            return refuse(reply, 403, "Other sites may not ask here.");
        if (equal_in_constant_time(cookie_of(asked.get_header_value("Cookie"), cookie_name()), token_)) {
            if (!asked.has_param("token")) return Response::Unhandled;
        } else if (!equal_in_constant_time(asked.get_param_value("token"), token_) || asked.path != "/") {
            return refuse(reply, 403, kNoEntrance);
        }
        reply.set_header("Set-Cookie", fmt::format("{}={}; Path=/; SameSite=Strict; HttpOnly", cookie_name(), token_));
        reply.set_redirect("/", 303);
        return Response::Handled;
    }

    void stream(httplib::Response& reply) {
        std::unique_lock sending(sending_);
        const std::shared_ptr<EventStreams::Stream> stream = streams_.open();
        if (!stream) {
            reply.status = 503;
            reply.set_content("There are too many tabs of this page; close some.", "text/plain; charset=utf-8");
            return;
        }
        if (first_) stream->put(EventStreams::written("page", first_()));
        sending.unlock();
        const auto give = [stream](std::size_t, httplib::DataSink& sink) {
            std::optional<std::string> next;
            for (auto silent = 0ms; silent < kSignOfLife; silent += kLook) {
                next = stream->take(kLook);
                if (!next || !sink.is_writable()) return false;
                if (!next->empty()) break;
            }
            const std::string text = next->empty() ? ": still here\n\n" : *next;
            return sink.write(text.data(), text.size());
        };
        reply.set_chunked_content_provider("text/event-stream", give, [this, stream](bool) { streams_.close(stream); });
    }

    std::thread thread_;
};

const std::string& PageRequest::parameter(const std::string& name) const {
    const auto found = parameters.find(name);
    if (found == parameters.end()) throw EnvironmentError("what was asked lacks the parameter \"" + name + "\"");
    return found->second;
}

WebServer::WebServer(Options options) : work_(std::make_unique<Work>(options)) {}
WebServer::~WebServer() = default;

void WebServer::on_get(const std::string& path, Handler handler) {
    work_->server_.Get(pattern_of(path), work_->handler(std::move(handler)));
}

void WebServer::on_post(const std::string& path, Handler handler) {
    work_->server_.Post(pattern_of(path), work_->handler(std::move(handler)));
}

void WebServer::on_stream(std::function<std::string()> first) {
    work_->first_ = std::move(first);
}

void WebServer::start() {
    work_->start();
}

int WebServer::port() const {
    return work_->port_;
}

std::string WebServer::address() const {
    return fmt::format("http://127.0.0.1:{}/?token={}", work_->port_, work_->token_);
}

void WebServer::send(const std::string& event, const std::string& data) {
    const std::lock_guard lock(work_->sending_);
    work_->streams_.send(event, data);
}

int WebServer::streams() const {
    return static_cast<int>(work_->streams_.count());
}

}  // namespace dynlab::inline app
