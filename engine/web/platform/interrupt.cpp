#include "platform/interrupt.h"

// A page stops work by ending the worker that does it.
namespace dynlab::inline platform {

InterruptScope::InterruptScope(Unhandled) {}
InterruptScope::~InterruptScope() = default;
SlowEnding::SlowEnding() = default;
SlowEnding::~SlowEnding() = default;
bool interrupted() {
    return false;
}
void throw_if_interrupted() {}
void clear_interrupts(int) {}
void end_when_terminated() {}
void pass_on_termination() {}

}  // namespace dynlab::inline platform
