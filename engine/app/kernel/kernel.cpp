#include "app/kernel/kernel.h"

#include <fmt/format.h>
#include <signal.h>

#include <atomic>
#include <deque>
#include <iostream>
#include <mutex>
#include <thread>
#include <zmq.hpp>
#include <zmq_addon.hpp>

#include "app/kernel/cell_process.h"
#include "app/kernel/connection.h"
#include "app/kernel/input_history.h"
#include "app/kernel/message.h"
#include "base/error.h"
#include "platform/interrupt.h"
#include "platform/terminal/terminal_text.h"
#include "platform/utf8.h"
#include "scripting/runtime/prompt_statement.h"
#include "scripting/source/lua_reader.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::inline app {
namespace {

using nlohmann::json;

constexpr int kLinger = 1000;                     // milliseconds for what is still to be sent at the end
constexpr std::int64_t kMaxByteCount = 16 << 20;  // of a frame; more cuts the line. A message may have any number
constexpr int kMillisecondsOfPoll = 200;          // until the main thread sees that it is to end
constexpr const char* kProgressName = "dynlab-progress";

std::size_t byte_of_character(std::string_view text, std::size_t characters) {
    std::string_view rest = text;
    for (; characters > 0 && !rest.empty(); --characters) take_character(rest);
    return text.size() - rest.size();
}

std::size_t characters_of(std::string_view text) {
    return characters_in(text).size();
}

/// A member of a received message. Returns `otherwise` if the member is missing or has another type.
template <class T>
T member(const json& object, const char* name, T otherwise) {
    const auto found = object.find(name);
    if (found == object.end() || found->type() != json(otherwise).type()) return otherwise;
    return found->template get<T>();
}

std::size_t cursor_in(const json& content, const std::string& code) {
    const auto found = content.find("cursor_pos");
    if (found == content.end() || !found->is_number_unsigned()) return code.size();
    return byte_of_character(code, found->get<std::size_t>());
}

/// The statement is asked about by a question mark before or behind it: "lsim?".
std::optional<std::string> asked_about(const std::string& code) {
    const std::size_t first = code.find_first_not_of(" \t\n"), last = code.find_last_not_of(" \t\n");
    if (first == std::string::npos || code.find('\n', first) < last) return {};
    if (code[last] == '?') return code.substr(first, last - first);
    if (code[first] == '?') return code.substr(first + 1, last - first);
    return {};
}

json completeness(const std::string& code) {
    const PromptStatement cell = read_script_part(code, {});
    if (cell.kind == PromptStatement::Kind::kIncomplete) return {{"status", "incomplete"}, {"indent", "  "}};
    return {{"status", asked_about(code) || !LuaReader().error_of(cell.code + "\n") ? "complete" : "invalid"}};
}

class Kernel {
  public:
    Kernel(const KernelConnection& connection, std::string version)
        : wire_(connection.key), version_(std::move(version)) {
        for (const auto& [socket, port] :
             {std::pair{&shell_, connection.shell}, std::pair{&control_, connection.control},
              std::pair{&stdin_, connection.stdin_}, std::pair{&iopub_, connection.iopub},
              std::pair{&heartbeat_, connection.heartbeat}}) {
            socket->set(zmq::sockopt::linger, kLinger);
            socket->set(zmq::sockopt::sndhwm, 0);
            socket->set(zmq::sockopt::maxmsgsize, kMaxByteCount);
            try {
                socket->bind(connection.address(port));
            } catch (const zmq::error_t& error) {
                throw EnvironmentError("the kernel cannot listen on {}: {}", connection.address(port),
                                       message_of(error));
            }
        }
    }

    void serve() {
        start_threads();
        publish("status", {{"execution_state", "starting"}}, {});
        while (!stopping_) {
            if (waiting_.empty()) take_waiting(kMillisecondsOfPoll);
            if (waiting_.empty()) continue;
            const KernelMessage request = std::move(waiting_.front());
            waiting_.pop_front();
            if (!answer(request, shell_)) abort_waiting();
        }
        for (std::thread& thread : threads_) thread.join();
    }

