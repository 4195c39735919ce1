#pragma once
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "workflow/shares/spool.h"

namespace dynlab::inline workflow {

/// What starts workers, and where; an engine knows nothing of what they do.
class WorkerEngine {
  public:
    virtual ~WorkerEngine() = default;
    /// Called about once a second: starts what is missing. `alive`: workers whose heart beats. Throws EnvironmentError
    /// or MissingProgram where nothing can be started, with the remedy.
    virtual void tend(const std::map<std::string, WorkerStatus>& alive) = 0;
    /// What it started is not needed any more; returns when all of it is gone, or cannot be reached.
    virtual void end() = 0;
    /// Sentences for the user, about what could not be started beside what was; each once.
    virtual std::vector<Message> complaints() { return {}; }
    /// Workers at once, as they were asked for.
    virtual int wanted() const = 0;
};

/// How workers are called, by whatever engine.
struct WorkerCommand {
    std::vector<std::string> words;  ///< dynlab work SPOOL, with what they need of the environment before it
    int hands = 1;
    /// What one job may take, for engines that must ask for it.
    std::uint64_t memory_bytes = std::uint64_t{2} << 30;
    std::chrono::seconds longest_job{600};
};

/// The call that works for this spool with this program: `env DYNLAB_HOME=... dynlab work SPOOL`.
std::vector<std::string> worker_words(const std::filesystem::path& spool);

/// Quoted for a shell.
std::string shell_words(const std::vector<std::string>& words);

/// "processes:4", "parallel:2/alpha,beta", "slurm:partition=short,tasks=8": throws EnvironmentError for other words.
std::unique_ptr<WorkerEngine> engine_of(const std::string& words, const Spool& spool, WorkerCommand command);

std::unique_ptr<WorkerEngine> hosts_by_parallel(const std::string& hosts, WorkerCommand command);
std::unique_ptr<WorkerEngine> slurm_tasks(const std::string& options, const Spool& spool, WorkerCommand command);

}  // namespace dynlab::inline workflow
