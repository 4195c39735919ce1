#include "platform/confinement.h"

#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <memory>

#include "platform/error.h"
#include "platform/process_group.h"
#include "platform/system_call.h"
#include "platform/utf8_locale.h"

namespace dynlab::inline platform {
namespace {

bool confined = false;

void limit(int resource, rlim_t max_value) {
    const rlimit both{max_value, max_value};
    if (::setrlimit(static_cast<__rlimit_resource>(resource), &both) != 0)
        throw EnvironmentError("cannot limit the resources of a script: {}", system_reason(errno));
}

void expect_rule_added(int result) {
    if (result < 0) throw EnvironmentError("cannot filter the system calls of a script: {}", system_reason(-result));
}

void refuse_calls(scmp_filter_ctx filter, std::initializer_list<int> calls) {
    for (const int call : calls) expect_rule_added(::seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), call, 0));
}

void filter_system_calls() {
    const std::unique_ptr<void, void (*)(scmp_filter_ctx)> filter(::seccomp_init(SCMP_ACT_ALLOW), ::seccomp_release);
    if (!filter) throw EnvironmentError("cannot create the system call filter (seccomp) of a script");
    refuse_calls(filter.get(), {SCMP_SYS(execve), SCMP_SYS(execveat), SCMP_SYS(fork), SCMP_SYS(vfork)});
    // clone makes threads or processes; clone3 hides which in memory, and the C library then falls back on clone.
    expect_rule_added(::seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), SCMP_SYS(clone), 1,
                                         SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0)));
    expect_rule_added(::seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0));
    refuse_calls(filter.get(),
                 {SCMP_SYS(socket), SCMP_SYS(socketpair), SCMP_SYS(connect), SCMP_SYS(bind), SCMP_SYS(listen),
                  SCMP_SYS(accept), SCMP_SYS(accept4), SCMP_SYS(sendto), SCMP_SYS(sendmsg)});
    refuse_calls(filter.get(),
                 {SCMP_SYS(kill), SCMP_SYS(tkill), SCMP_SYS(pidfd_send_signal), SCMP_SYS(pidfd_open),
                  SCMP_SYS(pidfd_getfd), SCMP_SYS(rt_sigqueueinfo), SCMP_SYS(rt_tgsigqueueinfo), SCMP_SYS(ptrace),
                  SCMP_SYS(kcmp), SCMP_SYS(process_vm_readv), SCMP_SYS(process_vm_writev), SCMP_SYS(process_madvise),
                  SCMP_SYS(setpriority), SCMP_SYS(setrlimit)});
    // Reading limits is harmless, and the C library does.
    expect_rule_added(::seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), SCMP_SYS(prlimit64), 1,
                                         SCMP_A2(SCMP_CMP_NE, static_cast<scmp_datum_t>(0))));
    // abort() signals the own process.
    expect_rule_added(::seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), SCMP_SYS(tgkill), 1,
                                         SCMP_A0(SCMP_CMP_NE, static_cast<scmp_datum_t>(::getpid()))));
    refuse_calls(filter.get(),
                 {SCMP_SYS(mount), SCMP_SYS(umount2), SCMP_SYS(pivot_root), SCMP_SYS(chroot), SCMP_SYS(unshare),
                  SCMP_SYS(setns), SCMP_SYS(fsopen), SCMP_SYS(fsconfig), SCMP_SYS(fsmount), SCMP_SYS(fspick),
                  SCMP_SYS(move_mount), SCMP_SYS(open_tree), SCMP_SYS(mount_setattr), SCMP_SYS(quotactl)});
    refuse_calls(filter.get(),
                 {SCMP_SYS(symlink), SCMP_SYS(symlinkat), SCMP_SYS(link), SCMP_SYS(linkat), SCMP_SYS(mknod),
                  SCMP_SYS(mknodat), SCMP_SYS(chown), SCMP_SYS(fchown), SCMP_SYS(lchown), SCMP_SYS(fchownat),
                  SCMP_SYS(name_to_handle_at), SCMP_SYS(open_by_handle_at), SCMP_SYS(fanotify_init)});
    refuse_calls(filter.get(),
                 {SCMP_SYS(setuid), SCMP_SYS(setgid), SCMP_SYS(setreuid), SCMP_SYS(setregid), SCMP_SYS(setresuid),
                  SCMP_SYS(setresgid), SCMP_SYS(setfsuid), SCMP_SYS(setfsgid), SCMP_SYS(setgroups), SCMP_SYS(capset)});
    // What outlives the process or is shared with others.
    refuse_calls(filter.get(), {SCMP_SYS(shmget), SCMP_SYS(shmat), SCMP_SYS(shmctl), SCMP_SYS(semget), SCMP_SYS(semop),
                                SCMP_SYS(semtimedop), SCMP_SYS(semctl), SCMP_SYS(msgget), SCMP_SYS(msgsnd),
                                SCMP_SYS(msgrcv), SCMP_SYS(msgctl), SCMP_SYS(mq_open), SCMP_SYS(mq_unlink),
                                SCMP_SYS(keyctl), SCMP_SYS(add_key), SCMP_SYS(request_key)});
    refuse_calls(filter.get(),
                 {SCMP_SYS(bpf), SCMP_SYS(perf_event_open), SCMP_SYS(userfaultfd), SCMP_SYS(io_uring_setup),
                  SCMP_SYS(io_uring_enter), SCMP_SYS(io_uring_register), SCMP_SYS(personality), SCMP_SYS(modify_ldt),
                  SCMP_SYS(ioprio_set), SCMP_SYS(vmsplice), SCMP_SYS(move_pages), SCMP_SYS(migrate_pages)});
    refuse_calls(filter.get(),
                 {SCMP_SYS(kexec_load), SCMP_SYS(kexec_file_load), SCMP_SYS(init_module), SCMP_SYS(finit_module),
                  SCMP_SYS(delete_module), SCMP_SYS(reboot), SCMP_SYS(swapon), SCMP_SYS(swapoff), SCMP_SYS(sethostname),
                  SCMP_SYS(setdomainname), SCMP_SYS(settimeofday), SCMP_SYS(clock_settime), SCMP_SYS(adjtimex),
                  SCMP_SYS(clock_adjtime), SCMP_SYS(syslog), SCMP_SYS(acct), SCMP_SYS(vhangup), SCMP_SYS(iopl),
                  SCMP_SYS(ioperm)});
    expect_rule_added(::seccomp_load(filter.get()));
}

