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
#include "course/grading/grade_folder.h"
#include "course/grading/grading_memory.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/terminal/terminal_text.h"
#include "platform/text/read_number.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct GradeArguments {
    std::string submissions, lesson, out, checks, secret, roster, owners, deadlines, times, timezone, keep, isolation;
    std::vector<std::string> only;
    PartOptions parts;
    int jobs = 0, timeout = 0;
    bool regrade = false, again = false, no_pdf = false, answers = false, force = false, accept_late = false;
};

constexpr char kNone[] = "none";  // of a file that OUT was made with
constexpr int kTimeout = 60;

std::optional<fs::path> given(const std::string& path) {
    return path.empty() || path == kNone ? std::nullopt : std::optional<fs::path>(path);
}

/// What is not given is as it was when OUT was made.
GradeArguments completed(GradeArguments words) {
    const RememberedOptions then = remembered_options(words.out).value_or(RememberedOptions{});
    const auto take = [](std::string& word, const std::string& before, const char* otherwise = "") {
        if (word.empty()) word = before.empty() ? otherwise : before;
    };
    take(words.lesson, then.lesson);
    take(words.checks, then.checks);
    take(words.secret, then.secret);
    take(words.roster, then.roster);
    take(words.owners, then.owners);
    take(words.deadlines, then.deadlines);
    take(words.times, then.times);
    take(words.timezone, then.timezone);
    take(words.keep, then.keep, "best");
    take(words.isolation, then.isolation, "full");
    if (words.timeout == 0) words.timeout = then.timeout > 0 ? then.timeout : kTimeout;
    return words;
}

/// In a task of Slurm the cores that it has; one of a part, as other parts have the others.
int jobs_for(const GradeArguments& words) {
    if (words.jobs > 0) return words.jobs;
    const char* const slurm = std::getenv("SLURM_CPUS_PER_TASK");
    if (const auto cores = slurm ? read_number<int>(slurm) : std::nullopt; cores && *cores > 0) return *cores;
    return words.parts.part.empty() ? static_cast<int>(std::max(1u, std::thread::hardware_concurrency())) : 1;
}

