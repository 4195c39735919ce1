#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline workflow {

/// Who does the parts of some work: Slurm, or GNU parallel on hosts that ssh reaches. Both keep watch over what they
/// start; nothing here does.
struct Machines {
    enum class Kind { kSlurm, kHosts };
    Kind kind = Kind::kHosts;
    std::vector<std::string> words;  ///< options of sbatch; or hosts, "4/alpha" for four parts at once
    int parts = 4;                   ///< that the work is split into
    int rounds = 1;                  ///< how often each part is done, one round after the other
};

/// "slurm[:tasks=N,rounds=N,OPTION=VALUE,...]", "hosts:N/HOST,HOST,..." or "processes:N". Throws EnvironmentError.
Machines machines_in(const std::string& text);

/// What they do: this command (with its folder, its variables DYNLAB_* and its words), but a part of it.
struct WorkInParts {
    std::filesystem::path folder;  ///< for lists and logs, made where there is none; all machines see it
    std::set<int> missing;         ///< parts that are not complete
};

/// Submits one job array, and a job that joins the parts once all tasks succeeded; returns what the user has to know:
/// the jobs, how to follow, cancel and continue. Tasks that Slurm requeues, and commands that a signal ends, run again.
/// Throws EnvironmentError where jobs of an earlier call are still queued or Slurm does not take the work.
Message submit_to_slurm(const Machines& machines, const WorkInParts& work);

/// Does the parts and waits for them. A part that fails is tried on other hosts. Returns what the programs said, such
/// as a host that cannot be reached. Throws EnvironmentError where a part was not done.
std::vector<Message> do_on_hosts(const Machines& machines, const WorkInParts& work);

/// "dynlab grade in --out marks --part 3/8": this command with another of these options.
std::string shown_command(const std::string& option);

/// How many parts the work in this folder is split into: as it was noted last, else 1.
int noted_parts(const std::filesystem::path& folder);
void note_parts(const std::filesystem::path& folder, int parts);

}  // namespace dynlab::inline workflow
