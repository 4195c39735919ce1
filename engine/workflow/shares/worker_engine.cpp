#include "workflow/shares/worker_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <thread>

#include "platform/child_process.h"
#include "platform/error.h"
#include "platform/program_lookup.h"

namespace dynlab::inline workflow {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kEndOfProcesses = 18s;
constexpr int kMostProcesses = 256;

/// Workers as processes of this machine.
class LocalProcesses : public WorkerEngine {
  public:
    LocalProcesses(int count, WorkerCommand command)
        : command_(std::move(command)), processes_(static_cast<std::size_t>(count)) {}

    int wanted() const override { return static_cast<int>(processes_.size()); }

    void tend(const std::map<std::string, WorkerStatus>&) override {
        for (auto& process : processes_) {
            if (process && process->ended()) tell_end(std::exchange(process, nullptr)->wait());
            if (process) continue;
            ChildOptions child;
            child.command = command_.words;
            child.command.insert(child.command.end(), {"--hands", std::to_string(command_.hands)});
            process = std::make_unique<ChildProcess>(child, "dynlab");
        }
    }

    void end() override {
        const auto latest = Clock::now() + kEndOfProcesses;
        const auto busy = [](const auto& process) { return process && !process->ended(); };
        while (std::ranges::any_of(processes_, busy) && Clock::now() < latest) std::this_thread::sleep_for(20ms);
        for (auto& process : processes_) process.reset();
    }

    std::vector<Message> complaints() override { return std::exchange(complaints_, {}); }

  private:
    /// One that cannot work here at all says so and ends; one that was killed says nothing.
    void tell_end(const ChildResult& result) {
        if (result.exit_code == 0 || result.exit_code >= 128) return;
        const std::string said = result.error_output.substr(0, result.error_output.find('\n'));
        complaints_.push_back(Message("a worker of this machine ended: {}", said));
        if (++ends_ > 3 * wanted()) throw EnvironmentError("no worker can be started on this machine: {}", said);
    }

    WorkerCommand command_;
    std::vector<std::unique_ptr<ChildProcess>> processes_;
    std::vector<Message> complaints_;
    int ends_ = 0;
};

std::unique_ptr<WorkerEngine> local_processes(int count, WorkerCommand command) {
    return std::make_unique<LocalProcesses>(count, std::move(command));
}

}  // namespace

std::vector<std::string> worker_words(const std::filesystem::path& spool) {
    std::vector<std::string> words = {"/usr/bin/env"};
    for (const char* name : {"DYNLAB_HOME", "DYNLAB_COURSE", "DYNLAB_LESSONS"})
        if (const char* const value = std::getenv(name); value && *value)
            words.push_back(fmt::format("{}={}", name, value));
    words.insert(words.end(), {running_program().string(), "work", spool.string()});
    return words;
}

std::string shell_words(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) {
        text += text.empty() ? "'" : " '";
        for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
        text += "'";
    }
    return text;
}

std::unique_ptr<WorkerEngine> engine_of(const std::string& words, const Spool& spool, WorkerCommand command) {
    const std::size_t colon = words.find(':');
    const std::string name = words.substr(0, colon), rest = colon == std::string::npos ? "" : words.substr(colon + 1);
    if (name == "processes" && !rest.empty() && rest.size() < 4 &&
        std::ranges::all_of(rest, [](unsigned char c) { return std::isdigit(c); }) && std::stoi(rest) >= 1 &&
        std::stoi(rest) <= kMostProcesses)
        return local_processes(std::stoi(rest), std::move(command));
    if (name == "parallel" && !rest.empty()) return hosts_by_parallel(rest, std::move(command));
    if (name == "slurm") return slurm_tasks(rest, spool, std::move(command));
    throw EnvironmentError(
        "--on \"{}\" is none of processes:N (1 to {}), parallel:HOST,N/HOST,... and slurm[:OPTION=VALUE,...]", words,
        kMostProcesses);
}

}  // namespace dynlab::inline workflow
