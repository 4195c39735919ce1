#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/course/part_options.h"
#include "cli/options/run_command.h"
#include "platform/error.h"
#include "workflow/notebooks/notebook.h"
#include "workflow/parts/study_parts.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct StudyArguments {
    RunArguments run;
    PartOptions parts;
};

int study(const StudyArguments& args) {
    const PercentScript script = read_script_or_notebook(args.run.file);
    const std::uint32_t seed = args.run.seed.value().value_or(script.header.seed);
    const fs::path out = args.run.out.empty() ? figures_folder(args.run.file) : fs::path(args.run.out),
                   folder = out / "parts";
    const auto missing = [&](int count) { return run_study_part(script, seed, folder, count, {}); };
    if (const auto part = args.parts.chosen()) {
        note_parts(folder, part->count);
        const bool goes_on = !run_study_part(script, seed, folder, part->count, part).parts.empty();
        std::cout << "part " << part->text()
                  << (goes_on ? ": done until another part is needed; each call needs all parts of the previous call\n"
                              : ": nothing left to do\n");
        return kDone;
    }
    if (!args.parts.on.empty() && !done_on(args.parts.on, folder, missing)) return kDone;
    const int count = noted_parts(folder);
    if (args.parts.join) refuse_missing_parts(missing(count).parts, count);
    StudyParts joined(folder, script, seed, count, {});
    return run_and_show(args.run, &joined);
}

}  // namespace

void add_study(CLI::App& app, Action& action) {
    auto args = std::make_shared<StudyArguments>();
    CLI::App* command = app.add_subcommand("study", "Run a script and compute its montecarlo calls in parts");
    command->add_option("FILE", args->run.file, "Script to run")->required()->check(CLI::ExistingFile);
    args->parts.add_to(*command);
    command->add_option("--out", args->run.out, "Folder for figures, saved files and the run results (record.json)")
        ->type_name("DIR");
    command->add_flag("--force", args->run.force, "Let the script replace files that dynlab did not write");
    args->run.seed.add_to(*command);
    command->footer(
        "The results are identical to the results of dynlab run, bit for bit, but the calls of montecarlo are computed "
        "in\nparts. Each part runs the script up to the call, so your own functions can be\nestimators. The code "
        "before the call should be fast and must not depend on the time. A script with two montecarlo calls needs its "
        "parts twice. Existing parts are\nnot computed again.\nExample:  dynlab study bias.lua --on processes:8\nExit "
        "codes: 0 done, 1 the script failed or parts are missing, 2 wrong usage.");
    command->callback([args, &action] {
        expect_script(args->run.file, "study");
        if (!args->parts.any())
            throw CLI::ValidationError("study", "give --part, --join or --on; without parts, use dynlab run");
        if (args->run.seed.text == "random")
            throw CLI::ValidationError("--seed", "a random seed differs from part to part; give a number");
        action = [args] { return study(*args); };
    });
}

}  // namespace dynlab::inline cli
