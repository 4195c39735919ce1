#pragma once
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "platform/interrupt.h"
#include "workflow/shares/heartbeat.h"
#include "workflow/shares/spool.h"
#include "workflow/shares/worker_engine.h"

namespace dynlab::inline workflow {

/// Puts jobs into a spool, watches over those who do them, and collects what comes of them. Threads may share one.
class Coordinator {
  public:
    /// `engine` may be none: then workers are started by somebody else.
    Coordinator(Spool spool, std::unique_ptr<WorkerEngine> engine);
    /// Ends what it started. The spool stays, for a coordinator that goes on, unless conclude() was called.
    ~Coordinator();
    Coordinator(const Coordinator&) = delete;
    Coordinator& operator=(const Coordinator&) = delete;

    /// A job that is there already, or that was done, is not put again. Returns its key.
    std::string put(const ShareJob& job);
    std::string put_common(const std::string& bytes) { return spool_.put_common(bytes); }
    /// Whether another job should be put now: few wait, so that a spool stays small, and never too few.
    bool has_room();

    struct Finished {
        std::string key;
        std::optional<ShareResult> result;  ///< nothing: given up
        Message trouble;                    ///< then why, with its log
    };
    /// One that is done, if there is any now.
    std::optional<Finished> finished();
    /// Waits until there may be one; false when no job is out. Throws Interrupted, and what an engine threw.
    bool wait();
    /// What was done with a result is kept elsewhere: it need not stay in the spool for who goes on.
    void forget(const std::string& key);
    /// All is done: workers end, the spool goes.
    void conclude();

    Message sight();                    ///< "2 nodes, 3.1/s, 1 given up"
    std::vector<Message> complaints();  ///< for the user, since the last call

  private:
    void watch();
    void look_around();
    void collect_results();
    void take_back_leases();
    void judge_suspects();
    void report_vanished();
    void watch_workers();
    void count_losses();
    void count_losses(const std::string& key, int losses);
    void complain(const Message& message);
    void leave();
    bool some_worker_lives();
    void end_workers();
    bool is_silent(const HeartbeatWatch& heart) const;
    bool is_guilty(int losses) const;
    Message reason_to_give_up(const JobFile& job) const;

    SlowEnding slow_ending_;
    Spool spool_;
    std::unique_ptr<WorkerEngine> engine_;
    std::mutex mutex_;
    std::condition_variable news_, news_of_end_;
    std::set<std::string> out_;  ///< keys whose end is awaited
    std::deque<Finished> finished_;
    std::map<std::string, HeartbeatWatch> hearts_;
    std::map<std::string, WorkerStatus> alive_;
    std::map<std::string, int> losses_;
    std::map<std::string, int> missing_;  ///< how often a key was found nowhere
    std::vector<Message> complained_;     ///< ever
    std::vector<Message> complaints_;     ///< since they were asked for
    CoordinatorStatus status_;
    HeartbeatWatch::Clock::time_point began_ = HeartbeatWatch::Clock::now(), next_tending_{}, next_start_{},
                                      next_roll_call_{};
    std::size_t done_here_ = 0;
    bool ending_ = false;
    std::exception_ptr failure_;
    std::thread watch_;  ///< looks around; what an engine starts may end with the thread that started it
};

}  // namespace dynlab::inline workflow
