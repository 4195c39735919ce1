#pragma once

namespace dynlab::inline platform {

/// Ctrl-C as a flag. While one of these lives, SIGINT sets the flag instead of ending the program; a second
/// SIGINT within the same scope ends it at once. Long work polls interrupted() (async-signal-safe, cheap). SIGTERM and
/// SIGHUP do the same, so that temporary files go when a program is ended from outside.
class InterruptScope {
  public:
    /// What happens 0.4 s after the first signal, where the program is still there: calls of libraries
    /// and of Lua's own functions cannot look at the flag. kEnds: it ends, with what EndsWithProgram names, by exit
    /// code 130 or the signal.
    enum class Unhandled { kGoesOn, kEnds };
    explicit InterruptScope(Unhandled unhandled = Unhandled::kGoesOn);
    ~InterruptScope();
    InterruptScope(const InterruptScope&) = delete;
    InterruptScope& operator=(const InterruptScope&) = delete;
};

/// While an object of this class exists, an interrupted program is not ended after the usual delay: it has workers to
/// notify, or a user to serve.
class SlowEnding {
  public:
    SlowEnding();
    ~SlowEnding();
    SlowEnding(const SlowEnding&) = delete;
    SlowEnding& operator=(const SlowEnding&) = delete;
};

bool interrupted();
void throw_if_interrupted();  ///< throws Interrupted

/// For a program that goes on after the work that was interrupted (the prompt): the flag is down again, and only so
/// many SIGINT without another call end the program; from now on it does not end for being still there.
void clear_interrupts(int count_that_ends = 2);

/// For a program that waits for its user (the prompt): SIGTERM and SIGHUP end it at once, as if there were no scope,
/// and it does not end for being still there after Ctrl-C.
void end_when_terminated();

/// Ends the program by the signal that the scope held back, if that was SIGTERM or SIGHUP: for main, when all is
/// undone.
void pass_on_termination();

}  // namespace dynlab::inline platform
