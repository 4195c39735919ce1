#include "workflow/parts/machines.h"

#include <fmt/format.h>

#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "base/reader.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/child_process.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/program_lookup.h"
#include "platform/text/read_number.h"
#include "workflow/parts/part.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

constexpr char kSlurmPackage[] = "slurm-client", kJobs[] = "slurm-jobs", kNotedParts[] = "count";
constexpr auto kSlurmAnswers = std::chrono::seconds(30), kEndOfHosts = std::chrono::seconds(5);
constexpr auto kBetweenSignals = std::chrono::milliseconds(300);
constexpr int kPartsOfAHost = 8, kPartsOfASlot = 2;

std::vector<std::string> split_at_commas(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
}

bool only_of(const std::string& text, const char* letters) {
    return !text.empty() && text.find_first_not_of(letters) == std::string::npos;
}

int number_up_to(int limit, const std::string& text) {
    const auto number = read_number<int>(text);
    return number && *number >= 1 && *number <= limit ? *number : 0;
}

Machines slurm_in(const std::string& list) {
    Machines machines{Machines::Kind::kSlurm, {}};
    for (const std::string& word : split_at_commas(list)) {
        const std::size_t equal = word.find('=');
        const std::string name = word.substr(0, equal),
                          value = equal == std::string::npos ? "" : word.substr(equal + 1);
        const bool ours = name == "tasks" || name == "rounds";
        if (!only_of(name, "abcdefghijklmnopqrstuvwxyz-") || value.empty() ||
            (ours && number_up_to(WorkPart::kMax, value) == 0))
            throw EnvironmentError(
                "\"{}\" in --on slurm:{} is not a valid OPTION=VALUE: use tasks=N and rounds=N (N from 1 to {}), or "
                "any option of sbatch, such as partition=short or time=2:00:00",
                word, list, WorkPart::kMax);
        if (ours)
            (name == "tasks" ? machines.parts : machines.rounds) = number_up_to(WorkPart::kMax, value);
        else
            machines.words.push_back(fmt::format("--{}={}", name, value));
    }
    return machines;
}

Machines hosts_in(const std::string& list) {
    Machines machines{Machines::Kind::kHosts, {}, 0};
    for (const std::string& word : split_at_commas(list)) {
        const std::size_t slash = word.find('/');
        const std::string host = word.substr(slash == std::string::npos ? 0 : slash + 1);
        const int slots = slash == std::string::npos ? kPartsOfAHost : number_up_to(256, word.substr(0, slash));
        if (slots == 0 || host.starts_with('-') ||
            !only_of(host, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_@:[]"))
            throw EnvironmentError(
                "\"{}\" in --on hosts:{} is not a valid host: write HOST, USER@HOST, or N/HOST for N parallel parts (N "
                "from 1 to 256)",
                word, list);
        machines.words.push_back(word);
        machines.parts = std::min(WorkPart::kMax, machines.parts + kPartsOfASlot * slots);
    }
    return machines;
}

std::string quoted(const std::string& word) {
    return "'" + replaced(word, "'", "'\\''") + "'";
}

/// This command without what says where its parts are done, or which one.
std::vector<std::string> own_words() {
    const std::string line = read_file("/proc/self/cmdline");
    std::vector<std::string> words;
    for (std::size_t at = line.find('\0') + 1; at < line.size(); at = line.find('\0', at) + 1) {
        const std::string word = line.c_str() + at;
        const bool with_value = word == "--on" || word == "--part";
        if (with_value) at = line.find('\0', at) + 1;
        const bool ours = with_value || word.starts_with("--on=") || word.starts_with("--part=") || word == "--join" ||
                          word == "--again";
        if (!ours) words.push_back(word);
    }
    return words;
}

/// As a shell of another machine runs it.
std::string command_line() {
    std::string line = fmt::format("cd {} && env", quoted(fs::current_path().string()));
    for (const char* name : {"DYNLAB_HOME", "DYNLAB_COURSE", "DYNLAB_LESSONS"})
        if (const char* const value = std::getenv(name); value && *value)
            line += " " + quoted(fmt::format("{}={}", name, value));
    line += " " + quoted(running_program().string());
    for (const std::string& word : own_words()) line += " " + quoted(word);
    return line;
}

ChildResult ask_slurm(std::vector<std::string> words, const std::string& input = "") {
    ChildOptions child;
    child.command = std::move(words);
    child.input = input;
    child.timeout = kSlurmAnswers;
    child.heeds_interrupt = false;  // what was submitted is known
    return run_child(child, kSlurmPackage);
}

Message first_line(const ChildResult& child) {
    const std::string said = child.error_output.substr(0, child.error_output.find('\n'));
    return said.empty() ? Message("exit code {}, without a message", child.exit_code) : Message::verbatim(said);
}

[[noreturn]] void refuse_work(const ChildResult& child) {
    const std::string& said = child.error_output;
    Message remedy = Message("correct the options that follow \"slurm:\" in --on, which dynlab passes to sbatch");
    if (said.find("partition") != std::string::npos) {
        const ChildResult known = ask_slurm({"sinfo", "--noheader", "--format=%R"});
        remedy = Message("the partitions of this cluster are {}", listed(words_between_spaces(known.output)));
    } else if (said.find("contact slurm controller") != std::string::npos ||
               said.find("onnection refused") != std::string::npos || child.timed_out) {
        remedy = Message("slurmctld is not running or cannot be reached; repeat the command when `sinfo` responds");
    }
    throw EnvironmentError("Slurm does not accept the jobs ({}): {}", first_line(child), remedy);
}

/// A job that runs this script; its id.
std::string submit(const Machines& machines, const fs::path& logs, std::vector<std::string> options,
                   const std::string& script) {
    std::vector<std::string> words = {"sbatch",    "--parsable",         "--job-name=dynlab",
                                      "--requeue", "--open-mode=append", fmt::format("--chdir={}", logs.string())};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), machines.words.begin(), machines.words.end());
    const ChildResult child = ask_slurm(words, script);
    const std::vector<std::string> id = words_between_spaces(child.output);
    if (child.exit_code != 0 || id.empty()) refuse_work(child);
    return id.front().substr(0, id.front().find(';'));  // a cluster's name may follow
}

