#include "platform/guarded_call.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>

#include "platform/confinement.h"
#include "platform/error.h"
#include "platform/process_group.h"

namespace dynlab::inline platform {
namespace {

bool guarded_copy = false;

/// Bytes of address space this process has mapped (Linux: first number of /proc/self/statm, in pages).
std::uint64_t mapped_bytes() {
    const FileDescriptor statm(::open("/proc/self/statm", O_RDONLY | O_CLOEXEC));
    char text[64] = {};
    if (!statm || ::read(statm.get(), text, sizeof text - 1) <= 0) return 0;
    return std::strtoull(text, nullptr, 10) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Leaves a guarded copy with its two pipes only, as descriptors 3 and 4, and nothing to print on.
bool keep_only(int output, int error_output) {
    const FileDescriptor nowhere(::open("/dev/null", O_RDWR));
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere.get(), standard);
    // Above all numbers in use first, so that neither copy overwrites the other's source.
    const int output_aside = ::fcntl(output, F_DUPFD, 16), error_aside = ::fcntl(error_output, F_DUPFD, 16);
    if (::dup2(output_aside, 3) != 3 || ::dup2(error_aside, 4) != 4) return false;
    ::close_range(5, ~0u, 0);
    return true;
}

[[noreturn]] void do_guarded_work(const std::function<std::string()>& work, std::uint64_t memory_bytes,
                                  const GuardLimits& limits) {
    limit_memory(memory_bytes);
    limit_processor_time(limits.time.processor);
    guarded_copy = limits.one_task;
    try {
        refuse_harmful_calls();
        const std::string result = work();
        ::_exit(write_all(3, result.data(), result.size()) ? 0 : 2);
    } catch (const std::exception& error) {
        const std::string message = error.what();
        write_all(4, message.data(), message.size());
    }
    ::_exit(1);
}

/// In a process that may be lost, and cannot start another.
ChildResult unguarded(const std::function<std::string()>& work) {
    ChildResult result;
    result.exit_code = 0;
    try {
        result.output = work();
    } catch (const std::exception& error) {
        result.exit_code = 1;
        result.error_output = error.what();
    }
    return result;
}

}  // namespace

ChildResult run_guarded(const std::function<std::string()>& work, const GuardLimits& limits) {
    if (is_confined()) return unguarded(work);
    Pipe output, error_output;
    const std::uint64_t memory_bytes = mapped_bytes() + limits.memory_bytes;
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child < 0) throw EnvironmentError("cannot start a guarded process: {}", system_reason(errno));
    if (child == 0) {
        if (!become_group_leader(parent) || !keep_only(output.write_end.get(), error_output.write_end.get())) {
            ::_exit(127);
        }
        do_guarded_work(work, memory_bytes, limits);
    }
    output.write_end.close();
    error_output.write_end.close();
    return ProcessGroup(child, std::move(output.read_end), std::move(error_output.read_end),
                        ProcessGroup::Limits{limits.time.clock(), limits.time.processor, limits.output_bytes})
        .wait();
}

bool is_guarded_copy() {
    return guarded_copy;
}

}  // namespace dynlab::inline platform
