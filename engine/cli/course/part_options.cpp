#include "cli/course/part_options.h"

#include <iostream>

#include "base/reader.h"
#include "platform/error.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {

void PartOptions::add_to(CLI::App& command) {
    const auto check = [](const std::string& given) -> std::string {
        return part_in(given) ? std::string() : "expected a part such as 3/8, not '" + given + "'";
    };
    CLI::Option* const one = command.add_option("--part", part, "Process one part of the work, on any machine")
                                 ->type_name("I/N")
                                 ->check(CLI::Validator(check, ""));
    CLI::Option* const all =
        command.add_flag("--join", join, "Join the parts after all of them are processed")->excludes(one);
    command
        .add_option("--on", on,
                    "Process and join the parts: slurm[:tasks=N,partition=P,...], hosts:HOST,N/HOST by ssh, or "
                    "processes:N; see dynlab help guide-cluster")
        ->type_name("WHERE")
        ->excludes(one)
        ->excludes(all);
}

bool done_on(const std::string& on, const std::filesystem::path& folder,
             const std::function<MissingParts(int parts)>& missing) {
    const Machines machines = machines_in(on);
    note_parts(folder, machines.parts);
    for (MissingParts left = missing(machines.parts), before; !left.parts.empty(); left = missing(machines.parts)) {
        if (left == before)
            throw EnvironmentError(
                "the parts were processed, but their results are not in {}; this folder must have the same path on all "
                "hosts",
                folder.parent_path().string());
        if (machines.kind == Machines::Kind::kSlurm) {
            std::cout << terminal_text(message_text(submit_to_slurm(machines, {folder, left.parts})));
            return false;
        }
        for (const Message& said : do_on_hosts(machines, {folder, left.parts}))
            std::cerr << "dynlab: note: " << terminal_text(message_text(said)) << '\n';
        before = left;
    }
    return true;
}

void refuse_missing_parts(const std::set<int>& missing, int parts) {
    if (missing.empty()) return;
    std::vector<std::string> commands;
    for (const int index : missing) commands.push_back(shown_command("--part " + WorkPart{index, parts}.text()));
    throw EnvironmentError("{}", plural(static_cast<std::int64_t>(missing.size()),
                                        "{} part of {} cannot be joined: it is missing, or was computed from other "
                                        "files or by another version of dynlab. Compute it with\n{}",
                                        "{} parts of {} cannot be joined: they are missing, or were computed from "
                                        "other files or by another version of dynlab. Compute them with\n{}",
                                        parts, listed(commands, Join::kLines)));
}

}  // namespace dynlab::inline cli
