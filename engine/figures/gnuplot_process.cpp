#include "figures/gnuplot_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <future>
#include <string_view>
#include <utility>
#include <vector>

#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/process_group.h"
#include "platform/program_lookup.h"

namespace dynlab::inline figures {
namespace {

constexpr auto kDrawingTimeout = std::chrono::minutes(2);
constexpr auto kLastWordsTimeout = std::chrono::seconds(1);

/// The inherited environment without what steers gnuplot.
std::vector<std::string> gnuplot_environment() {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string_view text = *variable;
        const bool steers = text.starts_with("GNUPLOT_") || text.starts_with("GNUTERM=") || text.starts_with("FIT_");
        if (!steers) variables.emplace_back(text);
    }
    return variables;
}

}  // namespace

GnuplotProcess::GnuplotProcess() {
    const auto program = find_program("gnuplot");
    if (!program) throw MissingProgram("gnuplot", "gnuplot-nox");
    // The thread that starts gnuplot lives as long as gnuplot, which is killed with it.
    std::promise<void> starting;
    std::future<void> started = starting.get_future();
    reader_ = std::thread([this, name = program->string(), starting = std::move(starting)]() mutable {
        try {
            start(name);
        } catch (...) {
            starting.set_exception(std::current_exception());
            return;
        }
        starting.set_value();
        collect();
    });
    try {
        started.get();
    } catch (...) {
        reader_.join();
        throw;
    }
}

GnuplotProcess::~GnuplotProcess() {
    end();
}

void GnuplotProcess::end() {
    if (!reader_.joinable()) return;
    kill(-pid_, SIGKILL);
    ends_ = {};
    retry_interrupted([this] { return waitpid(pid_, nullptr, 0); });
    reader_.join();
}

void GnuplotProcess::start(const std::string& program) {
    Pipe commands, complaints;
    const FileDescriptor nowhere(open("/dev/null", O_WRONLY | O_CLOEXEC));
    // Named as a file, standard input is read in blocks; otherwise gnuplot reads it byte by byte.
    pid_ = start_bound_program(program, {"gnuplot", "--default-settings", "/dev/stdin"}, gnuplot_environment(),
                               {commands.read_end.get(), nowhere.get(), complaints.write_end.get()});
    if (pid_ < 0) throw EnvironmentError("cannot start gnuplot (\"{}\"): {}", program, system_reason(errno));
    ends_ = EndsWithProgram::of_group(pid_);
    commands_ = std::move(commands.write_end);
    complaints_ = std::move(complaints.read_end);
}

void GnuplotProcess::collect() {
    std::array<char, 4096> buffer;
    for (;;) {
        const ssize_t count = retry_interrupted([&] { return read(complaints_.get(), buffer.data(), buffer.size()); });
        const std::lock_guard lock(mutex_);
        if (count > 0)
            text_.append(buffer.data(), static_cast<std::size_t>(count));
        else
            ended_ = true;
        heard_.notify_all();
        if (ended_) return;
    }
}

std::FILE* GnuplotProcess::take_input() {
    std::FILE* input = fdopen(commands_.get(), "w");
    if (input == nullptr) throw EnvironmentError("cannot start gnuplot: {}", system_reason(errno));
    commands_.release();
    return input;
}

std::string GnuplotProcess::report_command(unsigned number) {
    return fmt::format("print 'figure {} done'\n", number);
}

std::optional<std::string> GnuplotProcess::wait_for_report(unsigned number) {
    const std::string report = fmt::format("figure {} done\n", number);
    const auto give_up = std::chrono::steady_clock::now() + kDrawingTimeout;
    std::unique_lock lock(mutex_);
    for (;;) {
        if (const std::size_t at = text_.find(report); at != std::string::npos) {
            const std::string before = text_.substr(0, at);
            text_.erase(0, at + report.size());
            return before;
        }
        if (ended_ || std::chrono::steady_clock::now() > give_up) return {};
        throw_if_interrupted();
        heard_.wait_for(lock, std::chrono::milliseconds(50));  // wakes to notice Ctrl-C
    }
}

std::string GnuplotProcess::last_complaints() {
    std::unique_lock lock(mutex_);
    heard_.wait_for(lock, kLastWordsTimeout, [this] { return ended_; });  // a broken pipe is known before what was said
    return text_;
}

}  // namespace dynlab::inline figures
