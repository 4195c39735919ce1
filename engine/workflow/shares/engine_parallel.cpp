// Workers on hosts that ssh reaches, started by GNU parallel.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "platform/child_process.h"
#include "platform/error.h"
#include "workflow/shares/worker_engine.h"

namespace dynlab::inline workflow {
namespace {

using ParallelClock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kEndOfHosts = 18s;
constexpr auto kBetweenStarts = 2s;
constexpr auto kHopeless = 10s;  // without any worker
constexpr int kMostRefusals = 3;

struct SshHost {
    std::string name;  ///< as ssh knows it; ":" is this machine
    int hands = 0;     ///< 0: as many as it has cores
};

std::vector<SshHost> ssh_hosts_in(const std::string& list) {
    std::vector<SshHost> hosts;
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) {
        const std::size_t slash = word.find('/');
        SshHost host{word.substr(slash == std::string::npos ? 0 : slash + 1), 0};
        const std::string count = slash == std::string::npos ? "" : word.substr(0, slash);
        const bool number = count.size() < 4 && count.find_first_not_of("0123456789") == std::string::npos;
        const std::string allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_@:[]";
        if (host.name.empty() || host.name.front() == '-' || !number ||
            host.name.find_first_not_of(allowed) != std::string::npos)
            throw EnvironmentError(
                "\"{}\" in --on parallel:{} is no host: write HOST, USER@HOST, or 4/HOST for four at once", word, list);
        if (!count.empty()) host.hands = std::stoi(count);
        hosts.push_back(host);
    }
    return hosts;
}

class ParallelHosts : public WorkerEngine {
  public:
    ParallelHosts(const std::string& hosts, WorkerCommand command)
        : hosts_(ssh_hosts_in(hosts)), command_(std::move(command)) {}

    int wanted() const override {
        int hands = 0;
        for (const SshHost& host : hosts_) hands += std::max(1, host.hands);
        return hands;
    }

    /// One call for each host that has no worker; it lasts as long as its worker does.
    void tend(const std::map<std::string, WorkerStatus>& alive) override {
        tell_ends();
        std::set<std::string> living;
        for (const auto& [id, worker] : alive) living.insert(worker.node);
        if (!living.empty()) last_life_ = ParallelClock::now();
        if (ParallelClock::now() < not_before_) return;
        refuse_when_hopeless();
        for (const SshHost& host : hosts_)
            if (!runs_.contains(host.name) && !living.contains(host.name)) start(host);
    }

    void end() override {
        const auto latest = ParallelClock::now() + kEndOfHosts;
        const auto busy = [](const auto& run) { return !run.second.ended(); };
        while (std::ranges::any_of(runs_, busy) && ParallelClock::now() < latest) std::this_thread::sleep_for(20ms);
        tell_ends();
        runs_.clear();
    }

    std::vector<Message> complaints() override { return std::exchange(complaints_, {}); }

  private:
    void start(const SshHost& host) {
        ChildOptions child;
        child.command = {"parallel",
                         "--will-cite",
                         "--plain",
                         "--line-buffer",
                         "--sshlogin",
                         "1/" + host.name,
                         shell_words(command_.words) + " --node " + host.name + " --hands {}",
                         ":::",
                         std::to_string(host.hands)};
        runs_.emplace(host.name, ChildProcess(child, "parallel"));
        not_before_ = ParallelClock::now() + kBetweenStarts;
    }

    /// "ssh: connect to host alpha port 22: Connection refused"
    void tell_ends() {
        for (auto run = runs_.begin(); run != runs_.end();) {
            if (!run->second.ended()) {
                ++run;
                continue;
            }
            const std::string said = run->second.wait().error_output;
            if (!said.empty()) {
                last_ = Message("{} says: {}", run->first, said.substr(0, said.find_first_of("\r\n")));
                complaints_.push_back(Message("no worker on {}", last_));
                ++refusals_[run->first];
            }
            run = runs_.erase(run);
        }
    }

    void refuse_when_hopeless() const {
        if (!runs_.empty() || ParallelClock::now() - last_life_ < kHopeless) return;
        const bool hopeless = std::ranges::all_of(hosts_, [this](const SshHost& host) {
            const auto found = refusals_.find(host.name);
            return found != refusals_.end() && found->second >= kMostRefusals;
        });
        if (hopeless)
            throw EnvironmentError(
                "no worker can be started on any host; {}. Try `ssh HOST {} --version` for each: it must work without "
                "a password, and the host must see the folders of spool and results",
                last_, command_.words.at(command_.words.size() - 3));
    }

    std::vector<SshHost> hosts_;
    WorkerCommand command_;
    std::map<std::string, ChildProcess> runs_;  ///< by host
    std::map<std::string, int> refusals_;
    std::vector<Message> complaints_;
    Message last_;
    ParallelClock::time_point not_before_{}, last_life_ = ParallelClock::now();
};

}  // namespace

std::unique_ptr<WorkerEngine> hosts_by_parallel(const std::string& hosts, WorkerCommand command) {
    return std::make_unique<ParallelHosts>(hosts, std::move(command));
}

}  // namespace dynlab::inline workflow
