#include "platform/interrupt.h"

#include <csignal>
#include <iterator>

#include "platform/error.h"

namespace dynlab::inline platform {
namespace {

volatile std::sig_atomic_t interrupt_count = 0;
volatile std::sig_atomic_t ending_count = 2;
volatile std::sig_atomic_t termination = 0;  // the signal
int open_scopes = 0;                         // scopes are made by the main thread only

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
struct sigaction actions_before[std::size(kSignals)];

void count_interrupt(int number) {
    interrupt_count = interrupt_count + 1;
    if (number != SIGINT) termination = number;
    if (interrupt_count < ending_count) return;
    ::signal(number, SIG_DFL);
    ::raise(number);  // held back until this handler returns, then ends the program
}

}  // namespace

InterruptScope::InterruptScope() {
    if (open_scopes++ > 0) return;
    forget_interrupts();
    struct sigaction action {};
    action.sa_handler = count_interrupt;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;  // libraries need not know about interrupted reads; poll() returns all the same
    for (std::size_t i = 0; i < std::size(kSignals); ++i) {
        ::sigaction(kSignals[i], nullptr, &actions_before[i]);
        const bool ignored = kSignals[i] != SIGINT && actions_before[i].sa_handler == SIG_IGN;  // nohup
        if (!ignored) ::sigaction(kSignals[i], &action, nullptr);
    }
}

InterruptScope::~InterruptScope() {
    if (--open_scopes > 0) return;
    for (std::size_t i = 0; i < std::size(kSignals); ++i) ::sigaction(kSignals[i], &actions_before[i], nullptr);
    forget_interrupts();
}

bool interrupted() {
    return interrupt_count > 0;
}

void throw_if_interrupted() {
    if (interrupted()) throw Interrupted();
}

void forget_interrupts(int count_that_ends) {
    ending_count = count_that_ends;
    interrupt_count = 0;
}

void end_when_terminated() {
    for (const int number : {SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
}

void pass_on_termination() {
    if (termination == 0) return;
    ::signal(termination, SIG_DFL);
    ::raise(termination);
}

}  // namespace dynlab::inline platform
