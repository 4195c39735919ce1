// Workers as pilot tasks of Slurm: one array job, however many jobs there are.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <thread>

#include "documents/text_lines.h"
#include "platform/child_process.h"
#include "platform/error.h"
#include "platform/files/plain_file.h"
#include "workflow/shares/worker_engine.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;
using SlurmClock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr char kSlurmPackage[] = "slurm-client";
constexpr auto kSlurmAnswers = 30s;
constexpr auto kBetweenQuestions = 4s;
constexpr auto kEndOfTasks = 15s;
constexpr char kArrays[] = "slurm";
constexpr std::size_t kMostOfATaskLog = 1 << 20;
constexpr int kMostTasks = 1000;  // MaxArraySize as Slurm comes
constexpr int kMostQuickEnds = 3;
constexpr int kJobsOfATask = 4;  // the longest ones, at least, that a task's time must do for
constexpr auto kShortestTask = std::chrono::minutes(30);

struct SlurmOptions {
    int tasks = 4;
    std::vector<std::string> words;  ///< for sbatch
    bool time = false, memory = false;
};

/// tasks= and hands= are ours; all others are sbatch's.
SlurmOptions slurm_options_in(const std::string& list, WorkerCommand& command) {
    SlurmOptions options;
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) {
        const std::size_t equal = word.find('=');
        const std::string name = word.substr(0, equal),
                          value = equal == std::string::npos ? "" : word.substr(equal + 1);
        const bool number = !value.empty() && value.size() < 5 &&
                            value.find_first_not_of("0123456789") == std::string::npos && std::stoi(value) > 0;
        const bool known_letters = name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == std::string::npos;
        const bool ours = name == "tasks" || name == "hands";
        if (name.empty() || value.empty() || !known_letters || (ours && (!number || std::stoi(value) > kMostTasks)))
            throw EnvironmentError(
                "\"{}\" in --on slurm:{} is no OPTION=VALUE: tasks=N and hands=N (up to {}), or any option of sbatch, "
                "such as partition=short or time=2:00:00",
                word, list, kMostTasks);
        if (name == "tasks") options.tasks = std::stoi(value);
        if (name == "hands") command.hands = std::stoi(value);
        options.time = options.time || name == "time";
        options.memory = options.memory || name.starts_with("mem");
        if (!ours) options.words.push_back(fmt::format("--{}={}", name, value));
    }
    return options;
}

class SlurmTasks : public WorkerEngine {
  public:
    SlurmTasks(const std::string& options, const Spool& spool, WorkerCommand command)
        : spool_(spool), command_(std::move(command)), options_(slurm_options_in(options, command_)) {
        arrays_ = words_between_spaces(spool_.noted(kArrays).value_or(""));  // of a coordinator that was ended
    }

    int wanted() const override { return options_.tasks * command_.hands; }

    void tend(const std::map<std::string, WorkerStatus>& alive) override {
        if (SlurmClock::now() < next_) return;
        next_ = SlurmClock::now() + kBetweenQuestions;
        worked_ = worked_ || !alive.empty();
        const auto tasks = tasks_now();
        if (!tasks) return;  // it does not answer now; the tasks work on
        if (*tasks >= options_.tasks) return;
        if (submitted_ && !worked_ && *tasks == 0 && ++quick_ends_ >= kMostQuickEnds)
            throw EnvironmentError("Slurm's tasks end without having worked; the last one says: {}",
                                   last_words_of_a_task());
        submit(options_.tasks - *tasks);
    }

    void end() override {
        if (arrays_.empty()) return;
        const auto latest = SlurmClock::now() + kEndOfTasks;
        std::vector<std::string> cancel = {"scancel", "--quiet", "--state=PENDING"};
        cancel.insert(cancel.end(), arrays_.begin(), arrays_.end());
        ask(cancel);
        while (tasks_now().value_or(0) > 0 && SlurmClock::now() < latest) std::this_thread::sleep_for(300ms);
        cancel.erase(cancel.begin() + 2);
        ask(cancel);
        while (tasks_now().value_or(0) > 0 && SlurmClock::now() < latest + kEndOfTasks)
            std::this_thread::sleep_for(300ms);
    }

    std::vector<Message> complaints() override { return std::exchange(complaints_, {}); }

  private:
    fs::path logs() const { return spool_.folder() / "logs"; }

    ChildResult ask(const std::vector<std::string>& words, const std::string& input = "") const {
        ChildOptions child;
        child.command = words;
        child.input = input;
        child.timeout = kSlurmAnswers;
        child.heeds_interrupt = false;  // tasks that were submitted are known, and cancelled, whatever comes between
        return run_child(child, kSlurmPackage);
    }

