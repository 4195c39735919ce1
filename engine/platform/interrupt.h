#pragma once

namespace dynlab::inline platform {

/// Ctrl-C as a flag. While one of these lives, SIGINT sets the flag instead of ending the program; a second
/// SIGINT within the same scope ends it at once. Long work polls interrupted() (async-signal-safe, cheap).
class InterruptScope {
  public:
    InterruptScope();
    ~InterruptScope();
    InterruptScope(const InterruptScope&) = delete;
    InterruptScope& operator=(const InterruptScope&) = delete;
};

bool interrupted();
void throw_if_interrupted();  ///< throws Interrupted

/// For a program that goes on after the work that was interrupted (the prompt): the flag is down again, and only so
/// many SIGINT without another call end the program.
void forget_interrupts(int count_that_ends = 2);

}  // namespace dynlab::inline platform
