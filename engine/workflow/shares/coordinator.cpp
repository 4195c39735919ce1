#include "workflow/shares/coordinator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "platform/error.h"
#include "platform/interrupt.h"

namespace dynlab::inline workflow {
namespace {

using Clock = HeartbeatWatch::Clock;
using namespace std::chrono_literals;

constexpr auto kBetweenLooks = 40ms;
constexpr auto kBetweenTendings = 1s;
constexpr auto kBetweenRollCalls = 10s;
constexpr auto kEndOfWorkers = 20s;
constexpr auto kFirstHearing = 2500ms;
constexpr std::size_t kLeastWaiting = 16, kWaitingOfAHand = 3;
constexpr std::size_t kMostOfLog = 2000;
constexpr int kRollCalls = 3;  // a file that is renamed meanwhile may be missed once
constexpr int kMostTries = 12, kTriesBeforeAnyIsDone = 6;
constexpr double kMostWronged = 0.01, kCaution = 2;

}  // namespace

Coordinator::Coordinator(Spool spool, std::unique_ptr<WorkerEngine> engine)
    : spool_(std::move(spool)), engine_(std::move(engine)) {
    if (const auto before = spool_.coordinator()) status_ = *before;
    spool_.unstop();
    spool_.retry_failed();
    ++status_.beat;
    spool_.tell(status_);
    // Workers of a coordinator that was killed are given the time to be heard before others are started.
    if (!spool_.workers().empty()) next_start_ = Clock::now() + kFirstHearing;
    watch_ = std::thread([this] { watch(); });
}

Coordinator::~Coordinator() {
    end_workers();
}

void Coordinator::watch() {
    std::unique_lock lock(mutex_);
    try {
        while (!ending_) {
            look_around();
            if (!finished_.empty()) news_.notify_all();
            news_of_end_.wait_for(lock, kBetweenLooks);
        }
        leave();
    } catch (...) {
        failure_ = std::current_exception();
        spool_.stop();
        news_.notify_all();
    }
    engine_.reset();
}

std::string Coordinator::put(const ShareJob& job) {
    const std::string key = spool_.key_of(job);
    const std::lock_guard lock(mutex_);
    if (!out_.insert(key).second) return key;
    ++status_.wanted;
    for (const char* folder : {"jobs", "leases", "suspects", "done"})
        if (spool_.listed(folder).contains(key)) return key;
    if (!spool_.results().contains(key)) spool_.put(key, job);
    return key;
}

bool Coordinator::has_room() {
    const std::lock_guard lock(mutex_);
    std::size_t hands = 0;
    for (const auto& [id, worker] : alive_) hands += static_cast<std::size_t>(worker.hands);
    return out_.size() < kLeastWaiting + kWaitingOfAHand * hands;
}

std::optional<Coordinator::Finished> Coordinator::finished() {
    const std::lock_guard lock(mutex_);
    if (finished_.empty()) return {};
    Finished one = std::move(finished_.front());
    finished_.pop_front();
    return one;
}

bool Coordinator::wait() {
    throw_if_interrupted();
    std::unique_lock lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    if (finished_.empty() && out_.empty()) return false;
    if (finished_.empty()) news_.wait_for(lock, 2 * kBetweenLooks);
    return true;
}

void Coordinator::forget(const std::string& key) {
    spool_.forget(key);
}

void Coordinator::look_around() {
    const auto now = Clock::now();
    collect_results();
    if (now >= next_tending_) {
        next_tending_ = now + kBetweenTendings;
        watch_workers();
        count_losses();
        take_back_leases();
        judge_suspects();
        ++status_.beat;
        spool_.tell(status_);
        if (engine_ && now >= next_start_) {
            engine_->tend(alive_);
            for (const Message& message : engine_->complaints()) complain(message);
        }
    }
    if (now >= next_roll_call_) {
        next_roll_call_ = now + kBetweenRollCalls;
        report_vanished();
    }
}

void Coordinator::collect_results() {
    const std::set<std::string> results = spool_.results();
    if (!results.empty()) count_losses();  // before names are gone
    for (const std::string& key : results) {
        if (!out_.contains(key)) continue;
        auto result = spool_.result(key);
        if (!result) {
            complain(Message(
                "a result in {} is not signed by any worker of this session; it is refused, and its job is done again. "
                "Somebody else writes into that folder.",
                spool_.folder().string()));
            spool_.refuse_result(key);
            continue;
        }
        spool_.accept_result(key);
        out_.erase(key);
        ++status_.done, ++done_here_;
        finished_.push_back({key, std::move(result), {}});
    }
}

void Coordinator::watch_workers() {
    alive_.clear();
    for (auto& [id, worker] : spool_.workers()) {
        HeartbeatWatch& heart = hearts_[id];
        heart.see(worker.beat);
        if (!worker.refused.empty()) complain(Message("a worker is refused: {}", worker.refused));
        if (worker.ended || !worker.refused.empty() || !heart.heard() || is_silent(heart)) continue;
        if (!worker.trouble.empty()) complain(Message("{} waits: {}", worker.node, worker.trouble));
        alive_[id] = std::move(worker);
    }
}

bool Coordinator::is_silent(const HeartbeatWatch& heart) const {
    return heart.lasting() > std::chrono::milliseconds(spool_.identity().lease_ms);
}

/// Jobs carry in their names how many workers they lost, whoever took them back.
void Coordinator::count_losses() {
    for (const char* folder : {"jobs", "suspects", "leases", "done"})
        for (const auto& [key, losses] : spool_.listed(folder)) count_losses(key, losses);
}

void Coordinator::count_losses(const std::string& key, int losses) {
    int& known = losses_[key];
    status_.lost += static_cast<std::uint64_t>(std::max(0, losses - known));
    known = std::max(losses, known);
}

/// Of workers that have ended, or whose heart has been silent for too long, known by name or not.
void Coordinator::take_back_leases() {
    for (const Spool::Lease& lease : spool_.leases()) {
        const std::string id = lease.worker.substr(0, lease.worker.rfind('.'));
        const auto worker = spool_.worker(id);
        if (worker && worker->ended)
            spool_.give_back(lease);
        else if (is_silent(hearts_[id])) {
            spool_.lose(lease);
            count_losses(lease.job.key, lease.job.losses + 1);
        }
    }
}

/// Whether a job that lost so many workers in a row has done it itself: where workers are lost anyway, some jobs are
/// hit that often by chance. Of all that are wanted less than a hundredth may be wronged so.
bool Coordinator::is_guilty(int losses) const {
    if (losses >= kMostTries) return true;
    const double others = static_cast<double>(status_.lost) - static_cast<double>(status_.blamed) - losses;
    const double done = static_cast<double>(status_.done);
    const double share = (others + kCaution) / (others + done + kCaution);  // of jobs that lose their worker by chance
    if (others <= 0) return true;
    if (done == 0) return losses >= kTriesBeforeAnyIsDone;  // a storm from the start, or a study that always crashes
    return static_cast<double>(status_.wanted) * std::pow(share, losses) < kMostWronged;
}

void Coordinator::judge_suspects() {
    for (const auto& [key, losses] : spool_.listed("suspects")) {
        const JobFile job{key, losses};
        if (!is_guilty(losses)) {
            spool_.clear_of_suspicion(job);
            continue;
        }
        spool_.give_up(job);
        status_.blamed += static_cast<std::uint64_t>(losses);
        if (out_.erase(key) == 0) continue;
        ++status_.given_up;
        finished_.push_back({key, {}, reason_to_give_up(job)});
    }
}

Message Coordinator::reason_to_give_up(const JobFile& job) const {
    std::string log;
    for (int k = 0; k < job.losses && log.size() <= kMostOfLog; ++k) log += spool_.logged({job.key, k}, kMostOfLog);
    if (log.size() > kMostOfLog) log = log.substr(0, kMostOfLog) + " ...";
    while (!log.empty() && log.back() == '\n') log.pop_back();
    std::replace(log.begin(), log.end(), '\n', ';');
    return log.empty() ? Message("{} workers were lost with it; they said nothing before", job.losses)
                       : Message("{} workers were lost with it: {}", job.losses, log);
}

/// A job whose files somebody removed is not waited for.
void Coordinator::report_vanished() {
    if (!spool_.exists())
        throw EnvironmentError("the spool {} is gone; start again: what was finished is kept",
                               spool_.folder().string());
    std::set<std::string> present = spool_.results();
    for (const char* folder : {"jobs", "leases", "done", "suspects"})
        for (const auto& [key, losses] : spool_.listed(folder)) present.insert(key);
    std::map<std::string, int> missing;
    for (auto key = out_.begin(); key != out_.end();) {
        const int times = present.contains(*key) ? 0 : missing_[*key] + 1;
        if (times > 0 && times < kRollCalls) missing[*key] = times;
        if (times >= kRollCalls)
            finished_.push_back(
                {*key, {}, Message("it vanished from the spool, into which somebody else must have written")});
        key = times >= kRollCalls ? out_.erase(key) : std::next(key);
    }
    missing_ = std::move(missing);
}

void Coordinator::complain(const Message& message) {
    if (std::ranges::find(complained_, message) != complained_.end()) return;
    complained_.push_back(message);
    complaints_.push_back(message);
}

std::vector<Message> Coordinator::complaints() {
    const std::lock_guard lock(mutex_);
    return std::exchange(complaints_, {});
}

Message Coordinator::sight() {
    const std::lock_guard lock(mutex_);
    std::set<std::string> nodes;
    for (const auto& [id, worker] : alive_) nodes.insert(worker.node);
    const double seconds = std::chrono::duration<double>(Clock::now() - began_).count();
    MessageList parts;
    parts.items.push_back(nodes.empty() ? Message("waiting for workers")
                                        : plural(nodes.size(), "{} node, {}/s", "{} nodes, {}/s",
                                                 significant(static_cast<double>(done_here_) / seconds, 2)));
    if (status_.lost > 0) parts.items.push_back(Message("{} lost", status_.lost));
    if (status_.given_up > 0) parts.items.push_back(Message("{} given up", status_.given_up));
    return Message("{}", parts);
}

/// Whoever still lives is asked to end, and waited for; then the engine ends what did not listen.
void Coordinator::leave() {
    spool_.stop();
    if (engine_) {
        engine_->end();
        for (const Message& message : engine_->complaints()) complain(message);
    }
    const auto latest = Clock::now() + kEndOfWorkers;
    while (some_worker_lives() && Clock::now() < latest) std::this_thread::sleep_for(50ms);
    take_back_leases();
}

/// Heard of so lately that it may beat again.
bool Coordinator::some_worker_lives() {
    bool lives = false;
    for (const auto& [id, worker] : spool_.workers()) {
        hearts_[id].see(worker.beat);
        lives = lives || (!worker.ended && worker.refused.empty() && hearts_[id].lasting() < kFirstHearing);
    }
    return lives;
}

void Coordinator::end_workers() {
    if (!watch_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    news_of_end_.notify_all();
    watch_.join();
}

void Coordinator::conclude() {
    end_workers();
    spool_.remove();
}

}  // namespace dynlab::inline workflow
