#include "platform/child_process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <stdexcept>
#include <tuple>

#include "platform/error.h"
#include "platform/process_group.h"
#include "platform/program_lookup.h"

namespace dynlab::inline platform {
namespace {

constexpr char kBubblewrapProgram[] = "bwrap";

/// A process that outlives this program by a moment, to kill the groups that run then. `changes` has the leader of each
/// that begins, and minus the leader of each that has ended.
[[noreturn]] void survive(int changes) {
    constexpr int kMax = 1024;
    static pid_t groups[kMax] = {};
    ::setsid();
    if (changes > 0) ::close_range(0, static_cast<unsigned>(changes) - 1, 0);
    ::close_range(static_cast<unsigned>(changes) + 1, ~0U, 0);
    pid_t change = 0;
    while (retry_interrupted([&] { return ::read(changes, &change, sizeof change); }) == sizeof change)
        if (pid_t* const place = std::find(groups, groups + kMax, std::max(-change, 0)); place != groups + kMax)
            *place = std::max(change, 0);
    for (const pid_t group : groups)
        if (group > 0) ::kill(-group, SIGKILL);
    ::_exit(0);
}

/// bubblewrap binds its inner process to the outer one late: if the outer one is killed earlier, as happens when this
/// program is killed, the inner one stays forever. Another process must therefore kill the whole group. Returns the
/// pipe that survive() reads.
int sandbox_changes() {
    static const Pipe changes = [] {
        Pipe pipe;
        if (::fork() == 0) survive(pipe.read_end.get());
        ::fcntl(pipe.write_end.get(), F_SETFL, O_NONBLOCK);  // whatever happens to the other
        return pipe;
    }();
    return changes.write_end.get();
}

void notify_change(int changes, pid_t change) {
    write_all(changes, reinterpret_cast<const char*>(&change), sizeof change);
}

struct EndOfSandbox {
    pid_t leader = 0;  ///< 0: no sandbox
    ~EndOfSandbox() {
        if (leader > 0) notify_change(sandbox_changes(), -leader);
    }
};

/// Everything exec needs, made before the fork: between fork and exec only async-signal-safe calls are allowed.
struct Launch {
    std::string program, folder;
    int changes = -1;  ///< of a sandbox, to report its end; a sandbox has a separate session, without a terminal
    std::vector<std::string> arguments, environment;
    std::vector<char*> argument_pointers, environment_pointers;
    std::optional<std::chrono::milliseconds> processor_time;
    std::optional<std::uint64_t> memory_bytes, file_bytes;
    FileDescriptor input;
    FileDescriptor given_later;  ///< our end of an input that is given later
};

std::string program_file(const std::string& name, const std::string& package) {
    const auto found = find_program(name);
    if (!found) throw MissingProgram(name, package);
    return *found;
}

std::vector<std::string> merged_environment(const std::vector<std::pair<std::string, std::string>>& changes) {
    std::vector<std::string> merged;
    for (char** entry = environ; *entry; ++entry) {
        const std::string text = *entry;
        const std::string name = text.substr(0, text.find('='));
        const auto replaces = [&](const auto& change) { return change.first == name; };
        if (std::find_if(changes.begin(), changes.end(), replaces) == changes.end()) merged.push_back(text);
    }
    for (const auto& [name, value] : changes) merged.push_back(name + "=" + value);
    return merged;
}

/// The input as a file in memory: no pipe to feed, so a child that does not read its input cannot block us.
FileDescriptor input_file(const std::string& input) {
    if (input.empty()) return FileDescriptor(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    FileDescriptor file(::memfd_create("dynlab-input", MFD_CLOEXEC));
    if (!file || !write_all(file.get(), input.data(), input.size()) || ::lseek(file.get(), 0, SEEK_SET) != 0) {
        throw EnvironmentError("cannot pass input to a child process: {}", system_reason(errno));
    }
    return file;
}

/// A socket instead of a pipe: writing to a child that has ended raises no signal.
std::pair<FileDescriptor, FileDescriptor> input_socket() {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw EnvironmentError("cannot pass input to a child process: {}", system_reason(errno));
    return {FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

Launch prepare_launch(const ChildOptions& options, const std::string& package) {
    if (options.command.empty()) throw std::invalid_argument("a child process needs a command");
    Launch launch;
    launch.program = program_file(options.command.front(), package);
    launch.folder = options.folder.string();
    if (options.command.front() == kBubblewrapProgram) launch.changes = sandbox_changes();
    launch.arguments = options.command;
    launch.environment = merged_environment(options.environment);
    launch.argument_pointers = pointers_to(launch.arguments);
    launch.environment_pointers = pointers_to(launch.environment);
    launch.processor_time = options.processor_time;
    launch.memory_bytes = options.memory_bytes;
    launch.file_bytes = options.file_bytes;
    if (options.input_later)
        std::tie(launch.input, launch.given_later) = input_socket();
    else
        launch.input = input_file(options.input);
    return launch;
}

/// Runs in the child. On failure errno goes up the `failure` pipe, which a successful exec closes.
[[noreturn]] void become_program(const Launch& launch, pid_t parent, int output, int error_output, int failure) {
    if (launch.changes >= 0) ::setsid();
    if (!become_group_leader(parent)) ::_exit(127);
    if (launch.changes >= 0) notify_change(launch.changes, ::getpid());
    const bool ready = ::dup2(launch.input.get(), STDIN_FILENO) >= 0 && ::dup2(output, STDOUT_FILENO) >= 0 &&
                       ::dup2(error_output, STDERR_FILENO) >= 0 &&
                       (launch.folder.empty() || ::chdir(launch.folder.c_str()) == 0);
    if (ready) {
        if (launch.processor_time) limit_processor_time(*launch.processor_time);
        if (launch.memory_bytes) limit_memory(*launch.memory_bytes);
        if (launch.file_bytes) limit_files(*launch.file_bytes);
        ::execve(launch.program.c_str(), launch.argument_pointers.data(), launch.environment_pointers.data());
    }
    const int reason = errno;
    write_all(failure, reinterpret_cast<const char*>(&reason), sizeof reason);
    ::_exit(127);
}

/// `given_later` gets our end of an input that is given later.
std::unique_ptr<ProcessGroup> start(const ChildOptions& options, const std::string& package,
                                    FileDescriptor* given_later = nullptr) {
    Launch launch = prepare_launch(options, package);
    Pipe output, error_output, failure;
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child < 0) throw EnvironmentError("cannot start {}: {}", launch.program, system_reason(errno));
    if (child == 0) {
        become_program(launch, parent, output.write_end.get(), error_output.write_end.get(), failure.write_end.get());
    }
    failure.write_end.close();
    int reason = 0;
    const ssize_t failed = retry_interrupted([&] { return ::read(failure.read_end.get(), &reason, sizeof reason); });
    // Once exec is done or has failed: who leads a group already cannot begin a session.
    auto group = std::make_unique<ProcessGroup>(
        child, std::move(output.read_end), std::move(error_output.read_end),
        ProcessGroup::Limits{options.timeout, options.processor_time, options.output_bytes, options.give_up,
                             options.heeds_interrupt});
    if (failed > 0) {
        if (launch.folder.empty()) throw EnvironmentError("cannot start {}: {}", launch.program, system_reason(reason));
        throw EnvironmentError("cannot start {}: {} (in {})", launch.program, system_reason(reason), launch.folder);
    }
    if (given_later != nullptr) *given_later = std::move(launch.given_later);
    return group;
}

}  // namespace

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

ChildResult run_child(const ChildOptions& options, const std::string& package) {
    const auto group = start(options, package);
    const EndOfSandbox end{options.command.front() == kBubblewrapProgram ? group->leader() : 0};
    return group->wait();
}

struct ChildProcess::State {
    std::unique_ptr<ProcessGroup> group;
    FileDescriptor input;
};

ChildProcess::ChildProcess(const ChildOptions& options, const std::string& package) : state_(new State) {
    state_->group = start(options, package, &state_->input);
}
ChildProcess::~ChildProcess() = default;
ChildProcess::ChildProcess(ChildProcess&&) noexcept = default;
ChildProcess& ChildProcess::operator=(ChildProcess&&) noexcept = default;

void ChildProcess::give_input(const std::string& input) {
    if (!state_->input) throw std::logic_error("this child process has its input already");
    for (std::size_t given = 0; given < input.size();) {
        const ssize_t part = retry_interrupted(
            [&] { return ::send(state_->input.get(), input.data() + given, input.size() - given, MSG_NOSIGNAL); });
        if (part <= 0) break;
        given += static_cast<std::size_t>(part);
    }
    ::shutdown(state_->input.get(), SHUT_WR);  // a close is no end while a copy of this process has the socket, too
    state_->input.close();
    if (state_->group) state_->group->start_clock();
}

bool ChildProcess::ended() const {
    return !state_->group || state_->group->leader_exited();
}

int ChildProcess::id() const {
    return state_->group->leader();
}

ChildResult ChildProcess::wait() {
    if (!state_->group) throw std::logic_error("a child process can be waited for only once");
    const auto group = std::move(state_->group);
    return group->wait();
}

}  // namespace dynlab::inline platform
