#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "course/grading/grading.h"
#include "course/intake/staging.h"
#include "workflow/shares/coordinator.h"
#include "workflow/shares/worker.h"

namespace dynlab::inline course {

/// A file on its way, by its path in its folder; a folder's path ends in "/".
struct SentFile {
    std::string path, bytes;
};

/// A submission on its way.
struct SentSubmission {
    std::string name;
    std::vector<SentFile> files;  ///< of the folder that holds its analysis.lua
    GradingRules::GroupSeed seed;
    bool of_notebook = false;
    bool linked_data = false;  ///< its data/ is the link to the course's, as in the copy that students get
};
SentSubmission sent_submission(const std::string& name, const StagedWork& staged, const GradingRules::GroupSeed& seed);

/// Submissions of a class that workers run and judge (workflow/shares); what they give equals what this process would.
/// Threads may share one. Throws EnvironmentError for a spool of other work and where no worker can be started.
class SharedGrading {
  public:
    /// `rules` have tried the worked solution.
    SharedGrading(const GradingRequest& request, const GradingRules& rules);

    int hands() const { return hands_; }  ///< jobs at once, as they were asked for
    bool has_room() { return coordinator_->has_room(); }
    /// To be run and judged, together as far as nothing goes wrong.
    struct Given {
        std::size_t index = 0;
        std::string fingerprint, of_runs, language;  ///< for who gave it, when it comes back
        Message remark;
        SentSubmission submission;
    };
    void give(std::vector<Given> batch);

    struct Done {
        Given given;             ///< without its files
        CheckedSubmission work;  ///< as GradingRules::work_in gives it
        Grade grade;             ///< as GradingRules::judged gives it
        Message trouble;         ///< why there is neither; empty where there is
    };
    struct DoneBatch {
        std::string key;
        std::vector<Done> submissions;
    };
    /// What is done by now; what a worker left of a batch is given out again. Where a job was given up, each of its
    /// submissions is given out by itself first.
    std::optional<DoneBatch> done();
    /// What became of these is written down: the result need not stay in the spool.
    void forget(const std::string& key) { coordinator_->forget(key); }
    bool wait() { return coordinator_->wait(); }  ///< false where nothing is out

    void conclude() { coordinator_->conclude(); }
    Message sight() { return coordinator_->sight(); }
    std::vector<Message> notes() { return coordinator_->complaints(); }

  private:
    void give_at_once(std::vector<Given> batch);

    std::unique_ptr<Coordinator> coordinator_;
    std::string common_;
    int hands_ = 1;
    std::mutex mutex_;
    std::map<std::string, std::vector<Given>> out_;  ///< by the keys of their jobs
};

/// What a worker does with such a job.
ShareWork grading_share();

}  // namespace dynlab::inline course
