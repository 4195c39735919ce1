#include <memory>

#include "cli/boxed_job.h"
#include "cli/commands.h"
#include "course/checks/check_descriptions.h"

namespace dynlab::inline cli {
namespace {

int boxed(const std::string& name) {
    if (name == RunJob::kWork)
        do_boxed_job(run_for_grading);
    else if (name == ChecksJob::kWork)
        do_boxed_job(try_checks);
    else if (name == UnpackJob::kWork)
        do_boxed_job(unpack_archive);
    else if (name == DocumentJob::kWork)
        do_boxed_job(make_boxed_document);
    else
        return kUsage;
    return kDone;
}

}  // namespace

void add_boxed(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("boxed", "What grade does inside a box; not for people")->group("");
    const auto name = std::make_shared<std::string>();
    command->add_option("work", *name, "run, checks, unpack or document")->required();
    command->callback([&action, name] { action = [name] { return boxed(*name); }; });
}

}  // namespace dynlab::inline cli
