#pragma once
#include <sys/types.h>

namespace dynlab::inline workflow {

/// Ends the threads among which calculations are divided; they begin again by themselves. To be called before fork:
/// a copy of the process has no other thread than its first, and would wait for them.
void end_worker_threads();

/// A copy of this process from where it is made. It ends with this one at the latest, and with the object here.
class ProcessCopy {
  public:
    ProcessCopy();  ///< throws EnvironmentError
    ~ProcessCopy();
    ProcessCopy(const ProcessCopy&) = delete;
    ProcessCopy& operator=(const ProcessCopy&) = delete;

    bool is_copy() const { return process_ == 0; }  ///< on which side one is
    void wait();                                    ///< until it exits

  private:
    pid_t process_ = -1;
};

}  // namespace dynlab::inline workflow
