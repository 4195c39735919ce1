#include "workflow/shares/worker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <iostream>
#include <thread>
#include <vector>

#include "data_io/values/cbor_values.h"
#include "data_io/values/message_values.h"
#include "platform/error.h"
#include "platform/files/ends_with_program.h"
#include "platform/interrupt.h"
#include "platform/keys/secure_random.h"
#include "platform/locks/abandoned_folders.h"
#include "platform/process_group.h"
#include "platform/signature.h"
#include "platform/system_call.h"
#include "workflow/shares/heartbeat.h"
#include "workflow/shares/shared_identity.h"

namespace dynlab::inline workflow {

struct HandReport {
    std::atomic<std::uint64_t> done{0};

    /// Why it waits; empty: it does not. A message too long for the memory counts as one without a reason.
    void wait_because(const Message& reason) {
        const std::string bytes = reason.empty() ? "" : cbor_of(reason);
        size_ = 0;
        if (bytes.size() > bytes_.size()) return;
        std::memcpy(bytes_.data(), bytes.data(), bytes.size());
        size_ = bytes.size();
    }
    /// A reader may see a message half written, and then reads none.
    Message trouble() const {
        const std::string bytes(bytes_.data(), size_);
        try {
            return bytes.empty() ? Message() : from_cbor<Message>(bytes);
        } catch (const ValueError&) {
            return {};
        }
    }

  private:
    std::array<char, 2000> bytes_{};
    std::atomic<std::size_t> size_{0};
};

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::uint64_t kRoomNeeded = 512ull << 20;  // a submission, unpacked and copied
constexpr auto kShortestWait = 20ms, kLongestWait = 150ms;
constexpr auto kBeat = 1s;
constexpr auto kEndOfHands = 15s;

/// What a job writes to standard error goes to its log while one of these lives; a log without a word is removed.
class ErrorLog {
  public:
    ErrorLog(const Spool& spool, const JobFile& job) : spool_(spool), job_(job), before_(::dup(STDERR_FILENO)) {
        if (const FileDescriptor log = spool_.log_of(job_)) ::dup2(log.get(), STDERR_FILENO);
    }
    ~ErrorLog() {
        ::dup2(before_.get(), STDERR_FILENO);
        spool_.drop_empty_log(job_);
    }
    ErrorLog(const ErrorLog&) = delete;
    ErrorLog& operator=(const ErrorLog&) = delete;

