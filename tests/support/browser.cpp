#include "support/browser.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sodium.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "platform/atomic_file.h"
#include "platform/child_process.h"
#include "platform/error.h"
#include "platform/system_call.h"

namespace dynlab::test {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

int free_port() {
    const FileDescriptor probe(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(probe.get(), reinterpret_cast<sockaddr*>(&address), size) != 0 ||
        ::getsockname(probe.get(), reinterpret_cast<sockaddr*>(&address), &size) != 0)
        throw EnvironmentError("there is no free port");
    return ntohs(address.sin_port);
}

/// Chromium without all that a desktop needs: starts in a quarter of the time.
constexpr const char* kShell = "/usr/lib/chromium/chromium-headless-shell";

ChildOptions driver(int port) {
    ChildOptions options;
    options.command = {"chromedriver", "--port=" + std::to_string(port)};
    return options;
}

/// A running Chromium and its chromedriver.
class Chromium {
  public:
    explicit Chromium(Browser::Kind kind) : port_(free_port()), driver_(driver(port_), "chromium-driver") {
        client_.set_read_timeout(60, 0);
        json arguments = {"--headless=new", "--disable-gpu", "--hide-scrollbars"};
        if (::geteuid() == 0) arguments.push_back("--no-sandbox");
        json options = {{"args", arguments}};
        if (kind == Browser::Kind::kWithoutDesktop && std::filesystem::exists(kShell)) options["binary"] = kShell;
        const json expected = {{"capabilities", {{"alwaysMatch", {{"goog:chromeOptions", options}}}}}};
        for (int i = 0; i < 1000 && !client_.Get("/status"); ++i) std::this_thread::sleep_for(10ms);
        session_ =
            "/session/" + value(client_.Post("/session", expected.dump(), kJson))["sessionId"].get<std::string>();
        first_window_ = get("/window");
    }
    ~Chromium() { client_.Delete(session_); }

    json command(const std::string& path, const json& body) {
        return value(client_.Post(session_ + path, body.dump(), kJson));
    }
    json get(const std::string& path) { return value(client_.Get(session_ + path)); }
    void new_window(const char* type) {
        const json window = command("/window/new", {{"type", type}});
        command("/window", {{"handle", window["handle"]}});
    }
    /// Closes the windows of a test and deletes cookies, stored data and cached responses of all pages.
    void forget() {
        for (const json& window : get("/window/handles")) {
            if (window == first_window_) continue;
            command("/window", {{"handle", window}});
            value(client_.Delete(session_ + "/window"));
        }
        command("/window", {{"handle", first_window_}});
        devtools("Storage.clearDataForOrigin", {{"origin", "*"}, {"storageTypes", "all"}});
        devtools("Network.clearBrowserCookies", json::object());
        devtools("Network.clearBrowserCache", json::object());
    }
    json devtools(const std::string& name, const json& parameters) {
        return command("/goog/cdp/execute", {{"cmd", name}, {"params", parameters}});
    }

  private:
    static constexpr const char* kJson = "application/json";
    static json value(const httplib::Result& reply) {
        if (!reply) throw EnvironmentError("chromedriver does not answer");
        json value = json::parse(reply->body)["value"];
        if (value.is_object() && value.contains("error")) throw EnvironmentError(value["message"].get<std::string>());
        return value;
    }

    int port_;
    ChildProcess driver_;
    httplib::Client client_{"127.0.0.1", port_};
    std::string session_;
    json first_window_;  ///< stays open and empty: Chromium ends with its last window
};

/// Those that no test uses now. A start takes a second, so the tests of a program use one Chromium in turn.
std::vector<std::unique_ptr<Chromium>>& idle(Browser::Kind kind) {
    static std::array<std::vector<std::unique_ptr<Chromium>>, 2> of_kind;
    return of_kind[kind == Browser::Kind::kWhole];
}

class EndOfTests : public testing::Environment {
  public:
    void TearDown() override { Browser::end_idle(); }
};
[[maybe_unused]] const testing::Environment* const end_of_tests = testing::AddGlobalTestEnvironment(new EndOfTests);

}  // namespace

class Browser::Work {
  public:
    Work(int width, int height, Kind kind) : kind_(kind) {
        if (idle(kind).empty()) {
            chromium_ = std::make_unique<Chromium>(kind);
        } else {
            chromium_ = std::move(idle(kind).back());
            idle(kind).pop_back();
        }
        chromium_->new_window("window");
        chromium_->command("/window/rect", {{"width", width}, {"height", height}});
    }
    ~Work() {
        try {
            chromium_->forget();
            idle(kind_).push_back(std::move(chromium_));
        } catch (const EnvironmentError&) {  // a Chromium that does not answer is not used again
        }
    }
    Chromium& chromium() { return *chromium_; }
    std::map<std::string, std::string> opened;  ///< addresses with a token, and where they led to

  private:
    Kind kind_;
    std::unique_ptr<Chromium> chromium_;
};

void Browser::end_idle() {
    idle(Kind::kWithoutDesktop).clear();
    idle(Kind::kWhole).clear();
}

Browser::Browser(int width, int height, Kind kind) : work_(std::make_unique<Work>(width, height, kind)) {}
Browser::~Browser() = default;

void Browser::open(const std::string& address) {
    // An address with a token works once; the browser has the page's cookie then.
    const auto opened = work_->opened.find(address);
    work_->chromium().command("/url", {{"url", opened == work_->opened.end() ? address : opened->second}});
    if (opened != work_->opened.end() || address.find("/?token=") == std::string::npos) return;
    if (becomes_true("location.search === '' && document.readyState === 'complete'", 10))
        work_->opened[address] = json::parse(evaluate("return location.href"));
}

std::string Browser::evaluate(const std::string& script) {
    return work_->chromium().command("/execute/sync", {{"script", script}, {"args", json::array()}}).dump();
}

bool Browser::becomes_true(const std::string& expression, double seconds) {
    const auto begin = std::chrono::steady_clock::now();
    std::chrono::duration<double> waited{0};
    do {
        if (evaluate("return Boolean(" + expression + ")") == "true") return true;
        // Each question takes a processor for some milliseconds: what is long in coming is asked for less often.
        std::this_thread::sleep_for(waited < 500ms ? 10ms : 50ms);
        waited = std::chrono::steady_clock::now() - begin;
    } while (waited.count() < seconds);
    return false;
}

void Browser::click(const std::string& selector) {
    evaluate("document.querySelector(" + json(selector).dump() + ").click()");
}

void Browser::new_tab() {
    work_->chromium().new_window("tab");
}

void Browser::prefer_dark() {
    const json dark = {{"name", "prefers-color-scheme"}, {"value", "dark"}};
    work_->chromium().devtools("Emulation.setEmulatedMedia", {{"features", json::array({dark})}});
}

void Browser::act(const std::string& actions) {
    work_->chromium().command("/actions", {{"actions", json::parse(actions)}});
}

std::string Browser::devtools(const std::string& command, const std::string& parameters) {
    return work_->chromium().devtools(command, json::parse(parameters)).dump();
}

void Browser::photograph(const std::string& file) {
    const auto text = work_->chromium().get("/screenshot").get<std::string>();
    std::string bytes(text.size(), '\0');
    std::size_t size = 0;
    sodium_base642bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), text.c_str(), text.size(), nullptr,
                      &size, nullptr, sodium_base64_VARIANT_ORIGINAL);
    write_file_atomically(file, bytes.substr(0, size));
}

}  // namespace dynlab::test
