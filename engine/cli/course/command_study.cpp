#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/course/share_options.h"
#include "cli/options/run_command.h"
#include "workflow/shares/shared_study.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct StudyArguments {
    RunArguments run;
    std::string on, spool;
    int lease = 30;
};

/// The queue lies in the folder of the study's figures, which the other machines must see.
class StudySharing : public RunSharing {
  public:
    explicit StudySharing(const StudyArguments& args) : args_(args) {}

    SharedPieces& begin(const fs::path& out, std::uint32_t seed) override {
        SharedStudy::Request request;
        request.script = args_.run.file;
        request.seed = seed;
        request.on = args_.on;
        fs::create_directories(out);
        request.spool = args_.spool.empty() ? out / ".spool" : fs::path(args_.spool);
        request.key = out / ".spool.key";
        request.lease_seconds = args_.lease;
        return study_.emplace(request);
    }
    std::vector<std::string> end(bool succeeded) override {
        if (succeeded) study_->conclude();
        std::vector<std::string> notes;
        for (const Message& note : study_->notes()) notes.push_back(message_text(note));
        return notes;
    }

  private:
    const StudyArguments& args_;
    std::optional<SharedStudy> study_;
};

}  // namespace

void add_study(CLI::App& app, Action& action) {
    auto words = std::make_shared<StudyArguments>();
    CLI::App* command = app.add_subcommand("study", "Run a script whose montecarlo and srivcstruc others share");
    command->add_option("FILE", words->run.file, "The script")->required()->check(CLI::ExistingFile);
    add_share_options(*command, words->on, words->spool, words->lease);
    command->get_option("--on")->required();
    command->add_option("--out", words->run.out, "Folder for figures, saved files and the run's record (record.json)")
        ->type_name("DIR");
    command->add_flag("--force", words->run.force, "Let the script replace files that no run of dynlab wrote");
    words->run.seed.add_to(*command);
    command->footer(
        "Everything is as with dynlab run, to the last bit, but these calls are made in parts by all workers. Each "
        "runs\n"
        "the script up to the call, so that functions of yours are estimators as well as any; what comes before "
        "should\n"
        "be quick, and must not ask for the time. A study that was ended goes on with the parts that were made.\n"
        "Example:  dynlab study bias.lua --on processes:8\n"
        "Exit codes: 0 done, 1 the script failed, 2 wrong usage.");
    command->callback([words, &action] {
        expect_script(words->run.file, "study");
        action = [words] {
            StudySharing sharing(*words);
            return run_and_show(words->run, &sharing);
        };
    });
}

}  // namespace dynlab::inline cli
