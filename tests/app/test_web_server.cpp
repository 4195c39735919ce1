// The server of pages, asked as its own page asks and as others would. Oracle: the rules of web_server.h, and those of
// browsers (Fetch, RFC 6265bis) that attacks rely on.
#include "app/server/web_server.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <future>
#include <thread>

#include "platform/error.h"
#include "platform/system_call.h"
#include "support/page_client.h"

namespace test_web_server {
using namespace dynlab;
using dynlab::test::PageClient;
using testing::HasSubstr;
using testing::Not;

class web_server : public testing::Test {
  protected:
    web_server() : server({.port = 0, .largest_body = 1000, .max_streams = 3}) {
        server.on_get("/", [](const PageRequest&) { return PageReply{"the page"}; });
        server.on_get("/picture/*", [](const PageRequest& asked) { return PageReply{asked.path}; });
        server.on_get("/long", [](const PageRequest&) { return PageReply{std::string(300000, 'x')}; });
        server.on_get("/fails", [](const PageRequest&) -> PageReply { throw EnvironmentError("the disk is full"); });
        server.on_post("/order", [this](const PageRequest& asked) {
            ++orders;
            return PageReply{"got " + asked.body};
        });
        server.on_stream([] { return std::string("{\"first\":1}"); });
        server.start();
    }

    httplib::Client client() const { return PageClient::client_of(host()); }
    std::string host() const { return server.key().host(); }
    const PageClient& page() const {
        if (!page_) page_ = std::make_unique<PageClient>(server.address());
        return *page_;
    }
    int status(const std::string& path, const httplib::Headers& headers) const {
        auto asking = client();
        const auto reply = asking.Get(path, headers);
        return reply ? reply->status : -1;
    }
    int status_of_order(httplib::Headers headers) const {
        auto asking = client();
        const auto reply = asking.Post("/order", headers, "x", "text/plain");
        return reply ? reply->status : -1;
    }
    std::string token() const { return server.address().substr(server.address().find('=') + 1); }

    WebServer server;
    std::atomic<int> orders = 0;

  private:
    mutable std::unique_ptr<PageClient> page_;
};

TEST_F(web_server, a_visit_with_a_token_leads_to_the_pages_once) {
    const std::string address = server.address(), visit = address.substr(address.find("/?"));
    auto browser = client();
    const auto first = browser.Get(visit);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->status, 200);
    const std::string set = first->get_header_value("Set-Cookie");
    EXPECT_THAT(set, Not(HasSubstr("Domain="))) << "servers of others on this machine would be sent it";
    EXPECT_THAT(set, HasSubstr("SameSite=Strict"));
    EXPECT_THAT(set, HasSubstr("HttpOnly"));
    EXPECT_THAT(set, Not(HasSubstr(visit.substr(visit.find('=') + 1)))) << "the token is no cookie";
    const httplib::Headers known = {{"Cookie", "other=1; " + set.substr(0, set.find(';'))}};
    const auto page = browser.Get("/", known);
    ASSERT_TRUE(page);
    EXPECT_EQ(page->body, "the page");
    EXPECT_EQ(status(visit, {}), 403) << "a second time";
    EXPECT_EQ(status(visit, known), 200) << "a tab that is loaded again";
}

TEST_F(web_server, a_visit_that_comes_late_gets_a_new_address) {
    std::promise<std::string> reported;
    WebServer other({.port = 0});
    other.on_late_visit([&] { reported.set_value(other.address()); });
    other.start();
    const std::string address = other.address();
    const PageClient first(address);
    EXPECT_ANY_THROW(PageClient{address});
    auto next = reported.get_future();
    ASSERT_EQ(next.wait_for(std::chrono::seconds(10)), std::future_status::ready);
    EXPECT_EQ(PageClient(next.get()).host(), first.host());
}

TEST_F(web_server, tokens_that_were_not_given_or_are_old_lead_nowhere) {
    const std::string given = token();
    std::string changed = given, later = given;
    changed.back() = changed.back() == '0' ? '1' : '0';
    later[11] = later[11] == '0' ? '1' : '0';  // of its time
    for (const std::string& wrong :
         {std::string(), std::string("0"), given + "0", changed, later, std::string(given.size(), '0'),
          EntranceKey{server.port(), "x"}.address().substr(server.address().size() - given.size())})
        EXPECT_EQ(status("/?token=" + wrong, {}), 403) << wrong;
    EXPECT_EQ(status("/?token=" + given, {}), 200);
}

/// 127.0.0.2 leads to this machine, too, as its addresses in a network do.
TEST_F(web_server, listens_at_one_address_of_this_machine_alone) {
    ASSERT_EQ(status("/", page().known()), 200);
    for (const char* address : {"127.0.0.2", "::1"}) {
        httplib::Client elsewhere(address, server.port());
        elsewhere.set_default_headers({{"Host", host()}});
        elsewhere.set_connection_timeout(5, 0);
        EXPECT_FALSE(elsewhere.Get("/", page().known())) << address;
    }
}

