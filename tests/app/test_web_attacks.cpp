// Attacks on a page server: handwritten requests, pages of other sites in the user's browser, floods of connections.
// Oracle: no order runs, each connection gets at most one reply and is closed, and the user's page is still served.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <httplib.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>

#include "app/server/web_server.h"
#include "platform/child_process.h"
#include "platform/system_call.h"
#include "platform/temporary_folder.h"
#include "support/browser.h"
#include "support/page_client.h"

namespace test_web_attacks {
using namespace dynlab;
using namespace dynlab::test;
using namespace std::chrono_literals;

class web_attacks : public testing::Test {
  protected:
    web_attacks() : server({.port = 0, .largest_body = 1000}) {
        server.on_get("/", [](const PageRequest&) {
            return PageReply{
                "<!DOCTYPE html><title>ours</title><link rel=stylesheet href=page.css><p>ours<script "
                "src=page.js></script>"};
        });
        server.on_get("/page.js", [this](const PageRequest&) { return PageReply{script, "text/javascript"}; });
        server.on_get("/page.css", [](const PageRequest&) { return PageReply{"p {}", "text/css"}; });
        server.on_post("/order", [this](const PageRequest&) { return ++orders, PageReply{"done"}; });
        server.start();
        page = std::make_unique<PageClient>(server.address());
    }