/// The jobs of GNU parallel are in separate process groups, so parallel must pass Ctrl-C on: at the second SIGTERM it
/// ends them and, with the connections, their work on other hosts.
ChildResult run_parallel(ChildOptions options) {
    using Clock = std::chrono::steady_clock;
    const SlowEnding slow;
    int process = 0, asked = 0;
    Clock::time_point next;
    options.heeds_interrupt = false;
    options.give_up = [&] {
        if (!interrupted() || (asked > 0 && Clock::now() < next)) return false;
        next = Clock::now() + (asked == 0 ? kBetweenSignals : kEndOfHosts);
        if (asked < 2) ::kill(process, SIGTERM);
        return ++asked > 2;
    };
    ChildProcess parallel(options, "parallel");
    process = parallel.id();
    ChildResult done = parallel.wait();
    throw_if_interrupted();
    return done;
}

/// Jobs of an earlier call would do the same work.
void refuse_queued_jobs(const fs::path& folder) {
    if (!fs::exists(folder / kJobs)) return;
    const std::string jobs = read_file(folder / kJobs);
    const ChildResult child = ask_slurm({"squeue", "--noheader", "--format=%i", "--jobs=" + jobs});
    if (child.exit_code == 0 && !words_between_spaces(child.output).empty())
        throw EnvironmentError(
            "the Slurm jobs {} are still queued or running in {}; wait for the jobs (squeue shows their state), or "
            "cancel them: scancel {}",
            jobs, folder.parent_path().string(), replaced(jobs, ",", " "));
}

}  // namespace

std::optional<WorkPart> part_in(const std::string& text) {
    const std::size_t slash = text.find('/');
    const int count = slash == std::string::npos ? 0 : number_up_to(WorkPart::kMax, text.substr(slash + 1));
    const int index = count == 0 ? 0 : number_up_to(count, text.substr(0, slash));
    return index == 0 ? std::nullopt : std::optional<WorkPart>({index, count});
}

Machines machines_in(const std::string& text) {
    const std::size_t colon = text.find(':');
    const std::string name = text.substr(0, colon), rest = colon == std::string::npos ? "" : text.substr(colon + 1);
    if (name == "slurm") return slurm_in(rest);
    if (name == "hosts" && !rest.empty()) return hosts_in(rest);
    if (name == "processes" && number_up_to(256, rest) > 0) return hosts_in(rest + "/:");
    throw EnvironmentError(
        "--on must be slurm[:OPTION=VALUE,...], hosts:HOST,N/HOST,... or processes:N (1 to 256), but \"{}\" was given",
        text);
}

