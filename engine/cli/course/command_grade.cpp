#include <fmt/format.h>

#include <cstdlib>
#include <iostream>
#include <memory>
#include <thread>

#include "base/reader.h"
#include "cli/commands.h"
#include "cli/course/grading_options.h"
#include "cli/course/grading_report.h"
#include "cli/course/part_options.h"
#include "cli/document_command.h"
#include "course/office/folder_grading.h"
#include "platform/program_lookup.h"
#include "platform/terminal/terminal_text.h"
#include "platform/text/read_number.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct GradeArguments {
    FolderRequest request;
    std::string submissions, out;
    PartOptions parts;
    int jobs = 0;
    bool no_pdf = false, answers = false;
};

/// In a task of Slurm the cores that it has; one of a part, as other parts have the others.
int jobs_for(const GradeArguments& words) {
    if (words.jobs > 0) return words.jobs;
    const char* const slurm = std::getenv("SLURM_CPUS_PER_TASK");
    if (const auto cores = slurm ? read_number<int>(slurm) : std::nullopt; cores && *cores > 0) return *cores;
    return words.parts.part.empty() ? static_cast<int>(std::max(1u, std::thread::hardware_concurrency())) : 1;
}

FolderRequest request_of(const GradeArguments& words) {
    FolderRequest request = words.request;
    request.submissions = words.submissions, request.out = words.out;
    request.grading.setup.program = running_program();
    request.grading.setup.jobs = jobs_for(words);
    request.grading.pdf = !words.no_pdf;
    request.part = words.parts.chosen();
    return request;
}

int grade_part(const FolderGrading& grading, const WorkPart& part) {
    const GradingOutcome outcome = grading.grade_part();
    show_complaints(outcome);
    std::cout << fmt::format("part {}: {} graded now, {} unchanged, {} could not be graded\n", part.text(),
                             outcome.made, outcome.kept, outcome.failed);
    return outcome.failed == 0 ? kDone : kFailed;
}

int grade(const GradeArguments& words) {
    const FolderRequest request = request_of(words);
    FolderGrading grading(request);
    const GradingOptions& options = grading.options();
    if (options.setup.secret.empty())
        std::cerr << "dynlab: no --secret FILE: anybody who reads the project can compute the hidden records\n";
    const fs::path parts = options.out / "parts";
    if (request.part) {
        note_parts(parts, request.part->count);
        return grade_part(grading, *request.part);
    }
    const auto missing = [&](int count) { return grading.missing(count); };
    if (!words.parts.on.empty() && !done_on(words.parts.on, parts, missing)) return kDone;
    if (words.parts.join) refuse_missing_parts(missing(noted_parts(parts)).parts, noted_parts(parts));
    const GradingOutcome outcome = grading.grade();
    const int code = show_grading(outcome, options.setup.isolation, options.out, options.pdf);
    const fs::path answers = options.out / (options.pdf ? "model_answers.pdf" : "model_answers.md");
    if (words.answers) make_document(model_answers_of(options.setup.lesson, answers), false);
    return code;
}

}  // namespace

