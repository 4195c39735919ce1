#include "platform/interrupt.h"

#include <csignal>

#include "platform/error.h"

namespace dynlab::inline platform {
namespace {

volatile std::sig_atomic_t interrupt_count = 0;
volatile std::sig_atomic_t ending_count = 2;
int open_scopes = 0;  // scopes are made by the main thread only
struct sigaction action_before;

void count_interrupt(int) {
    interrupt_count = interrupt_count + 1;
    if (interrupt_count < ending_count) return;
    ::signal(SIGINT, SIG_DFL);
    ::raise(SIGINT);  // held back until this handler returns, then ends the program
}

}  // namespace

InterruptScope::InterruptScope() {
    if (open_scopes++ > 0) return;
    forget_interrupts();
    struct sigaction action {};
    action.sa_handler = count_interrupt;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;  // libraries need not know about interrupted reads; poll() returns all the same
    ::sigaction(SIGINT, &action, &action_before);
}

InterruptScope::~InterruptScope() {
    if (--open_scopes > 0) return;
    ::sigaction(SIGINT, &action_before, nullptr);
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

}  // namespace dynlab::inline platform
