#pragma once

namespace dynlab::inline platform {

/// Ctrl-C as a flag. While one of these lives, SIGINT sets the flag instead of ending the program; a second
/// SIGINT within the same scope ends it at once. Long work polls interrupted() (async-signal-safe, cheap). SIGTERM and
/// SIGHUP do the same, so that temporary files go when a program is ended from outside.
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

/// For a program that waits for its user (the prompt): SIGTERM and SIGHUP end it at once, as if there were no scope.
void end_when_terminated();

/// Ends the program by the signal that the scope held back, if that was SIGTERM or SIGHUP: for main, when all is
/// undone.
void pass_on_termination();

}  // namespace dynlab::inline platform