    FileDescriptor connection() const {
        FileDescriptor made(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(static_cast<std::uint16_t>(server.port()));
        const timeval timeout{20, 0};
        ::setsockopt(made.get(), SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
        if (::connect(made.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
            return FileDescriptor();
        return made;
    }
    /// All that comes until the connection is closed; "open" behind it where it is not.
    static std::string rest_of(const FileDescriptor& connection) {
        std::string all;
        char bytes[4096];
        for (;;) {
            const ssize_t count = ::recv(connection.get(), bytes, sizeof bytes, 0);
            if (count == 0 || (count < 0 && errno == ECONNRESET)) return all;
            if (count < 0) return all + "open";
            all.append(bytes, static_cast<std::size_t>(count));
        }
    }
    std::string exchange(const std::string& bytes) const {
        const FileDescriptor made = connection();
        ::send(made.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        ::shutdown(made.get(), SHUT_WR);
        return rest_of(made);
    }
    /// What the page itself would send.
    std::string order() const { return request("POST /order", "{P}Content-Length: 1\r\n", "x"); }
    std::string request(std::string line, std::string fields, const std::string& body = {}) const {
        return filled(line + " HTTP/1.1\r\nHost: {H}\r\n" + fields + "\r\n") + body;
    }
    std::string with_length(const std::string& line, const std::string& fields) const {
        return request(line, fields + "Content-Length: " + std::to_string(order().size()) + "\r\n", order());
    }
    std::string filled(std::string text) const {
        const std::pair<const char*, std::string> values[] = {
            {"{P}", "{C}Origin: http://{H}\r\nSec-Fetch-Site: same-origin\r\nX-Dynlab: 1\r\n"},
            {"{C}", "Cookie: " + page->cookie() + "\r\n"},
            {"{H}", page->host()}};
        for (const auto& [name, value] : values)
            for (std::size_t at = 0; (at = text.find(name)) != std::string::npos;) text.replace(at, 3, value);
        return text;
    }
    void expect_held(const std::string& name, const std::string& bytes) const {
        const std::string replies = exchange(bytes);
        std::size_t count = 0;
        for (std::size_t at = 0; (at = replies.find("HTTP/1.1 ", at)) != std::string::npos; ++at) ++count;
        EXPECT_LE(count, 1u) << name << ":\n" << replies;
        EXPECT_FALSE(replies.ends_with("open")) << name << ":\n" << replies;
        EXPECT_FALSE(replies.starts_with("HTTP/1.1 2")) << name << ":\n" << replies;
        EXPECT_EQ(orders, 0) << name;
    }

    /// What pages of other sites try, as scripts.
    std::vector<std::string> attacks_of_pages() const;

    WebServer server;
    std::unique_ptr<PageClient> page;
    std::string script;  ///< of our page
    std::atomic<int> orders = 0;
};

TEST_F(web_attacks, an_order_of_the_page_is_obeyed) {
    EXPECT_TRUE(exchange(order()).starts_with("HTTP/1.1 200 OK\r\n"));
    EXPECT_EQ(orders, 1);
}

/// Whatever is refused, its body is not read as the next request (CWE-444).
TEST_F(web_attacks, bodies_of_refused_requests_are_no_requests) {
    const std::string others = "Origin: http://evil.example\r\nContent-Type: text/plain\r\n";
    expect_held("a form of another site", with_length("POST /", others));
    expect_held("a form of another site with the cookie", with_length("POST /order", "{C}" + others));
    expect_held("no cookie", with_length("POST /order", ""));
    expect_held("no field of the page",
                with_length("POST /order", "{C}Origin: http://{H}\r\nSec-Fetch-Site: same-origin\r\n"));
    expect_held("no origin", with_length("POST /order", "{C}X-Dynlab: 1\r\nSec-Fetch-Site: same-origin\r\n"));
    expect_held("another site's origin of ours",
                with_length("POST /order", "{C}Origin: http://{H}\r\nSec-Fetch-Site: cross-site\r\nX-Dynlab: 1\r\n"));
    expect_held("an unknown path", with_length("POST /nothing", "{P}"));
    expect_held("the complete address", with_length("POST /", "{P}"));
    expect_held("a token that is wrong", with_length("GET /?token=0", ""));
    expect_held("a body that is too long", request("POST /order", "{P}Content-Length: 2000\r\n", order()));
    for (const char* method : {"PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "PROPFIND", "post", "FOO"})
        expect_held(method, with_length(std::string(method) + " /order", "{P}"));
    for (const char* method : {"GET", "HEAD"}) {
        expect_held(method, with_length(std::string(method) + " /", "{C}"));
        expect_held(std::string(method) + " in chunks",
                    request(std::string(method) + " /", "{C}Transfer-Encoding: chunked\r\n", "0\r\n\r\n" + order()));
    }
    expect_held("an answer that is waited for", with_length("POST /order", "{P}Expect: 100-continue\r\n"));
}

/// Lengths on which two readers might not agree.
TEST_F(web_attacks, bodies_of_doubtful_length_are_refused) {
    const std::string chunks = "1\r\nx\r\n0\r\n\r\n";
    for (const char* coding :
         {"chunked", "xchunked", "chunked, identity", "identity", "gzip, chunked", "\tchunked", "CHUNKED"})
        expect_held(coding, request("POST /order", fmt::format("{{P}}Transfer-Encoding: {}\r\n", coding), chunks));
    expect_held("chunks and a length",
                request("POST /order", "{P}Content-Length: 1\r\nTransfer-Encoding: chunked\r\n", chunks));
    expect_held("a blank before the colon", request("POST /order", "{P}Transfer-Encoding : chunked\r\n", chunks));
    expect_held("no length", request("POST /order", "{P}", "x"));
    for (const char* length :
         {"+1", "-1", "0x1", "1, 2", "1 1", "", "1.0", "one", "99999999999999999999", "18446744073709551617"})
        expect_held(length, request("POST /order", fmt::format("{{P}}Content-Length: {}\r\n", length), "x"));
    expect_held("two lengths", request("POST /order", "{P}Content-Length: 1\r\nContent-Length: 2\r\n", "x" + order()));
}

TEST_F(web_attacks, what_is_no_http_is_refused) {
    const std::string order_fields = filled("Host: {H}\r\n{P}Content-Length: 1\r\n\r\nx"), line = filled("POST /order");
    expect_held("lines without a carriage return", filled("POST /order HTTP/1.1\nHost: {H}\nContent-Length: 1\n\nx"));
    expect_held("carriage returns alone", filled("POST /order HTTP/1.1\rHost: {H}\r\rx"));
    for (const char* version :
         {" HTTP/1.2", " HTTP/2.0", " HTTP/0.9", " http/1.1", " HTTP/1.1.1", " HTTP/11", "", " HTTP/1.1 x"})
        expect_held(version, line + version + "\r\n" + order_fields);
    for (const std::string& before :
         {std::string(" "), std::string("\t"), std::string(1, '\0'), std::string("\r\n \r\n")})
        expect_held("a beginning", before + line + " HTTP/1.1\r\n" + order_fields);
    expect_held("HTTP/2", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + order());
    expect_held("TLS", std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11));
    for (const std::string& field : {std::string("A b: c"), std::string("Ab"), std::string(": c"),
                                     std::string("A: b\0c", 6), std::string("A: b\rc"), std::string("A\x80: c")})
        expect_held(field, request("POST /order", "{P}Content-Length: 1\r\n" + field + "\r\n", "x"));
}

TEST_F(web_attacks, other_addresses_and_hosts_are_refused) {
    for (const char* target : {"*", "http://evil.example/", "http://{H}/order", "/order%00", "/%zz", "/%6", "/../order",
                               "//order", "//order", "//evil.example/order", "/order?x=%00"})
        expect_held(target, request(std::string("POST ") + target, "{P}Content-Length: 1\r\n", "x"));
    const std::string fields = filled("{P}Content-Length: 1\r\n\r\nx"), line = filled("POST /order HTTP/1.1\r\n");
    for (const char* host : {"evil@{H}", "{H}.", "LOCALHOST", "{H}, {H}", "{H}\r\nHost: {H}",
                             "{H}\r\nHost: evil.example", "127.1", "0.0.0.0", "2130706433", "", "[::]"})
        expect_held(host, line + filled(fmt::format("Host: {}\r\n", host)) + fields);
    expect_held("no host", line + fields);
    for (const char* origin :
         {"", "null", "http://{H}.", "http://{H}/", "HTTP://{H}", "http://{H}\r\nOrigin: http://{H}", "https://{H}"})
        expect_held(origin, request("POST /order",
                                    fmt::format("{{C}}Origin: {}\r\nSec-Fetch-Site: same-origin\r\nX-Dynlab: 1\r\n"
                                                "Content-Length: 1\r\n",
                                                origin),
                                    "x"));
    expect_held("another method by a field", request("GET /order", "{P}X-HTTP-Method-Override: POST\r\n"));
    expect_held("the cookie as a password", request("GET /", "Authorization: Basic {C}"));
}

/// No browser asks before it has the reply to what it asked last.
TEST_F(web_attacks, a_request_behind_a_request_is_not_answered) {
    const std::string replies = exchange(request("GET /", "{C}") + order());
    EXPECT_TRUE(replies.starts_with("HTTP/1.1 200"));
    EXPECT_EQ(replies.find("HTTP/1.1", 1), std::string::npos) << replies;
    EXPECT_EQ(orders, 0);
}

TEST_F(web_attacks, heads_have_a_size_a_number_of_fields_and_a_time) {
    std::string fields;
    for (int i = 0; i < 120; ++i) fields += fmt::format("A{}: b\r\n", i);
    expect_held("many fields", request("GET /", "{C}" + fields));
    expect_held("a long field", request("GET /", "{C}A: " + std::string(70'000, 'b') + "\r\n"));
    expect_held("a long address", request("GET /" + std::string(70'000, 'b'), "{C}"));
    const FileDescriptor endless = connection();
    const std::string line = "A: " + std::string(10'000, 'b') + "\r\n";
    std::string begun = "GET / HTTP/1.1\r\n";
    std::size_t sent = 0;
    while (sent < 100'000'000) {
        const ssize_t count = ::send(endless.get(), begun.data(), begun.size(), MSG_NOSIGNAL);
        if (count <= 0) break;
        sent += static_cast<std::size_t>(count);
        begun = line;
    }
    EXPECT_LT(sent, 40'000'000u) << "what nobody reads fills the memory";

    const FileDescriptor slow = connection();
    const auto begin = std::chrono::steady_clock::now();
    for (const char c : std::string("GET / HTTP")) {
        ::send(slow.get(), &c, 1, MSG_NOSIGNAL);
        std::this_thread::sleep_for(100ms);
    }
    EXPECT_FALSE(rest_of(slow).ends_with("open"));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 18s) << "a head has ten seconds";
}

/// Every user of the machine can connect. Connections without a cookie do not block other clients.
TEST_F(web_attacks, many_connections_do_not_close_the_page) {
    std::vector<FileDescriptor> halves;
    for (int i = 0; i < 200; ++i) {
        halves.push_back(connection());
        ::send(halves.back().get(), "GET / HTTP/1.1\r\n", 16, MSG_NOSIGNAL);
    }
    for (int i = 0; i < 5; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        const auto reply = page->get("/");
        ASSERT_TRUE(reply);
        EXPECT_EQ(reply->status, 200);
        EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
    }
}

/// A site of an attacker, on this machine (whose cookies are "same-site") and by another name.
class OtherSite {
  public:
    explicit OtherSite(std::string attack) : port_(site_.bind_to_any_port("127.0.0.1")) {
        site_.Get("/", [attack = std::move(attack)](const httplib::Request&, httplib::Response& reply) {
            reply.set_content(
                "<!DOCTYPE html><title>evil</title><iframe name=hole></iframe><script>" + attack + "</script>",
                "text/html");
        });
        site_.set_keep_alive_max_count(1);  // idle connections hold up its end
        thread_ = std::thread([this] { site_.listen_after_bind(); });
        while (!site_.is_running()) std::this_thread::sleep_for(1ms);
    }
    ~OtherSite() {
        site_.stop();
        thread_.join();
    }
    std::string address(const char* name) const { return fmt::format("http://{}:{}/", name, port_); }

  private:
    httplib::Server site_;
    int port_;
    std::thread thread_;
};

std::vector<std::string> web_attacks::attacks_of_pages() const {
    const std::string own = "http://" + page->host(), orders_at = own + "/order";
    // The body is the request that is to be smuggled: the next one of the user's own page would end it.
    const std::string smuggled = fmt::format(
        "POST /order HTTP/1.1\\r\\nHost: {}\\r\\nOrigin: {}\\r\\nSec-Fetch-Site: "
        "same-origin\\r\\nX-Dynlab: 1\\r\\nContent-Length: 0\\r\\nX: ",
        page->host(), own);
    const auto form = [&](const std::string& action, const char* type, const char* target) {
        return fmt::format(
            "const f = document.createElement('form'), t = document.createElement('textarea'); f.method = 'post'; "
            "f.action = '{}'; f.enctype = '{}'; f.target = '{}'; t.name = '{}'; f.append(t); "
            "document.body.append(f); f.submit()",
            action, type, target, smuggled);
    };
    const auto fetched = [&](const std::string& to, const std::string& how) {
        return fmt::format("fetch('{}', {{credentials: 'include', {}}}).catch(() => 0)", to, how);
    };
    const std::string body = "body: '" + smuggled + "'";
    std::vector<std::string> attacks;
    for (const char* type : {"text/plain", "application/x-www-form-urlencoded", "multipart/form-data"})
        for (const std::string& to : {own + "/", orders_at})
            for (const char* target : {"_self", "hole"}) attacks.push_back(form(to, type, target));
    for (const std::string& to : {own + "/", orders_at}) {
        attacks.push_back(fetched(to, "method: 'POST', mode: 'no-cors', " + body));
        attacks.push_back(fetched(to, "method: 'POST', headers: {'X-Dynlab': '1'}, " + body));
        attacks.push_back(fetched(to, "method: 'PUT', " + body));
        attacks.push_back("navigator.sendBeacon('" + to + "', '" + smuggled + "')");
    }
    attacks.push_back("new WebSocket('ws://" + page->host() + "/order')");
    attacks.push_back("new EventSource('" + own + "/events', {withCredentials: true})");
    attacks.push_back("document.body.innerHTML = '<img src=" + orders_at + "><script src=" + orders_at + ">'");
    attacks.push_back("window.open('" + own + "/').postMessage('x', '*')");
    return attacks;
}

TEST_F(web_attacks, pages_of_other_sites_achieve_nothing_in_a_browser) {
    Browser browser;
    const std::string address = server.address();
    browser.open(address);
    ASSERT_TRUE(browser.becomes_true("document.title === 'ours'"));
    for (const std::string& attack : attacks_of_pages()) {
        const OtherSite site("window.onload = () => { try { " + attack +
                             " } finally { setTimeout(() => window.tried = 1, 50) } }");
        for (const char* name : {"127.0.0.1", "localhost"}) {
            browser.open(site.address(name));
            browser.becomes_true("window.tried || document.title !== 'evil'", 2);
            browser.open(address);
            ASSERT_TRUE(browser.becomes_true("document.title === 'ours'")) << attack;
            browser.evaluate(
                "window.asked = 0; for (let i = 0; i < 3; ++i) fetch('page.css').then(() => ++window.asked)");
            ASSERT_TRUE(browser.becomes_true("window.asked === 3")) << attack;
            ASSERT_EQ(orders, 0) << attack;
        }
    }
    browser.evaluate("fetch('order', {method: 'POST', headers: {'X-Dynlab': '1'}})");
    for (int i = 0; i < 1000 && orders == 0; ++i) std::this_thread::sleep_for(10ms);
    EXPECT_EQ(orders, 1) << "the page itself may";
}

/// The user's Firefox, led on by the pages that it opens: ours gives an order and goes to the other site, which tries
/// each attack in a frame, by both of its names, and last in the whole window.
TEST_F(web_attacks, pages_of_other_sites_achieve_nothing_in_firefox) {
    const std::vector<std::string> attacks = attacks_of_pages();
    std::atomic<std::size_t> tried = 0;
    std::atomic<bool> ended = false;
    httplib::Server site;
    const int port = site.bind_to_any_port("127.0.0.1");
    site.Get("/", [&](const httplib::Request& request, httplib::Response& reply) {
        const std::size_t number = std::stoul("0" + request.get_param_value("attack"));
        const bool last = number >= attacks.size();
        const std::string next = fmt::format("/?attack={}", number + 1);
        const std::string other = fmt::format("http://localhost:{}/", port);
        const std::string way = !last ? fmt::format("setTimeout(() => location = '{}', 100)", next)
                                : request.get_header_value("Host").starts_with("localhost")
                                    ? fmt::format("fetch('/end').then(() => {{ {} }})", attacks.front())
                                    : fmt::format("location = '{}'", other);
        const std::string frame = last ? "" : fmt::format("<iframe src=/frame?attack={}></iframe>", number);
        reply.set_content(fmt::format("<!DOCTYPE html><title>evil</title>{}<script>window.onload = () => {{ {} }}"
                                      "</script>",
                                      frame, way),
                          "text/html");
    });
    site.Get("/frame", [&](const httplib::Request& request, httplib::Response& reply) {
        ++tried;
        reply.set_content("<!DOCTYPE html><iframe name=hole></iframe><script>window.onload = () => { " +
                              attacks.at(std::stoul(request.get_param_value("attack"))) + " }</script>",
                          "text/html");
    });
    site.Get("/end", [&](const httplib::Request&, httplib::Response&) { ended = true; });
    site.set_keep_alive_max_count(1);
    std::thread thread([&] { site.listen_after_bind(); });
    script = fmt::format(
        "fetch('order', {{method: 'POST', headers: {{'X-Dynlab': '1'}}}}).then(() => "
        "location = 'http://127.0.0.1:{}/')",
        port);
    const TemporaryFolder profile;
    ChildOptions options;
    options.command = {"firefox-esr",           "--headless",    "--no-remote", "--profile",
                       profile.path().string(), server.address()};
    options.environment = {{"HOME", profile.path().string()}};
    {
        const ChildProcess firefox(options, "firefox-esr");
        for (int i = 0; i < 6000 && !ended; ++i) std::this_thread::sleep_for(20ms);
        std::this_thread::sleep_for(500ms);  // for the attack in the whole window
    }
    site.stop();
    thread.join();
    EXPECT_TRUE(ended);
    EXPECT_EQ(tried, 2 * attacks.size());
    EXPECT_EQ(orders, 1) << "the page itself may, the others may not";
}

/// What another user's server leaves in the browser at a port that is ours later.
TEST_F(web_attacks, a_service_worker_that_was_left_at_the_port_rules_no_page) {
    Browser browser;
    httplib::Server site;
    site.set_socket_options([](socket_t socket) {  // its own would keep the port for a minute
        const int yes = 1;
        ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    const int port = site.bind_to_any_port("127.0.0.1");
    site.Get("/", [](const httplib::Request&, httplib::Response& reply) {
        reply.set_content(
            "<!DOCTYPE html><title>evil</title><script>navigator.serviceWorker.register('/worker.js')"
            ".then(() => navigator.serviceWorker.ready).then(() => document.title = 'left')</script>",
            "text/html");
    });
    site.Get("/worker.js", [](const httplib::Request&, httplib::Response& reply) {
        reply.set_content(
            "addEventListener('fetch', (e) => e.respondWith(new Response('<title>evil</title>', {headers: "
            "{'Content-Type': 'text/html'}})))",
            "text/javascript");
    });
    site.set_keep_alive_max_count(1);
    std::thread thread([&] { site.listen_after_bind(); });
    const std::string there = fmt::format("127.0.0.1:{}", port);
    browser.open("http://" + there + "/");
    EXPECT_TRUE(browser.becomes_true("document.title === 'left'"));
    site.stop();
    thread.join();
    browser.open("http://" + there + "/anything");
    EXPECT_TRUE(browser.becomes_true("document.title === 'evil'")) << "the worker works";

    WebServer ours({.port = port});
    ours.on_get("/", [](const PageRequest&) { return PageReply{"<!DOCTYPE html><title>ours</title>"}; });
    ours.start();
    browser.open(ours.address());
    EXPECT_TRUE(browser.becomes_true("document.title === 'ours' && navigator.serviceWorker.controller === null"));
}

}  // namespace test_web_attacks