FolderRequest request_of(const GradeArguments& words) {
    FolderRequest request;
    GradingOptions& options = request.options;
    options.out = words.out;
    options.setup.lesson = find_lesson(words.lesson);
    options.setup.more_checks = given(words.checks);
    options.setup.isolation = words.isolation == "full" ? Isolation::kFull : Isolation::kProcess;
    options.setup.time.processor = std::chrono::seconds(words.timeout);
    options.setup.program = running_program();
    if (const auto secret = given(words.secret)) {
        request.secret = *secret;
        options.setup.secret = read_file(*secret);
        if (options.setup.secret.empty())
            throw EnvironmentError("{} is empty: hidden records drawn from it would be no secret", words.secret);
    }
    options.setup.jobs = jobs_for(words);
    options.regrade = words.regrade;
    options.pdf = !words.no_pdf;
    options.above_maximum = words.force;
    ClassSources& sources = request.sources;
    sources.submissions = words.submissions;
    sources.roster = given(words.roster);
    sources.owners = given(words.owners);
    sources.deadlines = given(words.deadlines);
    sources.newest_counts = words.keep == "newest";
    sources.only = words.only;
    sources.timezone = words.timezone;
    sources.times = given(words.times);
    sources.accept_late = words.accept_late;
    request.again = words.again;
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

int grade(const GradeArguments& given_words) {
    const GradeArguments words = completed(given_words);
    const FolderRequest request = request_of(words);
    const GradingOptions& options = request.options;
    if (options.setup.secret.empty())
        std::cerr << "dynlab: no --secret FILE: anybody who reads the project can compute the hidden records\n";
    const FolderGrading grading(request);
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
    command->add_option("--lesson", words->lesson, "The lesson whose checks are used; required for a new OUT")
        ->type_name("NN");
    command
        ->add_option(
            "--out", words->out,
            "Folder for the results; kept and added to. A later call goes on with the options it was made with")
        ->type_name("OUT")
        ->required();
    command->add_option("--checks", words->checks, "Folder with your own checks (*.lua), which students never see")
        ->type_name("FOLDER");
    add_secret_option(*command, words->secret);
    command
        ->add_option("--roster", words->roster,
                     "CSV with the columns id, name, group (also language: en or fr): a row of marks a student")
        ->type_name("CSV")
        ->check(CLI::ExistingFile | CLI::IsMember({kNone}));
    command
        ->add_option("--owners", words->owners,
                     "CSV with the columns submission and group (or id): whose those are that no name tells")
        ->type_name("CSV")
        ->check(CLI::ExistingFile | CLI::IsMember({kNone}));
    command->add_option("--keep", words->keep, "Which of several submissions of one student counts. Default: best")
        ->type_name("best|newest")
        ->check(CLI::IsMember({"best", "newest"}));
    command
        ->add_option("--deadlines", words->deadlines,
                     "CSV with the columns submission (a group, an id, or *), deadline, extra, grace, ...")
        ->type_name("CSV")
        ->check(CLI::ExistingFile | CLI::IsMember({kNone}));
    command
        ->add_option(
            "--times", words->times,
            "When each was submitted: Moodle's grading worksheet or another CSV (column id, identifier, group, "
            "name or mail, and time). Default: the times of the files")
        ->type_name("CSV")
        ->check(CLI::ExistingFile | CLI::IsMember({kNone}));
    command
        ->add_option("--timezone", words->timezone,
                     "Time zone of deadlines and of times in zips. Default: this machine's")
        ->type_name("ZONE");
    command
        ->add_option("--only", words->only,
                     "Grade this submission only, by its name, group, id or student; may be repeated")
        ->type_name("NAME");
    command->add_flag("--again", words->again, "Grade all with these inputs where OUT was made with others");
    words->parts.add_to(*command);
    CLI::Option* const regrade =
        command->add_flag("--regrade", words->regrade, "Grade those again that have a result; your own marks stay");
    for (const char* option : {"--part", "--join", "--on"}) regrade->excludes(command->get_option(option));
    command->add_option("--jobs", words->jobs, "So many at once; as many as there are cores unless given")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    command
        ->add_option("--timeout", words->timeout,
                     "Processor time of each run of a script, in seconds; by the clock a run may take five times as "
                     "long. Default: 60")
        ->type_name("S")
        ->check(CLI::Range(1, 3600));
    command
        ->add_option("--isolation", words->isolation,
                     "full: file system, network and processes of its own. Default: full")
        ->type_name("full|process")
        ->check(CLI::IsMember({"full", "process"}));
    command->add_flag(
        "--answers", words->answers,
        "Model answers for all, OUT/model_answers.pdf: the worked solution's text; dynlab hand-back adds them");
    command->add_flag("--force", words->force, "Take marks in marks.csv that are above the points of their check");
    command->add_flag("--accept-late", words->accept_late, "Apply penalties of half the points or more");
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
        "OUT remembers the options it was made with: a later call needs FOLDER and --out only. Other checks, secrets,\n"
        "deadlines and owners are refused unless --again is given (a roster may be corrected); --roster none, and so\n"
        "on, goes on without that file. What the scripts did is kept, so --again takes seconds.\n"
        "A script that uses more processor time than --timeout is ended, and one that takes five times as long by the\n"
        "clock; answers that it gave before count.\n"
        "Deadlines: submission, deadline, and where wanted extra (\"2 d\" beyond the deadline of *), received, grace\n"
        "(\"15 min\"), percent_per_day, most_percent; what a row leaves empty is as in the row of *.\n"
        "A penalty of half the points or more is not applied until --accept-late is given once, or the row received\n"
        "says when it came.\n"
        "What cannot be read (a PDF alone, a .rar, another lesson's script) is \"unreadable\": it has no marks until "
        "you\n"
        "give some in marks.csv. What needs attention is listed here and in the summary: that, what belongs to\n"
        "nobody in the roster, scripts that stop, late submissions with a penalty, several of one student.\n"
        "Exit codes: 0 all is graded, 1 something is left ungraded, unreadable, unconfirmed or nobody's, 2 wrong "
        "usage.");
    command->callback([words, &action] {
        if (words->lesson.empty() && !remembered_options(words->out)) throw CLI::RequiredError("--lesson");
        action = [words] { return grade(*words); };
    });
}

}  // namespace dynlab::inline cli
