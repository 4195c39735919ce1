#include "support/browser.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <httplib.h>
#include <sodium.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

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

}  // namespace

class Browser::Work {
  public:
    Work(int width, int height, Kind kind)
        : port_(free_port()), driver_(driver(port_), "chromium-driver"), client_("127.0.0.1", port_) {
        client_.set_read_timeout(60, 0);
        json arguments = {"--headless=new", "--disable-gpu", "--hide-scrollbars",
                          fmt::format("--window-size={},{}", width, height)};
        if (::geteuid() == 0) arguments.push_back("--no-sandbox");
        json options = {{"args", arguments}};
        if (kind == Kind::kWithoutDesktop && std::filesystem::exists(kShell)) options["binary"] = kShell;
        const json wanted = {{"capabilities", {{"alwaysMatch", {{"goog:chromeOptions", options}}}}}};
        for (int i = 0; i < 1000 && !client_.Get("/status"); ++i) std::this_thread::sleep_for(10ms);
        session_ = "/session/" + post("/session", wanted)["sessionId"].get<std::string>();
    }
    ~Work() { client_.Delete(session_); }

    json post(const std::string& path, const json& body) {
        return value(client_.Post(path, body.dump(), "application/json"));
    }
    json command(const std::string& path, const json& body) { return post(session_ + path, body); }
    json get(const std::string& path) { return value(client_.Get(session_ + path)); }

  private:
    static json value(const httplib::Result& reply) {
        if (!reply) throw EnvironmentError("chromedriver does not answer");
        json value = json::parse(reply->body)["value"];
        if (value.is_object() && value.contains("error")) throw EnvironmentError(value["message"].get<std::string>());
        return value;
    }

    int port_;
    ChildProcess driver_;
    httplib::Client client_;
    std::string session_;
};

Browser::Browser(int width, int height, Kind kind) : work_(std::make_unique<Work>(width, height, kind)) {}
Browser::~Browser() = default;

void Browser::open(const std::string& address) {
    work_->command("/url", {{"url", address}});
}

std::string Browser::evaluate(const std::string& script) {
    return work_->command("/execute/sync", {{"script", script}, {"args", json::array()}}).dump();
}

bool Browser::comes(const std::string& expression, double seconds) {
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
    const json tab = work_->command("/window/new", {{"type", "tab"}});
    work_->command("/window", {{"handle", tab["handle"]}});
}

void Browser::prefer_dark() {
    const json dark = {{"name", "prefers-color-scheme"}, {"value", "dark"}};
    work_->command("/goog/cdp/execute",
                   {{"cmd", "Emulation.setEmulatedMedia"}, {"params", {{"features", json::array({dark})}}}});
}

void Browser::act(const std::string& actions) {
    work_->command("/actions", {{"actions", json::parse(actions)}});
}

std::string Browser::devtools(const std::string& command, const std::string& parameters) {
    return work_->command("/goog/cdp/execute", {{"cmd", command}, {"params", json::parse(parameters)}}).dump();
}

void Browser::photograph(const std::string& file) {
    const auto text = work_->get("/screenshot").get<std::string>();
    std::string bytes(text.size(), '\0');
    std::size_t size = 0;
    sodium_base642bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), text.c_str(), text.size(), nullptr,
                      &size, nullptr, sodium_base64_VARIANT_ORIGINAL);
    write_file_atomically(file, bytes.substr(0, size));
}

}  // namespace dynlab::test