  private:
    const Spool& spool_;
    const JobFile& job_;
    FileDescriptor before_;
};

/// "signal 11 (segmentation fault)"
Message end_of_process(int status) {
    if (WIFSIGNALED(status)) return Message("signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
    return Message("exit code {}", WEXITSTATUS(status));
}

/// A worker: starts hands, replaces those that crash, shows that it lives.
class WorkerProcess {
  public:
    WorkerProcess(const Spool& spool, const WorkerOptions& options)
        : spool_(spool),
          options_(options),
          id_(fmt::format("{}-{}-{}", file_name_of(options.node), ::getpid(),
                          spool.key_of({"", "", "", secure_bytes(16)}).substr(0, 6))),
          seed_(secure_bytes(32)) {
        status_.node = options.node;
        status_.hands = options.hands;
        status_.isolation = spool.identity().isolation;
        void* const shared = ::mmap(nullptr, sizeof(HandReport) * static_cast<std::size_t>(options.hands),
                                    PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (shared == MAP_FAILED) throw EnvironmentError("no memory for a worker: {}", system_reason(errno));
        reports_ = static_cast<HandReport*>(shared);
        for (int i = 0; i < options.hands; ++i) new (reports_ + i) HandReport;
        hands_.resize(static_cast<std::size_t>(options.hands));
    }
    ~WorkerProcess() { ::munmap(reports_, sizeof(HandReport) * hands_.size()); }
    WorkerProcess(const WorkerProcess&) = delete;
    WorkerProcess& operator=(const WorkerProcess&) = delete;

    std::optional<Message> run() {
        const SlowEnding hands_are_told_to_end;
        status_.refused = reason_to_refuse();
        if (!status_.refused.empty()) {
            end();
            return status_.refused;
        }
        spool_.admit(id_, SigningKey::of_seed(seed_).public_key());
        while (!must_end()) {
            for (std::size_t i = 0; i < hands_.size(); ++i)
                if (hands_[i].process == 0 && Clock::now() >= hands_[i].not_before) start(i);
            beat();
            reap();
            std::this_thread::sleep_for(50ms);
        }
        end();
        return {};
    }

  private:
    struct Hand {
        pid_t process = 0;
        Clock::time_point not_before{}, started{};
        int quick_ends = 0;
    };

    static std::string file_name_of(std::string node) {
        std::replace_if(
            node.begin(), node.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_'; }, '_');
        return node;
    }
    std::string name_of_hand(std::size_t i) const { return fmt::format("{}.{}", id_, i); }

    Message reason_to_refuse() const {
        if (spool_.identity().program != shared_identity())
            return Message(
                "{} has another version of dynlab, of its lessons or of their data than the coordinator, or a "
                "processor of another level; install the same one there",
                options_.node);
        if (spool_.identity().isolation != isolation_name(Isolation::kFull)) return {};
        const auto obstacle = obstacle_to(Isolation::kFull);
        return obstacle ? Message("{}: {}", options_.node, *obstacle) : Message();
    }

    bool must_end() {
        if (interrupted() || spool_.stopped()) return true;
        if (const auto coordinator = spool_.coordinator()) silence_.see(coordinator->beat);
        return silence_.lasting() > std::chrono::milliseconds(spool_.identity().grace_ms);
    }

    void start(std::size_t i) {
        std::cout.flush(), std::cerr.flush();
        const pid_t child = fork_bound_copy();
        if (child < 0) return;
        if (child == 0) {
            const int code = do_jobs(i);
            end_what_ends_with_program();  // _exit runs no destructors, and jobs keep folders
            ::_exit(code);
        }
        hands_[i].process = child;
        hands_[i].started = Clock::now();
    }

    int do_jobs(std::size_t i) const {
        try {
            WorkingHand hand(spool_, name_of_hand(i), options_.node, seed_, reports_[i]);
            while (auto job = hand.next()) {
                const auto kind = options_.kinds.find(job->job.kind);
                if (kind == options_.kinds.end())
                    hand.finish(*job, [&]() -> std::string {
                        throw EnvironmentError("no worker knows how to do jobs of the kind {}", job->job.kind);
                    });
                else
                    kind->second(hand, *std::move(job));
            }
        } catch (const Interrupted&) {
        } catch (const std::exception& error) {
            std::cerr << "dynlab work: " << error.what() << std::endl;
            return 1;
        }
        return 0;
    }

    void beat() {
        if (Clock::now() < next_beat_) return;
        next_beat_ = Clock::now() + kBeat;
        ++status_.beat;
        status_.done = 0;
        status_.trouble = {};
        for (std::size_t i = 0; i < hands_.size(); ++i) {
            status_.done += reports_[i].done;
            if (Message trouble = reports_[i].trouble(); !trouble.empty()) status_.trouble = std::move(trouble);
        }
        spool_.tell(id_, status_);
    }

    void reap() {
        int status = 0;
        for (pid_t ended; (ended = ::waitpid(-1, &status, WNOHANG)) > 0;)
            for (std::size_t i = 0; i < hands_.size(); ++i)
                if (hands_[i].process == ended) take_leave(i, status);
    }

    /// A hand has ended. One that ends again and again is waited with.
    void take_leave(std::size_t i, int status) {
        Hand& hand = hands_[i];
        hand.process = 0;
        const bool quick = Clock::now() - hand.started < 5s;
        hand.quick_ends = quick ? hand.quick_ends + 1 : 0;
        hand.not_before = Clock::now() + (hand.quick_ends > 3 ? 1s : 0s);
        const bool ended_well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        for (const Spool::Lease& lease : spool_.leases()) {
            if (lease.worker != name_of_hand(i)) continue;
            if (ending_ || ended_well) {
                spool_.give_back(lease);
                continue;
            }
            const std::string line = message_text(Message("on {}: the process that did it ended with {}", options_.node,
                                                          end_of_process(status))) +
                                     "\n";
            if (const FileDescriptor log = spool_.log_of(lease.job)) write_all(log.get(), line.data(), line.size());
            spool_.lose(lease);
        }
    }

    /// Hands get the time to give back what they have.
    void end() {
        ending_ = true;
        for (const Hand& hand : hands_)
            if (hand.process != 0) ::kill(hand.process, SIGTERM);
        const auto latest = Clock::now() + kEndOfHands;
        const auto busy = [&] {
            return std::any_of(hands_.begin(), hands_.end(), [](const Hand& hand) { return hand.process != 0; });
        };
        while (busy() && Clock::now() < latest) {
            beat();
            reap();
            std::this_thread::sleep_for(20ms);
        }
        for (const Hand& hand : hands_)
            if (hand.process != 0) ::kill(hand.process, SIGKILL);
        while (busy()) {
            reap();
            std::this_thread::sleep_for(20ms);
        }
        status_.ended = true;
        next_beat_ = {};
        if (spool_.exists()) beat();
    }

    const Spool& spool_;
    const WorkerOptions& options_;
    const std::string id_, seed_;
    WorkerStatus status_;
    HandReport* reports_ = nullptr;
    std::vector<Hand> hands_;
    Clock::time_point next_beat_{};
    HeartbeatWatch silence_;
    bool ending_ = false;
};

/// Why jobs cannot be done on this machine now ("... has 3 MB left, and 512 are needed"), or nothing.
std::optional<Message> trouble_of_machine() {
    const fs::path folder = parent_of_temporary_folders();
    struct statvfs room {};
    if (::statvfs(folder.c_str(), &room) != 0)
        return Message("{} cannot be looked at: {}", folder.string(), system_reason(errno));
    if ((room.f_flag & ST_RDONLY) != 0) return Message("nothing can be written to {}", folder.string());
    const std::uint64_t bytes = static_cast<std::uint64_t>(room.f_bavail) * room.f_frsize;
    if (bytes < kRoomNeeded)
        return Message("{} has {} MB left, and {} are needed: make room, or set TMPDIR", folder.string(), bytes >> 20,
                       kRoomNeeded >> 20);
    if (::access(folder.c_str(), W_OK) != 0)
        return Message("{} cannot be written to: {}", folder.string(), system_reason(errno));
    return {};
}

}  // namespace

std::string name_of_node() {
    if (const char* const slurm = std::getenv("SLURMD_NODENAME"); slurm && *slurm) return slurm;
    std::array<char, 256> name{};
    ::gethostname(name.data(), name.size() - 1);
    return name.data();
}

WorkingHand::WorkingHand(const Spool& spool, std::string worker, std::string node, const std::string& seed,
                         HandReport& report)
    : spool_(spool), worker_(std::move(worker)), node_(std::move(node)), seed_(seed), report_(report) {}

bool WorkingHand::must_end() const {
    return interrupted() || spool_.stopped();
}

void WorkingHand::wait_a_little(int& waited) const {
    std::this_thread::sleep_for(
        std::min<std::chrono::milliseconds>(kShortestWait * (1 << std::min(waited, 5)), kLongestWait));
    ++waited;
}

std::optional<Spool::Claimed> WorkingHand::next() {
    for (int waited = 0; !must_end(); wait_a_little(waited)) {
        if (waiting_) return std::exchange(waiting_, std::nullopt);
        const auto trouble = trouble_of_machine();
        report_.wait_because(trouble.value_or(Message()));
        if (trouble) continue;
        if (auto job = spool_.claim(worker_)) return job;
    }
    if (waiting_) spool_.give_back(waiting_->lease);
    return {};
}

void WorkingHand::finish(const Spool::Claimed& job, const std::function<std::string()>& work) {
    ShareResult result;
    {
        const ErrorLog log(spool_, job.lease.job);
        try {
            result.bytes = work();
        } catch (const std::exception& error) {
            result.trouble = message_of(error);
        }
    }
    if (interrupted()) {  // what it returned or threw may be for that: a study stops half way, and gives that half
        spool_.give_back(job.lease);
        throw Interrupted();
    }
    if (trouble_of_machine()) return spool_.give_back(job.lease);
    hand_in(job, std::move(result));
}

/// A spool whose disk is full takes it later: the work is not done twice for that.
void WorkingHand::hand_in(const Spool::Claimed& job, ShareResult result) {
    const std::size_t dot = worker_.rfind('.');
    result.worker = worker_.substr(0, dot);
    result.node = node_;
    result.signature = SigningKey::of_seed(seed_).sign(spool_.signed_text(job.lease.job.key, result));
    for (int waited = 0;; wait_a_little(waited)) {
        try {
            spool_.finish(job.lease, result);
            break;
        } catch (const EnvironmentError& error) {
            report_.wait_because(error.message());
        }
        if (!must_end()) continue;
        spool_.give_back(job.lease);
        throw Interrupted();
    }
    report_.wait_because({});
    ++report_.done;
}

std::optional<Message> work_for(const Spool& spool, const WorkerOptions& options) {
    return WorkerProcess(spool, options).run();
}

}  // namespace dynlab::inline workflow
