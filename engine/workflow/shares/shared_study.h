#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "platform/locks/file_lock.h"
#include "scripting/memoized_calls/shared_pieces.h"
#include "workflow/shares/coordinator.h"
#include "workflow/shares/worker.h"

namespace dynlab::inline workflow {

/// A script whose montecarlo and srivcstruc are shared out (scripting/memoized_calls/shared_pieces.h). It runs from top
/// to bottom here and on every worker; a call of these is made in parts by whoever is there, and all go on with the
/// same whole of it.
class SharedStudy : public SharedPieces {
  public:
    struct Request {
        std::filesystem::path script;
        std::uint32_t seed = 1;
        std::string on;               ///< see worker_engine.h
        std::filesystem::path spool;  ///< folder
        std::filesystem::path key;    ///< where the session's key lies, not in the spool
        int lease_seconds = 30;
    };
    /// Throws EnvironmentError for a spool of other work, and where the same study is under way.
    explicit SharedStudy(const Request& request);

    std::vector<std::string> all(const std::string& what, std::size_t pieces, const Some& some) override;

    void conclude() { coordinator_->conclude(); }
    std::vector<Message> notes() { return coordinator_->complaints(); }

  private:
    FileLock lock_;  ///< two at once would take each other's parts
    std::unique_ptr<Coordinator> coordinator_;
    std::string common_;
    std::vector<std::vector<std::string>> calls_;  ///< keys of the parts of each, as far as they were made
};

/// What a worker does with such a job.
ShareWork study_share();

}  // namespace dynlab::inline workflow
