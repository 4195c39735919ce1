// The browser of the tests: a window knows nothing of those before it and beside it. Oracle: what the pages of a server
// stored, and how often the server was asked.
#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <string>
#include <thread>

#include "support/browser.h"

namespace test_browser_windows {
using dynlab::test::Browser;

class browser_windows : public testing::Test {
  protected:
    browser_windows() {
        server_.Get("/", [this](const httplib::Request&, httplib::Response& response) {
            ++pages_;
            response.set_header("Cache-Control", "max-age=1000");
            response.set_content("<title>A page</title>", "text/html");
        });
        server_.set_keep_alive_max_count(1);  // the server's end does not wait for connections of a browser
        const int port = server_.bind_to_any_port("127.0.0.1");
        address_ = "http://127.0.0.1:" + std::to_string(port) + "/";
        thread_ = std::thread([this] { server_.listen_after_bind(); });
    }
    ~browser_windows() override {
        server_.stop();
        thread_.join();
    }
    static std::string stored(Browser& browser) {
        return browser.evaluate("return document.cookie + '|' + (localStorage.getItem('kept') ?? '')");
    }
    void store(Browser& browser) const {
        browser.open(address_);
        browser.evaluate("document.cookie = 'kept=1'; localStorage.setItem('kept', 2)");
        EXPECT_EQ(stored(browser), "\"kept=1|2\"");
    }
    std::string address_;
    std::atomic<int> pages_ = 0;

  private:
    httplib::Server server_;
    std::thread thread_;
};

TEST_F(browser_windows, begin_without_anything_that_an_earlier_test_left) {
    {
        Browser earlier(800, 600);
        store(earlier);
        earlier.prefer_dark();
        earlier.new_tab();
        store(earlier);
        EXPECT_EQ(pages_, 1) << "the second comes from the cache";
    }
    Browser browser(700, 500);
    browser.open(address_);
    EXPECT_EQ(stored(browser), "\"|\"");
    EXPECT_EQ(pages_, 2);
    EXPECT_EQ(browser.evaluate("return [innerWidth, innerHeight, history.length]"), "[700,500,2]");
    EXPECT_EQ(browser.evaluate("return matchMedia('(prefers-color-scheme: dark)').matches"), "false");
}

TEST_F(browser_windows, at_the_same_time_share_nothing) {
    Browser one;
    Browser other;
    store(one);
    other.open(address_);
    EXPECT_EQ(stored(other), "\"|\"");
    EXPECT_EQ(stored(one), "\"kept=1|2\"");
}

}  // namespace test_browser_windows
