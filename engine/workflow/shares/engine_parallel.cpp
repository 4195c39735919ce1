// Workers on hosts that ssh reaches, started by GNU parallel.
#include <fmt/format.h>

#include <algorithm>
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
                fmt::format("\"{}\" in --on parallel:{} is no host: write HOST, USER@HOST, or 4/HOST for four at once",
                            word, list));
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

    /// One call starts workers on all hosts that have none, and lasts as long as they work.
    void tend(const std::map<std::string, WorkerStatus>& alive) override {
        for (auto run = runs_.begin(); run != runs_.end();) {
            if (!run->process.ended()) {
                ++run;
                continue;
            }
            tell_end(run->process.wait().error_output);
            for (const std::string& host : run->hosts) running_.erase(host);
            run = runs_.erase(run);
        }
        std::set<std::string> living;
        for (const auto& [id, worker] : alive) living.insert(worker.node);
        if (!living.empty()) last_life_ = ParallelClock::now();
        std::vector<SshHost> missing;
        for (const SshHost& host : hosts_)
            if (!running_.contains(host.name) && !living.contains(host.name)) missing.push_back(host);
        if (missing.empty() || ParallelClock::now() < not_before_) return;
        refuse_when_hopeless();
        start(missing);
    }

    void end() override {
        const auto latest = ParallelClock::now() + kEndOfHosts;
        const auto busy = [](const Run& run) { return !run.process.ended(); };
        while (std::any_of(runs_.begin(), runs_.end(), busy) && ParallelClock::now() < latest)
            std::this_thread::sleep_for(20ms);
        for (Run& run : runs_)
            if (run.process.ended()) tell_end(run.process.wait().error_output);
        runs_.clear();
    }

    std::vector<std::string> complaints() override { return std::exchange(complaints_, {}); }

  private:
    struct Run {
        ChildProcess process;
        std::vector<std::string> hosts;
    };

    void start(const std::vector<SshHost>& hosts) {
        ChildOptions child;
        // A group of its own for each host, so that each gets one worker, with its own number of hands.
        child.command = {"parallel", "--will-cite", "--plain", "--hostgroup",  "--colsep",
                         ",",        "--tagstring", "{1}",     "--line-buffer"};
        std::vector<std::string> arguments, names;
        for (std::size_t i = 0; i < hosts.size(); ++i) {
            child.command.insert(child.command.end(), {"--sshlogin", fmt::format("@g{}/1/{}", i, hosts[i].name)});
            arguments.push_back(fmt::format("{},{}@g{}", hosts[i].name, hosts[i].hands, i));
            names.push_back(hosts[i].name);
            running_.insert(hosts[i].name);
        }
        child.command.push_back(shell_words(command_.words) + " --node {1} --hands {2}");
        child.command.push_back(":::");
        child.command.insert(child.command.end(), arguments.begin(), arguments.end());
        runs_.push_back({ChildProcess(child, "parallel"), names});
        not_before_ = ParallelClock::now() + kBetweenStarts;
    }

    /// "alpha<tab>ssh: connect to host alpha port 22: Connection refused"
    void tell_end(const std::string& said) {
        std::istringstream lines(said);
        for (std::string line; std::getline(lines, line);) {
            const std::size_t tab = line.find('\t');
            const std::string host = line.substr(0, tab);
            const auto named = [&](const SshHost& one) { return one.name == host; };
            if (tab == std::string::npos || std::none_of(hosts_.begin(), hosts_.end(), named)) continue;
            last_ = fmt::format("{} says: {}", host, line.substr(tab + 1));
            complaints_.push_back("no worker on " + last_);
            ++refusals_[host];
        }
    }

    void refuse_when_hopeless() const {
        if (!runs_.empty() || ParallelClock::now() - last_life_ < kHopeless) return;
        const bool hopeless = std::all_of(hosts_.begin(), hosts_.end(), [this](const SshHost& host) {
            const auto found = refusals_.find(host.name);
            return found != refusals_.end() && found->second >= kMostRefusals;
        });
        if (hopeless)
            throw EnvironmentError(fmt::format(
                "no worker can be started on any host; {}. Try `ssh HOST {} --version` for each: it must work without "
                "a password, and the host must see the folders of spool and results",
                last_, command_.words.at(command_.words.size() - 3)));
    }

    std::vector<SshHost> hosts_;
    WorkerCommand command_;
    std::vector<Run> runs_;
    std::set<std::string> running_;
    std::map<std::string, int> refusals_;
    std::vector<std::string> complaints_;
    std::string last_;
    ParallelClock::time_point not_before_{}, last_life_ = ParallelClock::now();
};

}  // namespace

std::unique_ptr<WorkerEngine> hosts_by_parallel(const std::string& hosts, WorkerCommand command) {
    return std::make_unique<ParallelHosts>(hosts, std::move(command));
}

}  // namespace dynlab::inline workflow
