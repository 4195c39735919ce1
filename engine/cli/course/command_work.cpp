#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <thread>

#include "cli/commands.h"
#include "course/grading/shared_grading.h"
#include "platform/error.h"
#include "platform/terminal/aligned_table.h"
#include "platform/terminal/terminal_text.h"
#include "workflow/shares/shared_study.h"
#include "workflow/shares/worker.h"

namespace dynlab::inline cli {
namespace {

struct WorkArguments {
    std::string spool, node;
    int hands = 0;
    bool status = false;
};

int work(const WorkArguments& words) {
    const Spool spool = Spool::open(words.spool);
    WorkerOptions options;
    options.hands = words.hands > 0 ? words.hands : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    options.node = words.node.empty() || words.node == ":" ? name_of_node() : words.node;
    options.kinds = {{"grade", grading_share()}, {"study", study_share()}};
    if (const auto refused = work_for(spool, options)) throw EnvironmentError(*refused);
    return kDone;
}

std::string state_of(const WorkerStatus& worker, bool beats) {
    if (!worker.refused.empty()) return message_text(Message("refused: {}", worker.refused));
    if (worker.ended) return "ended";
    if (!beats) return "silent";
    return worker.trouble.empty() ? "works" : message_text(Message("waits: {}", worker.trouble));
}

/// Two looks a little apart: whose heart beats, and what they did meanwhile.
int show_status(const std::string& folder) {
    constexpr auto kBetween = std::chrono::milliseconds(2500);
    const Spool spool = Spool::open(folder);
    const auto before = spool.workers();
    const auto coordinator_before = spool.coordinator();
    std::this_thread::sleep_for(kBetween);
    std::vector<std::vector<std::string>> rows;
    for (const auto& [id, worker] : spool.workers()) {
        const auto then = before.find(id);
        const bool beats = then == before.end() || then->second.beat != worker.beat;
        const double rate = then == before.end() ? 0 : static_cast<double>(worker.done - then->second.done) / 2.5;
        rows.push_back({worker.node, id, std::to_string(worker.hands), std::to_string(worker.done),
                        fmt::format("{:.1f}", rate), state_of(worker, beats)});
    }
    const auto coordinator = spool.coordinator();
    const bool leads = coordinator && coordinator_before && coordinator->beat != coordinator_before->beat;
    std::cout << terminal_text(
        fmt::format("{}\ncoordinator: {}\njobs: {} waiting, {} being done, {} done, {} lost, {} given up\n",
                    spool.identity().purpose, leads ? "works" : "silent (start the same command again to go on)",
                    spool.listed("jobs").size(), spool.leases().size(), coordinator ? coordinator->done : 0,
                    coordinator ? coordinator->lost : 0, coordinator ? coordinator->given_up : 0));
    std::cout << terminal_text(aligned_table({"node", "worker", "hands", "done", "per s", "state"}, rows));
    return kDone;
}

}  // namespace

void add_work(CLI::App& app, Action& action) {
    auto words = std::make_shared<WorkArguments>();
    CLI::App* command = app.add_subcommand("work", "Do a share of what grade --on or study --on gives out");
    command->add_option("SPOOL", words->spool, "The folder through which it is given out")->required();
    command->add_flag("--status", words->status, "Show who works there, how quickly, and what failed; do nothing");
    command
        ->add_option("--hands", words->hands,
                     "Jobs at once, each in a process; as many as there are cores unless given")
        ->type_name("N")
        ->check(CLI::Range(0, 256));
    command->add_option("--node", words->node, "What this machine is called there; its own name unless given")
        ->type_name("NAME");
    command->footer(
        "grade --on and study --on start workers by themselves; another may be started by hand on any machine that\n"
        "sees the folder. It ends when the work is done, when nobody leads it any more, or by SIGTERM, which gives "
        "back\n"
        "what it has begun.\n"
        "Example:  dynlab work --status marks/.spool\n"
        "Exit codes: 0 done, 1 this machine must not work there, 2 wrong usage.");
    command->callback(
        [words, &action] { action = [words] { return words->status ? show_status(words->spool) : work(*words); }; });
}

}  // namespace dynlab::inline cli
