#include "platform/process_group.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/time_limits.h"

namespace dynlab::inline platform {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPipeBytes = 1 << 20;         // a megabyte of output never holds a child up
constexpr int kLookForInterruptEvery = 50;  // milliseconds; Ctrl-C may reach another thread than the waiting one
constexpr auto kLookAtProcessorTimeEvery = std::chrono::milliseconds(kLookForInterruptEvery);
constexpr int kLookForExitEvery = 2;  // milliseconds, where the kernel has no pidfd_open

/// A descriptor that becomes readable when the process ends (Linux 5.3); empty where that is refused.
FileDescriptor open_process(pid_t process) {
    return FileDescriptor(static_cast<int>(::syscall(SYS_pidfd_open, process, 0)));
}

}  // namespace

Pipe::Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw EnvironmentError("cannot create a pipe: {}", system_reason(errno));
    read_end = FileDescriptor(ends[0]);
    write_end = FileDescriptor(ends[1]);
}

bool become_group_leader(pid_t parent) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    // Python, for one, has its programs ignore SIGPIPE and SIGXFSZ.
    for (const int number : {SIGINT, SIGPIPE, SIGTERM, SIGQUIT, SIGHUP, SIGCHLD, SIGXFSZ}) ::signal(number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    return ::getppid() == parent;
}

pid_t fork_bound_copy() {
    const pid_t parent = ::getpid();
    const pid_t copy = ::fork();
    if (copy != 0) return copy;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(0);
    return 0;
}

pid_t start_bound_program(const std::string& program, std::vector<std::string> arguments,
                          std::vector<std::string> environment, const std::array<int, 3>& streams) {
    const std::vector<char*> argument_pointers = pointers_to(arguments), variables = pointers_to(environment);
    const pid_t parent = ::getpid();
    sigset_t all, before;
    sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before);  // until exec the child has our memory: no handler may run there
    volatile int reason = 0;
    const pid_t child = ::vfork();
    if (child == 0) {
        bool ready = become_group_leader(parent);
        for (int target = 0; ready && target < 3; ++target) {
            const int stream = streams[static_cast<std::size_t>(target)];
            ready = (stream == target ? ::fcntl(target, F_SETFD, 0) : ::dup2(stream, target)) >= 0;
        }
        if (ready) ::execve(program.c_str(), argument_pointers.data(), variables.data());
        reason = errno;
        ::_exit(127);
    }
    const int failure = child < 0 ? errno : reason;
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (child < 0 || failure == 0) {
        errno = failure;
        return child;
    }
    retry_interrupted([child] { return ::waitpid(child, nullptr, 0); });
    errno = failure;
    return -1;
}

void limit_memory(std::uint64_t bytes) {
#ifndef __SANITIZE_ADDRESS__  // the address sanitizer reserves more addresses than any limit leaves
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_AS, &limit);
#else
    static_cast<void>(bytes);
#endif
}

void limit_files(std::uint64_t bytes) {
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = limit.rlim_max = std::min<rlim_t>(bytes, limit.rlim_max);
    ::setrlimit(RLIMIT_FSIZE, &limit);
}

void limit_processor_time(std::chrono::milliseconds max_time) {
    rlimit limit{};
    ::getrlimit(RLIMIT_CPU, &limit);
    const auto seconds = static_cast<rlim_t>(std::chrono::ceil<std::chrono::seconds>(max_time).count());
    limit.rlim_cur = std::min(seconds, limit.rlim_cur);
    limit.rlim_max = std::min(limit.rlim_cur + 1, limit.rlim_max);  // SIGKILL for who catches the signal
    ::setrlimit(RLIMIT_CPU, &limit);
}