  private:
    /// Signals are the main thread's.
    void start_threads() {
        sigset_t all, before;
        ::sigfillset(&all);
        ::pthread_sigmask(SIG_SETMASK, &all, &before);
        repeat_in_thread([this] {
            if (const auto request = receive(control_, kMillisecondsOfPoll)) answer(*request, control_);
        });
        repeat_in_thread([this] {
            std::vector<zmq::message_t> beat = parts_from(heartbeat_, kMillisecondsOfPoll);
            if (!beat.empty()) zmq::send_multipart(heartbeat_, beat);
        });
        ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }

    /// What fails in a thread is said, and ends neither the thread nor the kernel with its variables.
    template <class Step>
    void repeat_in_thread(Step step) {
        threads_.emplace_back([this, step] {
            while (!stopping_) {
                try {
                    step();
                } catch (const std::exception& error) {
                    std::cerr << "dynlab: " << terminal_text(error.what()) << std::endl;
                }
            }
        });
    }

    /// The parts of the next message; empty if none arrives in this time. A sender needs no key to send any number of
    /// parts.
    static std::vector<zmq::message_t> parts_from(zmq::socket_t& socket, int milliseconds) {
        zmq::pollitem_t readable{socket, 0, ZMQ_POLLIN, 0};
        std::vector<zmq::message_t> parts;
        try {
            if (zmq::poll(&readable, 1, std::chrono::milliseconds(milliseconds)) > 0)
                (void)zmq::recv_multipart(socket, std::back_inserter(parts));
        } catch (const zmq::error_t& error) {
            if (error.num() != EINTR) throw;
        }
        return parts;
    }

    std::optional<KernelMessage> receive(zmq::socket_t& socket, int milliseconds) {
        std::vector<std::string> frames;
        for (const zmq::message_t& part : parts_from(socket, milliseconds)) frames.push_back(part.to_string());
        if (frames.empty()) return {};
        try {
            return wire_.read(frames);
        } catch (const BadMessage& error) {
            std::cerr << "dynlab: not answered: " << terminal_text(error.what()) << std::endl;
            return {};
        }
    }

