#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>
#include <zmq.hpp>
#include <zmq_addon.hpp>

#include "app/kernel/message.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {

/// The built program as a Jupyter kernel, and what a front end says to it: one socket for requests, one for control,
/// one that hears what all hear.
class KernelClient {
  public:
    KernelClient() {
        const std::filesystem::path file = folder_.path() / "connection.json";
        const std::string base = (folder_.path() / "socket").string();
        const nlohmann::json connection = {
            {"transport", "ipc"}, {"ip", base},      {"key", kKey},     {"signature_scheme", "hmac-sha256"},
            {"shell_port", 1},    {"iopub_port", 2}, {"stdin_port", 3}, {"control_port", 4},
            {"hb_port", 5}};
        std::ofstream(file) << connection.dump();
        process_ = ::fork();
        if (process_ == 0) {
            ::setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
            ::setenv("XDG_STATE_HOME", folder_.path().c_str(), 1);
            ::setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
            const std::filesystem::path complaints = folder_.path() / "complaints";
            if (!std::freopen(complaints.c_str(), "w", stderr)) ::_exit(1);
            std::filesystem::current_path(folder_.path());
            ::execl(DYNLAB_PROGRAM, "dynlab", "kernel", "run", file.c_str(), nullptr);
            ::_exit(1);
        }
        shell_.connect("ipc://" + base + "-1");
        control_.connect("ipc://" + base + "-4");
        heartbeat_.connect("ipc://" + base + "-5");
        iopub_.set(zmq::sockopt::subscribe, "");
        iopub_.connect("ipc://" + base + "-2");
        // Messages to all clients are lost until the subscription is active.
        for (int i = 0; i < 200; ++i) {
            const std::string id = ask("kernel_info_request");
            if (!reply_to(id, 10'000)) break;
            if (next_heard(100)) return;
        }
    }
    ~KernelClient() {
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
    KernelClient(const KernelClient&) = delete;
    KernelClient& operator=(const KernelClient&) = delete;

    pid_t process() const { return process_; }
    std::filesystem::path folder() const { return folder_.path(); }
    std::string complaints() const { return read_file(folder_.path() / "complaints"); }
    bool ends_within(double seconds) {
        for (int i = 0; i < int(seconds * 100); ++i) {
            if (::waitpid(process_, nullptr, WNOHANG) == process_) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }

    /// Sends a request and gives its number.
    std::string ask(const std::string& type, nlohmann::json content = nlohmann::json::object(), bool control = false) {
        const KernelMessage message =
            wire_.made(type, content.is_null() ? nlohmann::json::object() : std::move(content), {});
        send(wire_.write(message), control);
        return message.header["msg_id"];
    }
    void send(const std::vector<std::string>& frames, bool control = false) {
        for (std::size_t i = 0; i < frames.size(); ++i)
            (control ? control_ : shell_)
                .send(zmq::buffer(frames[i]), i + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
    }
    std::optional<KernelMessage> reply_to(const std::string& id, int milliseconds = 60'000, bool control = false) {
        while (const auto message = receive(control ? control_ : shell_, milliseconds))
            if (message->parent.value("msg_id", "") == id) return message;
        return {};
    }
    std::optional<KernelMessage> next_heard(int milliseconds = 60'000) { return receive(iopub_, milliseconds); }

    struct Ran {
        nlohmann::json reply;
        std::vector<KernelMessage> shown;  ///< but states and the input
        std::string printed;

        const nlohmann::json& first(const std::string& type) const {
            static const nlohmann::json kNone = {
                {"data", nullptr}, {"traceback", nullptr}, {"execution_count", nullptr}};
            for (const KernelMessage& message : shown)
                if (message.type() == type) return message.content;
            ADD_FAILURE() << "no " << type << " in the answer: " << reply.dump();
            return kNone;
        }
    };
    std::string start(const std::string& code) { return ask("execute_request", {{"code", code}, {"silent", false}}); }
    /// What came of it, once the kernel is idle again.
    Ran finish(const std::string& id) {
        Ran ran;
        while (const auto heard = next_heard()) {
            if (heard->parent.value("msg_id", "") != id) continue;
            if (heard->type() == "status" && heard->content["execution_state"] == "idle") break;
            if (heard->type() == "status" || heard->type() == "execute_input") continue;
            if (heard->type() == "stream") ran.printed += heard->content["text"].get<std::string>();
            ran.shown.push_back(*heard);
        }
        if (const auto reply = reply_to(id)) ran.reply = reply->content;
        return ran;
    }
    Ran run(const std::string& code) { return finish(start(code)); }
    /// Waits until the running cell has printed something.
    void await_output(const std::string& id) {
        while (const auto heard = next_heard())
            if (heard->parent.value("msg_id", "") == id && heard->type() == "stream") return;
    }
    nlohmann::json answer(const std::string& type, nlohmann::json content = nlohmann::json::object(),
                          bool control = false) {
        const auto reply = reply_to(ask(type, std::move(content), control), 60'000, control);
        return reply ? reply->content : nlohmann::json();
    }
    bool beats() {
        heartbeat_.send(zmq::str_buffer("ping"), zmq::send_flags::none);
        zmq::pollitem_t item{heartbeat_, 0, ZMQ_POLLIN, 0};
        zmq::message_t beat;
        return zmq::poll(&item, 1, std::chrono::seconds(20)) > 0 && heartbeat_.recv(beat) && beat.to_string() == "ping";
    }
    MessageWire& wire() { return wire_; }

  private:
    std::optional<KernelMessage> receive(zmq::socket_t& socket, int milliseconds) {
        zmq::pollitem_t item{socket, 0, ZMQ_POLLIN, 0};
        if (zmq::poll(&item, 1, std::chrono::milliseconds(milliseconds)) == 0) return {};
        std::vector<zmq::message_t> parts;
        if (!zmq::recv_multipart(socket, std::back_inserter(parts))) return {};
        std::vector<std::string> frames;
        for (const zmq::message_t& part : parts) frames.push_back(part.to_string());
        return wire_.read(frames);
    }

    static constexpr const char* kKey = "a key of tests";
    TemporaryFolder folder_;
    zmq::context_t context_{1};
    zmq::socket_t shell_{context_, ZMQ_DEALER}, control_{context_, ZMQ_DEALER}, iopub_{context_, ZMQ_SUB},
        heartbeat_{context_, ZMQ_REQ};
    MessageWire wire_{kKey};
    pid_t process_ = -1;
};

}  // namespace dynlab::test