ProcessGroup::ProcessGroup(pid_t leader, FileDescriptor output, FileDescriptor error_output, const Limits& limits)
    : leader_(leader),
      output_(std::move(output)),
      error_output_(std::move(error_output)),
      leader_exit_(open_process(leader)),
      timeout_(limits.timeout),
      processor_time_(limits.processor_time),
      output_bytes_(limits.output_bytes),
      give_up_(limits.give_up),
      heeds_interrupt_(limits.heeds_interrupt) {
    ::setpgid(leader, leader);  // by parent and child, so that the group exists regardless of which runs first
    start_clock();
    for (const FileDescriptor* stream : {&output_, &error_output_}) {
        ::fcntl(stream->get(), F_SETFL, O_NONBLOCK);
        ::fcntl(stream->get(), F_SETPIPE_SZ, kPipeBytes);
    }
}

ProcessGroup::~ProcessGroup() {
    if (leader_ > 0) kill_and_reap();
}

void ProcessGroup::start_clock() {
    if (timeout_) deadline_ = Clock::now() + *timeout_;
}

ChildResult ProcessGroup::wait() {
    collect_until_exit();
    kill_and_reap();
    // What was written before the end still lies in the pipes.
    collect(output_, result_.output);
    collect(error_output_, result_.error_output);
    return std::move(result_);
}

void ProcessGroup::collect_until_exit() {
    while (!leader_exited()) {
        pollfd waiting[3] = {{output_.get(), POLLIN, 0},
                             {error_output_.get(), POLLIN, 0},
                             {leader_exit_.get(), POLLIN, 0}};  // closed ones (-1) are passed over
        ::poll(waiting, 3, milliseconds_to_poll());
        if (heeds_interrupt_) throw_if_interrupted();
        collect(output_, result_.output);
        collect(error_output_, result_.error_output);
        result_.processor_time_used_up = processor_time_is_used_up() && !leader_exited();
        result_.timed_out =
            result_.processor_time_used_up || (deadline_ && Clock::now() >= *deadline_ && !leader_exited());
        result_.given_up = give_up_ && give_up_();
        if (result_.timed_out || result_.output_exceeded || result_.given_up) return;
    }
}

/// Looks now and then, as it reads several files.
bool ProcessGroup::processor_time_is_used_up() {
    if (!processor_time_ || Clock::now() < next_look_) return false;
    next_look_ = Clock::now() + kLookAtProcessorTimeEvery;
    return processor_time_of_tree(leader_) >= *processor_time_;
}

int ProcessGroup::milliseconds_to_poll() const {
    const int max_wait = leader_exit_ ? kLookForInterruptEvery : kLookForExitEvery;
    if (!deadline_) return max_wait;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(*deadline_ - Clock::now()).count();
    return static_cast<int>(std::clamp<long long>(left, 0, max_wait));
}

void ProcessGroup::collect(FileDescriptor& stream, std::string& text) {
    char block[1 << 16];
    while (stream) {
        const ssize_t count = retry_interrupted([&] { return ::read(stream.get(), block, sizeof block); });
        if (count < 0 && errno == EAGAIN) return;
        if (count <= 0) {
            stream.close();
            return;
        }
        const std::uint64_t remaining = output_bytes_ - result_.output.size() - result_.error_output.size();
        text.append(block, std::min<std::uint64_t>(static_cast<std::uint64_t>(count), remaining));
        if (static_cast<std::uint64_t>(count) > remaining) {
            result_.output_exceeded = true;
            stream.close();
        }
    }
}

bool ProcessGroup::leader_exited() const {
    siginfo_t info{};
    ::waitid(P_PID, static_cast<id_t>(leader_), &info, WEXITED | WNOHANG | WNOWAIT);
    return info.si_pid == leader_;
}

/// The leader is reaped last: until then its number, and so the group's, cannot belong to anybody else.
void ProcessGroup::kill_and_reap() {
    ::kill(-leader_, SIGKILL);
    int status = 0;
    retry_interrupted([&] { return ::waitpid(leader_, &status, 0); });
    result_.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    if (result_.exit_code == 128 + SIGXCPU) result_.timed_out = result_.processor_time_used_up = true;
    leader_ = 0;
}

}  // namespace dynlab::inline platform
