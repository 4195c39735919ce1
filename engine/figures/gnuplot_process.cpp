#include "figures/gnuplot_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
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
    start(program->string());
    reader_ = std::thread([this] { collect(); });
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
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, commands.read_end.get(), STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, complaints.write_end.get(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none, defaults;
    sigemptyset(&none);
    sigemptyset(&defaults);
    for (const int signal_number : {SIGPIPE, SIGINT, SIGTERM}) sigaddset(&defaults, signal_number);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

    // Named as a file, standard input is read in blocks; otherwise gnuplot reads it byte by byte.
    std::vector<std::string> arguments = {"gnuplot", "--default-settings", "/dev/stdin"};
    std::vector<std::string> environment = gnuplot_environment();
    const int failure = posix_spawn(&pid_, program.c_str(), &files, &attributes, pointers_to(arguments).data(),
                                    pointers_to(environment).data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (failure != 0) throw EnvironmentError("cannot start gnuplot (\"{}\"): {}", program, system_reason(failure));
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
