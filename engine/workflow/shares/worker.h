#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "platform/box.h"
#include "workflow/shares/spool.h"

namespace dynlab::inline workflow {

/// What a hand tells its worker, in memory that both see.
struct HandReport;

/// One process of a worker, which does one job at a time.
class WorkingHand {
  public:
    WorkingHand(const Spool& spool, std::string worker, std::string node, const std::string& seed, HandReport& report);

    /// Waits for a job. Nothing: the work is over, or this process is asked to end. Before a job is taken the machine
    /// is looked at: as long as it has no room for temporary files none is.
    std::optional<Spool::Claimed> next();
    /// Does a job by `work` and hands in what it returns, or what it threw, as the job's trouble. A result counts only
    /// where the machine is still well after it, and nobody asked this process to end; else the job is given back, in
    /// the second case with Interrupted thrown.
    void finish(const Spool::Claimed& job, const std::function<std::string()>& work);
    /// For the next one who asks.
    void take_back(Spool::Claimed job) { waiting_ = std::move(job); }

    const Spool& spool() const { return spool_; }
    const std::string& node() const { return node_; }

  private:
    void hand_in(const Spool::Claimed& job, ShareResult result);
    bool must_end() const;
    void wait_a_little(int& waited) const;

    const Spool& spool_;
    std::string worker_, node_, seed_;
    HandReport& report_;
    std::optional<Spool::Claimed> waiting_;
};

/// Does a job, and further ones of its kind if it likes, by WorkingHand::finish.
using ShareWork = std::function<void(WorkingHand&, Spool::Claimed)>;

struct WorkerOptions {
    int hands = 1;                           ///< processes; as many jobs at once
    std::string node;                        ///< as it is called in messages
    std::map<std::string, ShareWork> kinds;  ///< of jobs
};

/// Works for a spool until it is stopped or gone, its coordinator has been silent for the grace time, or SIGTERM comes:
/// then what is being done is given back. The hands are processes of their own: one that a job crashed is replaced, and
/// the job counted as lost. Returns why this machine must not work there ("another version of dynlab ..."), or nothing.
/// No thread may run when it is called.
std::optional<Message> work_for(const Spool& spool, const WorkerOptions& options);

/// What the machine is called: Slurm's name of the node, else the host's.
std::string name_of_node();

}  // namespace dynlab::inline workflow
