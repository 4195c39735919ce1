#include "support/firefox.h"

#include <arpa/inet.h>
#include <sys/socket.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "platform/child_process.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/system_call.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

constexpr const char* kFirefox = "firefox-esr";

ChildOptions headless(const std::filesystem::path& profile) {
    std::ofstream(profile / "user.js") << "user_pref(\"marionette.port\", 0);\n";  // any free one
    ChildOptions options;
    options.command = {kFirefox, "--headless", "--marionette", "--no-remote", "--profile", profile.string()};
    options.environment = {{"HOME", profile.string()}};
    return options;
}

}  // namespace

/// Both sides send "LENGTH:" and JSON: [0, number, command, parameters], and [1, number, error, result].
class Firefox::Work {
  public:
    Work() : firefox_(headless(profile_.path()), kFirefox) {
        connect(port());
        receive();  // how it greets
        command("WebDriver:NewSession", {{"capabilities", json::object()}});
    }

    json command(const char* name, const json& parameters) {
        const std::string text = json::array({0, ++number_, name, parameters}).dump();
        const std::string bytes = std::to_string(text.size()) + ":" + text;
        if (!write_all(socket_.get(), bytes.data(), bytes.size())) throw EnvironmentError("Firefox does not listen");
        const json reply = receive();
        if (!reply.at(2).is_null()) throw EnvironmentError(reply.at(2).at("message").get<std::string>());
        return reply.at(3);
    }

  private:
    int port() const {
        int port = 0;
        for (int i = 0; i < 6000 && port == 0; ++i, std::this_thread::sleep_for(10ms))
            std::ifstream(profile_.path() / "MarionetteActivePort") >> port;
        return port;
    }
    void connect(int port) {
        socket_ = FileDescriptor(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        if (::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
            throw EnvironmentError("Firefox does not start");
    }
    json receive() {
        std::string length;
        while (!length.ends_with(':')) length += bytes(1);
        return json::parse(bytes(std::stoul(length)));
    }
    std::string bytes(std::size_t count) {
        std::string all(count, '\0');
        if (::recv(socket_.get(), all.data(), count, MSG_WAITALL) != static_cast<ssize_t>(count))
            throw EnvironmentError("Firefox does not answer");
        return all;
    }

    TemporaryFolder profile_;
    ChildProcess firefox_;
    FileDescriptor socket_;
    int number_ = 0;
};

bool Firefox::is_installed() {
    return find_program(kFirefox).has_value();
}

Firefox::Firefox() : work_(std::make_unique<Work>()) {}
Firefox::~Firefox() = default;

void Firefox::visit(const std::string& address) {
    work_->command("WebDriver:Navigate", {{"url", address}});
}

std::string Firefox::evaluate(const std::string& script) {
    for (int i = 0;; ++i, std::this_thread::sleep_for(50ms)) try {
            const json asked = {{"script", script}, {"args", json::array()}};
            return work_->command("WebDriver:ExecuteScript", asked).at("value").dump();
        } catch (const EnvironmentError& error) {
            // Of Firefox itself, not of the script: the page is being left.
            if (i == 100 || !std::string(error.what()).starts_with("[Exception...")) throw;
        }
}

}  // namespace dynlab::test