    static void send_frames(zmq::socket_t& socket, const std::vector<std::string>& frames) {
        for (std::size_t i = 0; i < frames.size(); ++i)
            socket.send(zmq::buffer(frames[i]),
                        i + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
    }

    /// The main thread and the thread of the control socket both publish.
    void publish(const std::string& type, json content, const KernelMessage& parent) {
        const std::lock_guard lock(output_mutex_);
        KernelMessage message = wire_.made(type, std::move(content), parent);
        message.identities = {type};
        send_frames(iopub_, wire_.write(message));
    }

    void reply(const KernelMessage& request, json content, zmq::socket_t& socket) {
        const std::string type = request.type();
        const std::lock_guard lock(output_mutex_);
        KernelMessage message =
            wire_.made(type.substr(0, type.rfind("_request")) + "_reply", std::move(content), request);
        message.identities = request.identities;
        send_frames(socket, wire_.write(message));
    }

    /// The requests that have come by now.
    void take_waiting(int milliseconds) {
        while (auto request = receive(shell_, milliseconds)) {
            waiting_.push_back(std::move(*request));
            milliseconds = 0;
        }
    }

    /// A cell that failed takes those with it that waited already, as "run all" sends them.
    void abort_waiting() {
        for (const KernelMessage& waiting : waiting_) {
            if (waiting.type() != "execute_request") continue;
            publish("status", {{"execution_state", "busy"}}, waiting);
            reply(waiting, {{"status", "aborted"}}, shell_);
            publish("status", {{"execution_state", "idle"}}, waiting);
        }
        std::erase_if(waiting_, [](const KernelMessage& waiting) { return waiting.type() == "execute_request"; });
    }

    /// False where a cell failed that those behind it need.
    bool answer(const KernelMessage& request, zmq::socket_t& socket) {
        publish("status", {{"execution_state", "busy"}}, request);
        bool well = true;
        try {
            well = answered_well(request, socket);
        } catch (const json::exception& error) {  // a member is not of the kind that it should be
            reply(request,
                  {{"status", "error"}, {"ename", "error"}, {"evalue", error.what()}, {"traceback", json::array()}},
                  socket);
        }
        publish("status", {{"execution_state", "idle"}}, request);
        return well;
    }

    bool answered_well(const KernelMessage& request, zmq::socket_t& socket) {
        const std::string type = request.type();
        const json& content = request.content;
        bool well = true;
        if (type == "kernel_info_request") reply(request, about(), socket);
        if (type == "interrupt_request") {
            cells_.interrupt();
            reply(request, {{"status", "ok"}}, socket);
        }
        if (type == "shutdown_request") end(request, socket);
        if (type == "comm_info_request") reply(request, {{"status", "ok"}, {"comms", json::object()}}, socket);
        if (type == "history_request") reply(request, {{"status", "ok"}, {"history", history_.found(content)}}, socket);
        if (type == "is_complete_request") reply(request, completeness(member(content, "code", std::string())), socket);
        if (&socket == &shell_) {  // what needs the cells' process is asked by the main thread only
            if (type == "complete_request") complete(request);
            if (type == "inspect_request") inspect(request);
            if (type == "execute_request") well = execute(request);
        }
        return well;
    }

    json about() const {
        return {
            {"status", "ok"},
            {"protocol_version", "5.3"},
            {"implementation", "dynlab"},
            {"implementation_version", version_},
            {"language_info",
             {{"name", kKernelLanguage},
              {"version", "5.4"},
              {"mimetype", "text/x-lua"},
              {"file_extension", ".lua"},
              {"codemirror_mode", "lua"},
              {"pygments_lexer", "lua"},
              {"nbconvert_exporter", "script"}}},
            {"banner", "dynlab " + version_ + ": help() lists the functions, help(\"tf\") or tf? shows help for one."},
            {"help_links", json::array()}};
    }

    void end(const KernelMessage& request, zmq::socket_t& socket) {
        const json reported = {{"status", "ok"}, {"restart", member(request.content, "restart", false)}};
        reply(request, reported, socket);
        publish("shutdown_reply", reported, request);
        stopping_ = true;
        cells_.stop();
    }

    void complete(const KernelMessage& request) {
        const std::string code = member(request.content, "code", std::string());
        const std::string before = code.substr(0, cursor_in(request.content, code));
        CellNews found;
        cells_.ask({.kind = "complete", .code = before}, [&](const CellNews& news) { found = news; });
        const std::size_t typed = std::min(found.typed, before.size());
        reply(request,
              {{"status", "ok"},
               {"matches", found.lines},
               {"cursor_start", characters_of(before.substr(0, before.size() - typed))},
               {"cursor_end", characters_of(before)},
               {"metadata", json::object()}},
              shell_);
    }

    std::string said_of(const std::string& code, std::size_t cursor) {
        std::string text;
        cells_.ask({.kind = "inspect", .code = code, .cursor = cursor},
                   [&](const CellNews& news) { text = news.text; });
        return text;
    }

    void inspect(const KernelMessage& request) {
        const std::string code = member(request.content, "code", std::string());
        const std::string text = said_of(code, cursor_in(request.content, code));
        reply(request,
              {{"status", "ok"},
               {"found", !text.empty()},
               {"data", text.empty() ? json::object() : json{{"text/plain", text}}},
               {"metadata", json::object()}},
              shell_);
    }

    bool execute(const KernelMessage& request) {
        const std::string code = member(request.content, "code", std::string());
        const bool silent = member(request.content, "silent", false);
        const bool stored = member(request.content, "store_history", !silent) && !silent;
        if (stored) ++count_;
        if (!silent) publish("execute_input", {{"code", code}, {"execution_count", count_}}, request);
        json payload = json::array(), failure;
        std::string result;
        if (const auto subject = asked_about(code)) {
            const std::string text = said_of(*subject, subject->size());
            payload.push_back({{"source", "page"},
                               {"start", 0},
                               {"data", {{"text/plain", text.empty() ? "no help for " + *subject : text}}}});
        } else {
            failure = run(code, request, silent, result);
        }
        if (stored) history_.add(count_, code, result);
        json reported = failure.is_null()
                            ? json{{"status", "ok"}, {"payload", payload}, {"user_expressions", json::object()}}
                            : failure;
        reported["execution_count"] = count_;
        reply(request, reported, shell_);
        return failure.is_null() || !member(request.content, "stop_on_error", true);
    }

    /// Runs a cell and publishes its output. Returns null, or the failure for the reply.
    json run(const std::string& code, const KernelMessage& request, bool silent, std::string& result) {
        json failure;
        bool progress = false;
        const auto fail = [&](const std::string& name, const std::string& what, const std::vector<std::string>& lines) {
            take_waiting(0);  // the sender of the following messages may already have read it
            failure = {{"ename", name}, {"evalue", what}, {"traceback", lines}};
            if (!silent) publish("error", failure, request);
            failure["status"] = "error";
        };
        const auto ended = cells_.ask({.kind = "run", .code = code, .count = count_}, [&](const CellNews& news) {
            if (news.kind == "failed") fail(news.interrupted ? "interrupted" : "error", news.text, news.lines);
            if (silent) return;
            if (news.kind == "print") publish("stream", {{"name", "stdout"}, {"text", news.text}}, request);
            if (news.kind == "progress") report_progress(news.progress, progress, request);
            if (news.kind != "display" && news.kind != "result") return;
            json shown = {{"data", json::parse(news.data)}, {"metadata", json::object()}};
            if (news.kind == "result") {
                shown["execution_count"] = count_;
                result = shown["data"].value("text/plain", "");
            }
            publish(news.kind == "result" ? "execute_result" : "display_data", shown, request);
        });
        if (ended) fail("process ended", *ended, {*ended});
        return failure;
    }

    /// The first of a cell makes a line of output, which those that follow replace.
    void report_progress(double part, bool& shown, const KernelMessage& request) {
        if (part < 0 && !shown) return;
        const int percent = static_cast<int>(100 * part);
        const std::string text = part < 0 ? "" : fmt::format("[{:<20}] {} %", std::string(percent / 5, '#'), percent);
        publish(shown ? "update_display_data" : "display_data",
                {{"data", {{"text/plain", text}}},
                 {"metadata", json::object()},
                 {"transient", {{"display_id", fmt::format("{}-{}", kProgressName, count_)}}}},
                request);
        shown = true;
    }

    CellProcess cells_;  ///< before there are threads
    zmq::context_t context_{1};
    zmq::socket_t shell_{context_, ZMQ_ROUTER}, control_{context_, ZMQ_ROUTER}, stdin_{context_, ZMQ_ROUTER},
        iopub_{context_, ZMQ_PUB}, heartbeat_{context_, ZMQ_REP};
    MessageWire wire_;
    std::string version_;
    std::mutex output_mutex_;  ///< of iopub_ and wire_
    std::atomic<bool> stopping_ = false;
    std::vector<std::thread> threads_;
    std::deque<KernelMessage> waiting_;  ///< requests, in order
    InputHistory history_;
    int count_ = 0;
};

}  // namespace

void serve_kernel(const std::filesystem::path& connection_file, const std::string& version) {
    const KernelConnection connection = read_connection(connection_file);
    end_when_terminated();
    Kernel kernel(connection, version);
    ::signal(SIGINT, SIG_IGN);  // of a terminal; Jupyter sends a message
    kernel.serve();
}

}  // namespace dynlab::inline app
