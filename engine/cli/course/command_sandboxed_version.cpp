#include "cli/commands.h"
#include "cli/sandbox_job.h"
#include "course/review/version_description.h"

namespace dynlab::inline cli {

void add_sandboxed_version(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("boxed", "Internal: create the report of a pack in a sandbox")->group("");
    command->add_option("work", "version")->required()->check(CLI::IsMember({VersionJob::kWork}));
    command->callback([&action] {
        action = [] {
            do_sandbox_job(make_version);
            return int(kDone);
        };
    });
}

}  // namespace dynlab::inline cli