void add_grade(CLI::App& app, Action& action) {
    auto words = std::make_shared<GradeArguments>();
    CLI::App* command = app.add_subcommand("grade", "Grade the submissions of a class: marks, feedback, summary");
    command
        ->add_option("FOLDER", words->submissions,
                     "Submissions: folders, packs, zips, or what Moodle or Canvas exports")
        ->required();
    command->add_option("--lesson", words->request.lesson, "The lesson whose checks are used; required for a new OUT")
        ->type_name("NN");
    command
        ->add_option(
            "--out", words->out,
            "Folder for the results; kept and added to. A later call goes on with the options it was made with")
        ->type_name("OUT")
        ->required();
    command
        ->add_option("--checks", words->request.checks, "Folder with your own checks (*.lua), which students never see")
        ->type_name("FOLDER");
    command->add_option("--secret", words->request.secret, "File whose content the hidden records are drawn from")
        ->type_name("FILE")
        ->check(CLI::ExistingFile | CLI::IsMember({kNoFile}));
    command
        ->add_option("--roster", words->request.roster,
                     "CSV with the columns id, name, group (also language: en or fr): a row of marks a student")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--owners", words->request.owners,
                     "CSV with the columns submission and group (or id): whose those are that no name tells")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--keep", words->request.keep, "Which of several submissions of one student counts. Default: best")
        ->type_name("best|newest")
        ->check(CLI::IsMember({"best", "newest"}));
    command
        ->add_option("--deadlines", words->request.deadlines,
                     "CSV with the columns submission (a group, an id, or *), deadline, extra, grace, ...")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option(
            "--times", words->request.times,
            "When each was submitted: Moodle's grading worksheet or another CSV (column id, identifier, group, "
            "name or mail, and time). Default: the times of the files")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--timezone", words->request.timezone,
                     "Time zone of deadlines and of times in zips. Default: this machine's")
        ->type_name("ZONE");
    command
        ->add_option("--only", words->request.grading.only,
                     "Grade this submission only, by its name, group, id or student; may be repeated")
        ->type_name("NAME");
    command->add_flag("--again", words->request.again, "Grade all with these inputs where OUT was made with others");
    words->parts.add_to(*command);
    CLI::Option* const regrade = command->add_flag("--regrade", words->request.grading.regrade,
                                                   "Grade those again that have a result; your own marks stay");
    for (const char* option : {"--part", "--join", "--on"}) regrade->excludes(command->get_option(option));
    command->add_option("--jobs", words->jobs, "So many at once; as many as there are cores unless given")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    command
        ->add_option("--timeout", words->request.timeout,
                     "Processor time of each run of a script, in seconds; by the clock a run may take five times as "
                     "long. Default: 60")
        ->type_name("S")
        ->check(CLI::Range(1, 3600));
    command
        ->add_option("--isolation", words->request.isolation,
                     "full: file system, network and processes of its own. Default: full")
        ->type_name("full|process")
        ->check(CLI::IsMember({"full", "process"}));
    command->add_flag(
        "--answers", words->answers,
        "Model answers for all, OUT/model_answers.pdf: the worked solution's text; dynlab hand-back adds them");
    command->add_flag("--force", words->request.grading.above_maximum,
                      "Take marks in marks.csv that are above the points of their check");
    command->add_flag("--accept-late", words->request.accept_late, "Apply penalties of half the points or more");
    command->add_flag("--no-pdf", words->no_pdf, "Feedback and summary as Markdown only");
    command->footer(
        "Every submission is run and checked alone in a box; what it breaks is its own. A run that was ended goes on\n"
        "where it was. Your own marks go into OUT/marks.csv (who,check,points,reason) and survive every regrade: who "
        "is a\n"
        "group, an id, a name or a submission, check is a check or * for the whole submission. Checks that "
        "need a mark by hand\n"
        "get rows there; dynlab never takes one away.\n"
        "In OUT: gradebook.csv, summary.pdf, and for each submission results/NAME/results.json (Gradescope),\n"
        "feedback.md and feedback.pdf.\n"
        "Example:  dynlab grade handed-in --lesson 04 --out marks --secret secret.txt --roster roster.csv\n"
        "OUT holds a course (OUT/course) that keeps every version of each submission, the roster, deadlines and "
        "owners, "
        "and\n"
        "the options: a later call needs FOLDER and --out only. Other checks, secrets and deadlines are refused "
        "unless\n"
        "--again is given; --checks none and --secret none go on without them. What the scripts did is kept, so "
        "--again\n"
        "takes seconds.\n"
        "A script that uses more processor time than --timeout is ended, and one that takes five times as long by the\n"
        "clock; answers that it gave before count.\n"
        "Deadlines: submission, deadline, and where wanted extra (\"2 d\" beyond the deadline of *) and received; in "
        "the "
        "row\n"
        "of * also grace (\"15 min\"), percent_per_day and most_percent, for all.\n"
        "A penalty of half the points or more is not applied until --accept-late is given once, or the row received\n"
        "says when it came.\n"
        "What cannot be read (a PDF alone, a .rar, another lesson's script) is \"unreadable\": it has no marks until "
        "you\n"
        "give some in marks.csv. What needs attention is listed here and in the summary: that, what belongs to\n"
        "nobody in the roster, scripts that stop, late submissions with a penalty, several of one student.\n"
        "Exit codes: 0 all is graded, 1 something is left ungraded, unreadable, unconfirmed or nobody's, 2 wrong "
        "usage.");
    command->callback([words, &action] {
        if (words->request.lesson.empty() && !is_graded_folder(words->out)) throw CLI::RequiredError("--lesson");
        action = [words] { return grade(*words); };
    });
}

}  // namespace dynlab::inline cli
