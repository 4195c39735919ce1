#pragma once
#include <cstdint>

namespace dynlab::inline platform {

/// What a process may still take once it is confined.
struct ProcessLimits {
    std::uint64_t memory_bytes = 3ull << 30;  ///< address space
    std::uint64_t file_bytes = 64ull << 20;   ///< of the largest file it writes
    int cpu_seconds = 60;
    int open_files = 128;
};

/// Permanently gives up the rights that untrusted scripts, archives and answers could abuse: starting processes
/// (threads remain), the network, signals to other processes, tracing, mounting, other users' rights, memory and
/// messages shared with other processes, kernel interfaces; and sets the limits. Uses seccomp and setrlimit; seccomp
/// answers EPERM. Call this function when all needed programs are running. Throws EnvironmentError if the kernel
/// refuses.
void confine_process(const ProcessLimits& limits);

/// The part of it that is limits: of this process, and of each that it starts.
void limit_process(const ProcessLimits& limits);

/// The part of it that is no limit: only the system calls are given up. The process counts as confined.
void refuse_harmful_calls();

/// Permanently gives up everything except memory, time and the open files: for code that reads untrusted data and
/// answers on a pipe. Such code must have read its files already; Utf8Locale works. Throws EnvironmentError if the
/// kernel refuses.
void confine_to_memory();

/// From now on no other process without the machine's rights reads or writes the memory of this one, nor that of its
/// copies: not even another of the same user.
void hide_memory();

/// Whether this process gave up starting others.
bool is_confined();

}  // namespace dynlab::inline platform