void allow(scmp_filter_ctx filter, std::initializer_list<int> calls) {
    for (const int call : calls) expect_rule_added(::seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0));
}

}  // namespace

void limit_process(const ProcessLimits& limits) {
    limit(RLIMIT_CORE, 0);
    limit_processor_time(std::chrono::seconds(limits.cpu_seconds));
    limit(RLIMIT_FSIZE, limits.file_bytes);
    limit(RLIMIT_NOFILE, static_cast<rlim_t>(limits.open_files));
#ifndef __SANITIZE_ADDRESS__  // the address sanitizer reserves more addresses than any limit leaves
    limit(RLIMIT_AS, limits.memory_bytes);
#endif
}

void confine_process(const ProcessLimits& limits) {
    limit_process(limits);
    refuse_harmful_calls();
}

void hide_memory() {
    if (::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0)
        throw EnvironmentError("cannot protect the memory of a process from other processes: {}", system_reason(errno));
}

void refuse_harmful_calls() {
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        throw EnvironmentError("cannot drop privileges: {}", system_reason(errno));
    filter_system_calls();
    confined = true;
}

void confine_to_memory() {
    { const Utf8Locale read_from_its_file; }
    const std::unique_ptr<void, void (*)(scmp_filter_ctx)> filter(::seccomp_init(SCMP_ACT_ERRNO(EPERM)),
                                                                  ::seccomp_release);
    if (!filter) throw EnvironmentError("cannot create the system call filter (seccomp) of a process");
    allow(filter.get(), {SCMP_SYS(brk), SCMP_SYS(mmap), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(mprotect),
                         SCMP_SYS(madvise), SCMP_SYS(futex), SCMP_SYS(sched_yield)});
    allow(filter.get(),
          {SCMP_SYS(read), SCMP_SYS(pread64), SCMP_SYS(write), SCMP_SYS(lseek), SCMP_SYS(fstat), SCMP_SYS(close)});
    allow(filter.get(), {SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn),
                         SCMP_SYS(sigaltstack), SCMP_SYS(exit), SCMP_SYS(exit_group), SCMP_SYS(restart_syscall)});
    allow(filter.get(), {SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday),
                         SCMP_SYS(time), SCMP_SYS(getrandom), SCMP_SYS(getrusage)});
#ifdef __SANITIZE_ADDRESS__  // which tests through a pipe whether memory can be read
    allow(filter.get(), {SCMP_SYS(pipe), SCMP_SYS(pipe2)});
#endif
    // abort() signals the own process.
    expect_rule_added(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1,
                                         SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(::getpid()))));
    expect_rule_added(::seccomp_load(filter.get()));
    confined = true;
}

bool is_confined() {
    return confined;
}

}  // namespace dynlab::inline platform

#ifdef __SANITIZE_ADDRESS__
/// Asked by the address sanitizer when the process ends: looking for leaks takes system calls that are refused then.
extern "C" int __lsan_is_turned_off() {
    return dynlab::is_confined();
}
#endif