Message submit_to_slurm(const Machines& machines, const WorkInParts& work) {
    // A job that a signal ended runs again, at most twice; a job that exited with an error would fail again.
    constexpr const char* kScript =
        "#!/bin/sh\nfor try in 1 2 3; do\n  ({})\n  code=$?\n  [ $code -gt 128 ] || exit $code\ndone\nexit $code\n";
    const fs::path logs = fs::absolute(work.folder).lexically_normal();
    fs::create_directories(logs);
    refuse_queued_jobs(logs);
    const std::string part = command_line() + fmt::format(" --part \"$SLURM_ARRAY_TASK_ID\"/{}", machines.parts);
    std::vector<std::string> ids;
    const auto after_last = [&] { return "--dependency=afterok:" + ids.back(); };
    for (int round = 0; round < machines.rounds; ++round) {
        const std::string tasks =
            round == 0 ? fmt::format("{}", fmt::join(work.missing, ",")) : fmt::format("1-{}", machines.parts);
        std::vector<std::string> options = {"--array=" + tasks, "--output=slurm-%A_%a.txt"};
        if (!ids.empty()) options.insert(options.end(), {"--kill-on-invalid-dep=yes", after_last()});
        ids.push_back(submit(machines, logs, std::move(options), fmt::format(kScript, part)));
        write_file_atomically(logs / kJobs, fmt::format("{}", fmt::join(ids, ",")));
    }
    ids.push_back(submit(machines, logs, {"--output=slurm-join-%j.txt", "--kill-on-invalid-dep=yes", after_last()},
                         fmt::format(kScript, command_line() + " --join")));
    write_file_atomically(logs / kJobs, fmt::format("{}", fmt::join(ids, ",")));
    return Message(
        "{}\n  follow    squeue --jobs={}; tail {}/slurm-*.txt\n  cancel    scancel {}\n  continue  repeat the "
        "command; finished parts are kept\n",
        plural(static_cast<std::int64_t>(work.missing.size()),
               "Slurm has {} part (of {}) in job {}; job {} joins the parts.",
               "Slurm has {} parts (of {}) in job {}; job {} joins the parts.", machines.parts, ids.front(),
               ids.back()),
        fmt::format("{}", fmt::join(ids, ",")), work.folder.string(), fmt::format("{}", fmt::join(ids, " ")));
}

std::vector<Message> do_on_hosts(const Machines& machines, const WorkInParts& work) {
    const fs::path list = work.folder / "hosts", log = work.folder / "joblog";
    fs::create_directories(work.folder);
    write_file_atomically(list, fmt::format("{}\n", fmt::join(machines.words, "\n")));
    fs::remove(log);  // `missing` says what is left to do, also where results were deleted since
    ChildOptions child;
    // Its own marks ({}, {#}, {.}) mean nothing in the words of the command, all of which are quoted.
    const std::string command = replaced(command_line(), "{", "{''");
    child.command = {"parallel",    "--will-cite",
                     "--plain",     "--joblog",
                     log.string(),  "--retries",
                     "3",           "--sshloginfile",
                     list.string(), command + fmt::format(" --part {{}}/{}", machines.parts),
                     ":::"};
    for (const int part : work.missing) child.command.push_back(std::to_string(part));
    const ChildResult done = run_parallel(child);
    std::vector<Message> said;
    std::istringstream lines(done.error_output);
    for (std::string line; std::getline(lines, line) && said.size() < 20;)
        if (!line.empty()) said.push_back(Message::verbatim(line));
    if (done.exit_code != 0)
        throw EnvironmentError(
            "not all parts were processed (see {}): {}\nEach host must have access to this folder, and `ssh HOST {} "
            "--version` must work without a password. Repeat the command to continue",
            log.string(), MessageList{said, Join::kLines}, running_program().string());
    return said;
}

std::string shown_command(const std::string& option) {
    std::string text = kProgram;
    for (const std::string& word : own_words())
        text +=
            " " + (word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_/=:,+") ==
                           std::string::npos
                       ? word
                       : quoted(word));
    return text + " " + option;
}

int noted_parts(const fs::path& folder) {
    const fs::path file = folder / kNotedParts;
    return std::max(1, fs::exists(file) ? number_up_to(WorkPart::kMax, read_file(file)) : 1);
}

void note_parts(const fs::path& folder, int parts) {
    if (noted_parts(folder) == parts) return;
    fs::create_directories(folder);
    write_file_atomically(folder / kNotedParts, std::to_string(parts));
}

}  // namespace dynlab::inline workflow