TEST_F(web_server, gives_nothing_to_others) {
    for (const char* path : {"/", "/events", "/picture/a"}) {
        EXPECT_EQ(status(path, {}), 403) << path;
    }
    EXPECT_EQ(status("/picture/a?token=" + token(), {}), 403);  // only the address itself exchanges it
    EXPECT_EQ(status("/", {{"Cookie", page().cookie().substr(0, page().cookie().size() - 1)}}), 403);
    EXPECT_EQ(status("/", {{"Cookie", page().cookie() + "0"}}), 403);
    EXPECT_EQ(status("/", {{"Cookie", "x" + page().cookie()}}), 403);
    EXPECT_EQ(status("/", {{"Cookie", "dynlab=; a=b; " + page().cookie()}}), 200);
    EXPECT_EQ(status_of_order({}), 403);
    EXPECT_EQ(orders, 0);
}

/// A name of an attacker's that is made to lead to this machine (DNS rebinding).
TEST_F(web_server, answers_to_its_own_names_only) {
    const std::string port = ":" + std::to_string(server.port());
    for (const std::string& name :
         {std::string("evil.example"), std::string("127.0.0.1"), std::string("127.0.0.1:1"), "evil.example" + port,
          "127.0.0.1" + port, "localhost" + port, "[::1]" + port, "dynlab.localhost" + port, "x" + host(),
          host().substr(0, host().find(':')), std::string()}) {
        EXPECT_EQ(status("/", {{"Host", name}, {"Cookie", page().cookie()}}), 403) << name;
        EXPECT_EQ(status("/?token=" + token(), {{"Host", name}}), 403) << name;
    }
    EXPECT_EQ(status("/", {{"Host", host()}, {"Cookie", page().cookie()}}), 200);
    EXPECT_NE(host(), WebServer({.port = 0}).key().host());
}

/// What a page of another site can make a browser send with the cookie, were it not SameSite.
TEST_F(web_server, other_sites_may_not_ask) {
    const auto changed = [&](const std::string& name, const std::string& value) {
        httplib::Headers headers = page().of_page();
        headers.erase(name);
        if (value != "-") headers.emplace(name, value);
        return headers;
    };
    for (const std::string& origin :
         {std::string("http://evil.example"), std::string("null"), std::string("http://127.0.0.1"), std::string(" "),
          std::string("-"), "https://" + host(), "http://" + host() + ".evil.example",
          std::string("http://localhost:1")})
        EXPECT_EQ(status_of_order(changed("Origin", origin)), 403) << origin;
    for (const char* site : {"cross-site", "same-site", "none", "-"})
        EXPECT_EQ(status_of_order(changed("Sec-Fetch-Site", site)), 403) << site;
    for (const char* field : {"0", "-"}) EXPECT_EQ(status_of_order(changed("X-Dynlab", field)), 403) << field;
    EXPECT_EQ(orders, 0);
    for (const char* site : {"cross-site", "same-site"})
        EXPECT_EQ(status("/", {{"Cookie", page().cookie()}, {"Sec-Fetch-Site", site}}), 403) << site;
    const auto reply = page().post("/order", "x");
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->body, "got x");
    EXPECT_FALSE(reply->has_header("Access-Control-Allow-Origin"));
    EXPECT_EQ(orders, 1);
}

