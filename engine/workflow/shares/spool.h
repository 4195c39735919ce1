#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "platform/keys/session_key.h"
#include "platform/system_call.h"
#include "workflow/shares/heartbeat.h"

namespace dynlab::inline workflow {

/// What a spool is made for; workers and coordinator hold each other to it.
struct SpoolIdentity {
    std::string id;         ///< of this spool, drawn at random
    std::string purpose;    ///< "grade 04_estimators into /home/ada/marks": another purpose needs another spool
    std::string program;    ///< shared_identity() (shared_identity.h) of whoever began it
    std::string isolation;  ///< level that its jobs need (isolation_name); empty where they need none
    int lease_ms = 30000;   ///< a worker that shows no sign of life for so long is given up
    int grace_ms = 120000;  ///< workers end when the coordinator shows none for so long
};

/// One piece of work.
struct ShareJob {
    std::string kind;    ///< which function does it: "grade", "study"
    std::string common;  ///< name of what it shares with others (Spool::put_common)
    std::string title;   ///< for people: a submission's name
    std::string bytes;
};

/// What came of it: bytes, or why there are none.
struct ShareResult {
    std::string worker;     ///< who did it
    std::string node;       ///< where
    std::string signature;  ///< of its key over spool, job and what follows
    std::string bytes;
    std::optional<Message> trouble;
};

/// A job's place in the folder: its name says how many workers it has lost.
struct JobFile {
    std::string key;  ///< hash of its content under the session's key
    int losses = 0;
    std::string text() const;  ///< "KEY.LOSSES"
};

/// A folder through which one coordinator and any number of workers, on any machines that see it, share work. All that
/// goes on in it is files that appear whole and are renamed:
///
///     spool.json           for people, and where the key lies (never here)
///     identity             SpoolIdentity
///     coordinator          its heartbeat; workers/ID those of the workers, keys/ID their public keys
///     jobs/KEY.N           waiting, N workers lost so far; suspects/KEY.N: to be judged by the coordinator first
///     leases/KEY.N@ID.H    being done by hand H of a worker, as long as its heart beats
///     done/KEY.N           its result is to be looked at;  failed/KEY.N: given up
///     results/KEY, common/NAME, logs/KEY.N.txt, slurm (note())
///     stop                 workers give back what they have and end
///
/// Everything but spool.json and the logs is sealed with the session's key for its place: who can only write here can
/// hinder, but neither read nor forge, nor lead the processes out of the folder by links (platform/files/plain_file.h).
/// Logs are what programs said on standard error; the folder is its owner's only.
/// A job done twice gives the same result twice. No clock of any machine is compared with that of another.
class Spool {
  public:
    /// Makes the folder, or opens one of the same purpose, program and key, to go on. One of another program is cleared
    /// when the purpose and the key are ours. Throws EnvironmentError for another's spool, a folder of another user,
    /// and one that others may look into.
    static Spool begin(const std::filesystem::path& folder, const std::filesystem::path& key_file,
                       SpoolIdentity identity);
    /// As workers do. Throws EnvironmentError where there is none.
    static Spool open(const std::filesystem::path& folder);

    const std::filesystem::path& folder() const { return folder_; }
    const SpoolIdentity& identity() const { return identity_; }
    bool exists() const;  ///< it is still there
    void remove();        ///< with all that is in it, and the key
    bool stopped() const;
    void stop() const;
    void unstop() const;

    // The coordinator's side.
    std::string key_of(const ShareJob& job) const;
    void put(const std::string& key, const ShareJob& job, int losses = 0) const;
    std::string put_common(const std::string& bytes) const;  ///< returns its name
    /// The keys in one of the folders, with losses; the greatest where a key is there twice.
    std::map<std::string, int> listed(const char* folder) const;
    std::set<std::string> results() const;
    /// A result whose signature is that of a worker which this session knows; nothing for any other bytes.
    std::optional<ShareResult> result(const std::string& key) const;
    void refuse_result(const std::string& key) const;  ///< removes it, and has the job done again
    void accept_result(const std::string& key) const;  ///< the job is not needed any more
    void forget(const std::string& key) const;         ///< nor its result
    void give_up(const JobFile& job) const;            ///< from suspects
    void clear_of_suspicion(const JobFile& job) const;
    void retry_failed() const;                                       ///< all that was given up is waiting again
    std::string logged(const JobFile& job, std::size_t most) const;  ///< the first `most` bytes of its log
    /// What an engine must know when it goes on.
    void note(const std::string& name, const std::string& bytes) const;
    std::optional<std::string> noted(const std::string& name) const;

    // The worker's side.
    struct Lease {
        JobFile job;
        std::string worker;  ///< ID.HAND
        std::string text() const;
    };
    struct Claimed {
        Lease lease;
        ShareJob job;
    };
    std::optional<Claimed> claim(const std::string& worker) const;
    std::optional<std::string> common(const std::string& name) const;
    void finish(const Lease& lease,
                const ShareResult& result) const;  ///< throws EnvironmentError: the disk is full, ..
    void give_back(const Lease& lease) const;
    void lose(const Lease& lease) const;  ///< whoever did it is gone
    std::vector<Lease> leases() const;
    FileDescriptor log_of(const JobFile& job) const;  ///< to write at its end; none where that cannot be
    void drop_empty_log(const JobFile& job) const;
    std::string signed_text(const std::string& key, const ShareResult& result) const;

    // Heartbeats.
    void admit(const std::string& worker, const std::string& public_key) const;
    void tell(const std::string& worker, const WorkerStatus& status) const;
    std::map<std::string, WorkerStatus> workers() const;
    std::optional<WorkerStatus> worker(const std::string& id) const;
    void tell(const CoordinatorStatus& status) const;
    std::optional<CoordinatorStatus> coordinator() const;

  private:
    Spool(std::filesystem::path folder, SessionKey key) : folder_(std::move(folder)), key_(std::move(key)) {}
    void make_folders() const;
    bool move(const std::filesystem::path& from, const std::filesystem::path& to) const;
    std::optional<std::string> read_sealed(const std::filesystem::path& file, const std::string& place) const;
    void write_sealed(const std::filesystem::path& file, const std::string& place, const std::string& bytes) const;
    void overwrite_sealed(const std::filesystem::path& file, const std::string& place, std::string bytes) const;

    std::filesystem::path folder_, key_file_;
    SessionKey key_;
    SpoolIdentity identity_;
};

/// How often jobs may be lost before they are suspected: twice they are simply tried again.
constexpr int kTries = 3;

}  // namespace dynlab::inline workflow
