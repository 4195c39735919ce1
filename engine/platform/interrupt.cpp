#include "platform/interrupt.h"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <iterator>
#include <string_view>

#include "platform/error.h"
#include "platform/files/ends_with_program.h"

namespace dynlab::inline platform {
namespace {

volatile std::sig_atomic_t interrupt_count = 0;
volatile std::sig_atomic_t ending_count = 2;
volatile std::sig_atomic_t termination = 0;  // the signal
volatile std::sig_atomic_t ends_unhandled = 0;
std::atomic<int> slow_endings{0};
int open_scopes = 0;  // scopes are made by the main thread only

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
struct sigaction actions_before[std::size(kSignals)], alarm_action_before;

constexpr suseconds_t kMicrosecondsToHear = 400'000;

void set_alarm(suseconds_t microseconds) {
    const itimerval timer{{0, 0}, {0, microseconds}};
    ::setitimer(ITIMER_REAL, &timer, nullptr);
}

void count_interrupt(int number) {
    interrupt_count = interrupt_count + 1;
    if (number != SIGINT) termination = number;
    if (interrupt_count < ending_count) {
        if (ends_unhandled != 0) set_alarm(kMicrosecondsToHear);
        return;
    }
    ::signal(number, SIG_DFL);
    ::raise(number);  // held back until this handler returns, then ends the program
}

/// Whatever the program was doing, locks and memory may be in any state here: system calls only.
void end_unheard(int) {
    if (ends_unhandled == 0) return;
    if (slow_endings > 0) return set_alarm(kMicrosecondsToHear);
    end_what_ends_with_program();
    constexpr std::string_view kLastWords =
        "\r\x1B[Kdynlab: interrupted\n";  // on a terminal behind what shows the progress
    const std::size_t from = ::isatty(STDERR_FILENO) == 1 ? 0 : kLastWords.find('d');
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kLastWords.data() + from, kLastWords.size() - from);
    pass_on_termination();
    ::_exit(128 + SIGINT);
}

void begin_again(int count_that_ends) {
    set_alarm(0);
    ending_count = count_that_ends;
    interrupt_count = 0;
}

}  // namespace

InterruptScope::InterruptScope(Unhandled unhandled) {
    if (open_scopes++ > 0) return;
    begin_again(2);
    ends_unhandled = unhandled == Unhandled::kEnds ? 1 : 0;
    struct sigaction action {};
    action.sa_handler = count_interrupt;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;  // libraries need not know about interrupted reads; poll() returns all the same
    for (std::size_t i = 0; i < std::size(kSignals); ++i) {
        ::sigaction(kSignals[i], nullptr, &actions_before[i]);
        const bool ignored = kSignals[i] != SIGINT && actions_before[i].sa_handler == SIG_IGN;  // nohup
        if (!ignored) ::sigaction(kSignals[i], &action, nullptr);
    }
    action.sa_handler = end_unheard;
    ::sigaction(SIGALRM, &action, &alarm_action_before);
}

InterruptScope::~InterruptScope() {
    if (--open_scopes > 0) return;
    for (std::size_t i = 0; i < std::size(kSignals); ++i) ::sigaction(kSignals[i], &actions_before[i], nullptr);
    begin_again(2);
    ::sigaction(SIGALRM, &alarm_action_before, nullptr);
}

SlowEnding::SlowEnding() {
    ++slow_endings;
}

SlowEnding::~SlowEnding() {
    --slow_endings;
}

bool interrupted() {
    return interrupt_count > 0;
}

void throw_if_interrupted() {
    if (interrupted()) throw Interrupted();
}

void clear_interrupts(int count_that_ends) {
    ends_unhandled = 0;
    begin_again(count_that_ends);
}

void end_when_terminated() {
    ends_unhandled = 0;
    for (const int number : {SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
}

void pass_on_termination() {
    if (termination == 0) return;
    ::signal(termination, SIG_DFL);
    ::raise(termination);
}

}  // namespace dynlab::inline platform
