#include "app/kernel/cell_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <limits>

#include "app/kernel/cell_environment.h"
#include "data_io/values/cbor_values.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/process_group.h"

namespace dynlab::inline app {
namespace {

constexpr int kMillisecondsForMore = 5;
constexpr std::size_t kLargestPiece = std::size_t{64} << 10;

/// A copy of this process that ends with it. True in the copy.
bool fork_bound(pid_t& process) {
    process = fork_bound_copy();
    if (process < 0) throw EnvironmentError("cannot start a process for cells: {}", system_reason(errno));
    return process == 0;
}

std::string how_it_ended(int status) {
    if (WIFSIGNALED(status)) return fmt::format("signal {}: {}", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
    return fmt::format("exit code {}", WEXITSTATUS(status));
}

/// Starts a process for cells on each request and reports how the previous process ended.
[[noreturn]] void keep_ready(Channel orders) {
    const FileDescriptor nowhere(::open("/dev/null", O_RDWR | O_CLOEXEC));
    ::dup2(nowhere.get(), STDIN_FILENO);
    ::dup2(nowhere.get(), STDOUT_FILENO);
    end_when_terminated();
    pid_t process = -1;
    while (orders.receive()) {
        CellNews news{.kind = "started"};
        int status = 0;
        if (process > 0 && retry_interrupted([&] { return ::waitpid(process, &status, 0); }) == process)
            news.text = how_it_ended(status);
        auto [here, there] = Channel::pair();
        if (fork_bound(process)) {
            here.release();
            orders.release();
            serve_cells(std::move(there));
        }
        news.process = process;
        if (!orders.send(cbor_of(news), here.descriptor())) break;
    }
    ::_exit(0);
}

}  // namespace

CellProcess::CellProcess() : keeper_(FileDescriptor()), line_(FileDescriptor()) {
    clear_interrupts(std::numeric_limits<int>::max());
    auto [here, there] = Channel::pair();
    pid_t keeper = -1;
    if (fork_bound(keeper)) {
        here.release();
        keep_ready(std::move(there));
    }
    keeper_ = std::move(here);
    start();
}

CellProcess::~CellProcess() {
    stop();
}

void CellProcess::start() {
    std::optional<Channel::Message> answer;
    if (keeper_.send("start")) answer = keeper_.receive();
    if (!answer) throw EnvironmentError("the process that starts cell processes has exited; restart the kernel");
    const auto news = from_cbor<CellNews>(answer->bytes);
    const std::lock_guard lock(mutex_);
    line_ = Channel(std::move(answer->file));
    process_ = static_cast<pid_t>(news.process);
    ended_ = news.text;
}

std::optional<CellNews> CellProcess::next() {
    if (held_) return std::exchange(held_, std::nullopt);
    const auto message = line_.receive();
    if (!message) return {};
    auto news = from_cbor<CellNews>(message->bytes);
    return news.kind == "print" ? with_what_follows(std::move(news)) : news;
}

std::optional<CellNews> CellProcess::with_what_follows(CellNews printed) {
    pollfd readable{line_.descriptor(), POLLIN, 0};
    while (printed.text.size() < kLargestPiece && ::poll(&readable, 1, kMillisecondsForMore) > 0) {
        const auto message = line_.receive();
        if (!message) break;
        auto news = from_cbor<CellNews>(message->bytes);
        if (news.kind != "print") {
            held_ = std::move(news);
            break;
        }
        printed.text += news.text;
    }
    return printed;
}

void CellProcess::note_begun() {
    const std::lock_guard lock(mutex_);
    begun_ = true;
    if (std::exchange(interrupt_waits_, false)) ::kill(process_, SIGINT);
}

std::optional<std::string> CellProcess::ask(const CellOrder& order, const Listener& listener) {
    {
        const std::lock_guard lock(mutex_);
        running_ = order.kind == "run";
        begun_ = interrupt_waits_ = false;
    }
    bool done = false;
    if (line_.send(cbor_of(order))) {
        while (!done) {
            const auto news = next();
            if (!news) break;
            if (news->kind == "begun") note_begun();
            done = news->kind == "done";
            if (done) {
                const std::lock_guard lock(mutex_);
                running_ = false;
            }
            listener(*news);
        }
    }
    if (done) return {};
    {
        const std::lock_guard lock(mutex_);
        running_ = false;
        if (stopped_) return "The kernel ends.";
    }
    held_.reset();
    start();
    return fmt::format(
        "The process that ran this cell has exited ({}). Its variables are lost; the next cell starts a new process.",
        ended_);
}

/// What is asked of a process is read behind the signals sent to it before: one that comes too late for its cell is
/// forgotten as the next begins.
void CellProcess::interrupt() {
    const std::lock_guard lock(mutex_);
    if (!running_) return;
    if (begun_)
        ::kill(process_, SIGINT);
    else
        interrupt_waits_ = true;
}

void CellProcess::stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    if (process_ > 0) ::kill(process_, SIGKILL);
}

}  // namespace dynlab::inline app