    /// That wait or run; nothing where Slurm does not answer.
    std::optional<int> tasks_now() {
        if (arrays_.empty()) return 0;
        const ChildResult told =
            ask({"squeue", "--noheader", "--array", "--format=%T", fmt::format("--jobs={}", fmt::join(arrays_, ","))});
        const bool forgotten = told.error_output.find("Invalid job id") != std::string::npos;
        if (told.exit_code != 0 && !forgotten) {
            if (std::exchange(answers_, false))
                complaints_.push_back(Message("Slurm does not answer now: {}", first_line(told)));
            return {};
        }
        answers_ = true;
        return static_cast<int>(words_between_spaces(told.output).size());
    }

    static Message first_line(const ChildResult& told) {
        const std::string said = told.error_output.substr(0, told.error_output.find('\n'));
        return said.empty() ? Message("no word, exit code {}", told.exit_code) : Message::verbatim(said);
    }

    void submit(int tasks) {
        std::vector<std::string> words = {"sbatch",
                                          "--parsable",
                                          fmt::format("--array=1-{}", tasks),
                                          "--job-name=dynlab",
                                          "--requeue",
                                          "--open-mode=append",
                                          "--signal=B:TERM@30",
                                          fmt::format("--cpus-per-task={}", command_.hands),
                                          fmt::format("--chdir={}", spool_.folder().string()),
                                          fmt::format("--output={}", (logs() / "slurm-%A_%a.txt").string())};
        if (!options_.memory) words.push_back(fmt::format("--mem-per-cpu={}M", command_.memory_bytes >> 20));
        if (!options_.time) {
            const auto time = std::max<std::chrono::seconds>(kShortestTask, kJobsOfATask * command_.longest_job);
            words.push_back(fmt::format("--time={}", (time.count() + 59) / 60));
        }
        words.insert(words.end(), options_.words.begin(), options_.words.end());
        const std::string script =
            fmt::format("#!/bin/sh\nexec {} --hands {}\n", shell_words(command_.words), command_.hands);
        const ChildResult told = ask(words, script);
        const std::vector<std::string> array = words_between_spaces(told.output);
        if (told.exit_code != 0 || array.empty()) {
            if (submitted_) {  // some work already
                complaints_.push_back(Message("Slurm takes no further task: {}", first_line(told)));
                return;
            }
            refuse(told);
        }
        arrays_.push_back(array.front().substr(0, array.front().find(';')));  // a cluster's name may follow
        spool_.note(kArrays, fmt::format("{}\n", fmt::join(arrays_, "\n")));
        submitted_ = true;
    }

    [[noreturn]] void refuse(const ChildResult& told) const {
        const std::string said = told.error_output;
        Message remedy = Message("sbatch takes the options that stand behind slurm: in --on");
        if (said.find("partition") != std::string::npos) {
            const ChildResult known = ask({"sinfo", "--noheader", "--format=%R"});
            remedy = Message("the partitions here are {}", listed(words_between_spaces(known.output)));
        } else if (said.find("contact slurm controller") != std::string::npos ||
                   said.find("onnection refused") != std::string::npos || told.timed_out) {
            remedy = Message(
                "slurmctld is not running or cannot be reached; `sinfo` must answer. Until then, --on processes:N does "
                "the work on this machine");
        }
        throw EnvironmentError("Slurm does not take the work ({}): {}", first_line(told), remedy);
    }

    Message last_words_of_a_task() const {
        std::string words;
        fs::file_time_type newest{};
        std::error_code gone;
        for (const auto& entry : fs::directory_iterator(logs(), gone)) {
            const auto written = entry.last_write_time(gone);
            if (!entry.path().filename().string().starts_with("slurm-") || gone || written < newest) continue;
            newest = written;
            words = start_of_plain_file(entry.path(), kMostOfATaskLog);
        }
        while (!words.empty() && words.back() == '\n') words.pop_back();
        words = words.substr(words.rfind('\n') + 1);
        return words.empty() ? Message("nothing (does the node see {}?)", spool_.folder().string())
                             : Message::verbatim(words);
    }

    const Spool spool_;
    WorkerCommand command_;
    SlurmOptions options_;
    std::vector<std::string> arrays_;  ///< ids of array jobs
    std::vector<Message> complaints_;
    SlurmClock::time_point next_{};
    bool submitted_ = false, worked_ = false, answers_ = true;
    int quick_ends_ = 0;
};

}  // namespace

std::unique_ptr<WorkerEngine> slurm_tasks(const std::string& options, const Spool& spool, WorkerCommand command) {
    return std::make_unique<SlurmTasks>(options, spool, std::move(command));
}

}  // namespace dynlab::inline workflow