TEST_F(web_server, makes_browsers_take_nothing_from_elsewhere) {
    const auto reply = page().get("/");
    ASSERT_TRUE(reply);
    EXPECT_THAT(reply->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'self'"));
    EXPECT_THAT(reply->get_header_value("Content-Security-Policy"), Not(HasSubstr("script-src")));
    EXPECT_EQ(reply->get_header_value("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(reply->get_header_value("Referrer-Policy"), "no-referrer");
}

TEST_F(web_server, keeps_to_its_paths) {
    EXPECT_EQ(status("/picture/abc.svg", page().known()), 200);
    EXPECT_EQ(status("/picture/../../etc/passwd", page().known()), 404);
    EXPECT_EQ(status("/picture/a/b", page().known()), 404);
    EXPECT_EQ(status("/nothing", page().known()), 404);
}

TEST_F(web_server, refuses_bodies_that_are_too_large) {
    const auto reply = page().post("/order", std::string(2000, 'x'));
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->status, 413);
    EXPECT_EQ(orders, 0);
}

TEST_F(web_server, says_why_something_failed) {
    const auto reply = page().get("/fails");
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->status, 500);
    EXPECT_EQ(reply->body, "the disk is full");
}

/// A browser opens connections before it asks, and one that gets no processor meanwhile asks late. It does not ask
/// again where a connection that had never served is closed: the page would lack a file.
TEST_F(web_server, answers_the_first_request_of_a_connection_however_late) {
    const FileDescriptor connection(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(server.port()));
    ASSERT_EQ(::connect(connection.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    const std::string request =
        "GET /picture/a HTTP/1.1\r\nHost: " + host() + "\r\nCookie: " + page().cookie() + "\r\n\r\n";
    for (int i = 0; i < 7; ++i) {  // what a browser asks of one connection
        if (i == 0) std::this_thread::sleep_for(std::chrono::seconds(2));
        ASSERT_TRUE(write_all(connection.get(), request.data(), request.size()));
        std::string reply;
        char bytes[1000];
        while (!reply.ends_with("\r\n\r\n/picture/a")) {
            const ssize_t count = ::recv(connection.get(), bytes, sizeof bytes, 0);
            ASSERT_GT(count, 0) << "closed at request " << i << " after: " << reply;
            reply.append(bytes, static_cast<std::size_t>(count));
        }
        EXPECT_THAT(reply, testing::StartsWith("HTTP/1.1 200"));
    }
}

/// Within the machine nothing is worth the time that compressing takes, whatever a browser offers.
TEST_F(web_server, sends_things_as_they_are) {
    auto browser = client();
    browser.set_decompress(false);
    auto headers = page().known();
    headers.emplace("Accept-Encoding", "gzip, deflate, br");
    for (const std::string path : {"/", "/long"}) {
        const auto reply = browser.Get(path, headers);
        ASSERT_TRUE(reply);
        EXPECT_EQ(reply->get_header_value("Content-Encoding"), "");
        EXPECT_EQ(reply->body, path == "/" ? "the page" : std::string(300000, 'x'));
    }
}

TEST_F(web_server, a_port_that_is_taken_is_reported) {
    try {
        const WebServer second({.port = server.port()});
        ADD_FAILURE() << "two servers share a port";
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("port " + std::to_string(server.port()) + " is in use"));
    }
}

/// Browsers ask at ::1, too, for a name of this machine: another user's server there would get the address's token.
TEST_F(web_server, no_other_program_gets_its_port_at_the_other_address_of_this_machine) {
    const FileDescriptor other(::socket(AF_INET6, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in6 address{};
    address.sin6_family = AF_INET6;
    address.sin6_addr = in6addr_loopback;
    if (!other || ::bind(other.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
        GTEST_SKIP() << "this machine has no IPv6";
    const FileDescriptor second(::socket(AF_INET6, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const int yes = 1;
    ::setsockopt(second.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    for (const in6_addr& place : {in6addr_loopback, in6addr_any}) {
        address.sin6_addr = place;
        address.sin6_port = htons(static_cast<std::uint16_t>(server.port()));
        EXPECT_NE(::bind(second.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    }
}

/// Reads a stream in a separate thread until it has seen `expected`.
class Listener {
  public:
    Listener(const PageClient& page, std::string expected)
        : thread_([this, page, expected = std::move(expected)] {
              const auto reply = page.get("/events", [&](const char* data, std::size_t length) {
                  text_.append(data, length);
                  open = true;
                  return text_.find(expected) == std::string::npos;
              });
              if (reply) status = reply->status;
              over = true;
          }) {}
    ~Listener() { thread_.join(); }
    const std::string& text() {
        while (!over) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        return text_;
    }
    std::atomic<bool> open = false, over = false;
    std::atomic<int> status = 0;

  private:
    std::string text_;
    std::thread thread_;
};

void wait_until_open(const Listener& listener) {
    for (int i = 0; i < 2000 && !listener.open && !listener.over; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

TEST_F(web_server, streams_give_everything_first_and_then_what_is_new) {
    Listener one(page(), "\"next\""), two(page(), "\"next\"");
    wait_until_open(one);
    wait_until_open(two);
    EXPECT_EQ(server.streams(), 2);
    server.send("page", "{\"next\":2}");
    for (Listener* listener : {&one, &two})
        EXPECT_EQ(listener->text(), "event: page\ndata: {\"first\":1}\n\nevent: page\ndata: {\"next\":2}\n\n");
}

TEST_F(web_server, has_a_limit_of_streams_and_forgets_those_that_are_gone) {
    {
        std::vector<std::unique_ptr<Listener>> listeners;
        for (int i = 0; i < 3; ++i) {
            listeners.push_back(std::make_unique<Listener>(page(), "\"end\""));
            wait_until_open(*listeners.back());
        }
        EXPECT_EQ(status("/events", page().known()), 503);
        EXPECT_EQ(status("/", page().known()), 200);  // pages are still served
        server.send("page", "{\"end\":1}");
    }
    for (int i = 0; i < 500 && server.streams() > 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(server.streams(), 0) << "without any news, which would find out";
}

/// News that come while the first event of a stream is being made are newer than it.
TEST(web_server_streams, begin_before_the_news_that_follow) {
    WebServer server({.port = 0});
    std::thread sender;
    server.on_stream([&] {
        sender = std::thread([&] { server.send("page", "new"); });
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        return std::string("old");
    });
    server.start();
    std::string reported;
    PageClient(server.address()).get("/events", [&](const char* bytes, std::size_t count) {
        reported.append(bytes, count);
        return reported.find("new") == std::string::npos || reported.find("old") == std::string::npos;
    });
    sender.join();
    EXPECT_LT(reported.find("old"), reported.find("new")) << reported;
}

}  // namespace test_web_server
