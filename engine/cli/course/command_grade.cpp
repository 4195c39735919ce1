#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <thread>

#include "base/reader.h"
#include "cli/commands.h"
#include "cli/course/grading_options.h"
#include "cli/course/share_options.h"
#include "cli/document_command.h"
#include "course/grading/grading.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct GradeArguments {
    std::string submissions, lesson, out, checks, secret, roster, owners, deadlines, times, timezone, on, spool,
        keep = "best", isolation = "full";
    std::vector<std::string> only;
    int jobs = 0, timeout = 60, lease = 30;
    bool regrade = false, again = false, no_pdf = false, answers = false, accept_late = false;
};

std::optional<fs::path> given(const std::string& path) {
    return path.empty() ? std::nullopt : std::optional<fs::path>(path);
}

std::string eye_text(const GradingOutcome& outcome) {
    if (outcome.eye.empty()) return "";
    std::string text =
        fmt::format("{} your eye:\n", outcome.eye.size() == 1 ? "1 needs" : fmt::format("{} need", outcome.eye.size()));
    for (const Message& sentence : outcome.eye) text += "  " + terminal_text(message_text(sentence)) + "\n";
    return text;
}

std::string late_text(const GradingOutcome& outcome) {
    if (outcome.late.empty()) return "";
    std::string text = fmt::format("{} late:\n", outcome.late.size());
    for (const Message& clause : outcome.late) text += "  " + terminal_text(message_text(clause)) + "\n";
    return text;
}

int grade(const GradeArguments& words) {
    GradingRequest request;
    request.submissions = words.submissions;
    request.out = words.out;
    request.setup.lesson = find_lesson(words.lesson);
    request.setup.more_checks = given(words.checks);
    request.setup.isolation = words.isolation == "full" ? Isolation::kFull : Isolation::kProcess;
    request.setup.time.processor = std::chrono::seconds(words.timeout);
    request.setup.program = running_program();
    if (!words.secret.empty()) {
        request.setup.secret = read_file(words.secret);
        if (request.setup.secret.empty())
            throw EnvironmentError("{} is empty: hidden records drawn from it would be no secret", words.secret);
    }
    request.roster = given(words.roster);
    request.owners = given(words.owners);
    request.deadlines = given(words.deadlines);
    request.newest_counts = words.keep == "newest";
    request.only = words.only;
    request.setup.jobs =
        words.jobs > 0 ? words.jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    request.timezone = words.timezone;
    request.times = given(words.times);
    request.accept_late = words.accept_late;
    request.again = words.again;
    request.regrade = words.regrade;
    request.pdf = !words.no_pdf;
    request.on = words.on;
    request.spool = given(words.spool);
    request.lease_seconds = words.lease;
    if (words.secret.empty())
        std::cerr << "dynlab: no --secret FILE: anybody who reads the project can compute the hidden records\n";
    const GradingOutcome outcome = grade_class(request);
    for (const Message& note : outcome.notes)
        std::cerr << "dynlab: note: " << terminal_text(message_text(note)) << '\n';
    for (const Message& complaint : outcome.complaints)
        std::cerr << "dynlab: " << terminal_text(message_text(complaint)) << '\n';
    std::cout << fmt::format("{}: {} graded now, {} unchanged{}; isolation {}\n",
                             message_text(plural(outcome.submissions, "{} submission", "{} submissions")), outcome.made,
                             outcome.kept,
                             outcome.not_whole > 0 ? fmt::format(", {} with ungraded checks", outcome.not_whole) : "",
                             isolation_name(request.setup.isolation))
              << late_text(outcome) << eye_text(outcome) << (request.out / "gradebook.csv").string() << '\n'
              << (request.out / (request.pdf ? "summary.pdf" : "summary.md")).string() << '\n';
    const fs::path answers = request.out / (request.pdf ? "model_answers.pdf" : "model_answers.md");
    if (words.answers) make_document(model_answers_of(request.setup.lesson, answers), false);
    const bool all_is_graded = outcome.not_whole + outcome.unreadable + outcome.unowned + outcome.unconfirmed == 0;
    return all_is_graded && outcome.complaints.empty() ? kDone : kFailed;
}

}  // namespace

void add_grade(CLI::App& app, Action& action) {
    auto words = std::make_shared<GradeArguments>();
    CLI::App* command = app.add_subcommand("grade", "Grade the submissions of a class: marks, feedback, summary");
    command
        ->add_option("FOLDER", words->submissions,
                     "Submissions: folders, packs, zips, or what Moodle or Canvas exports")
        ->required();
    command->add_option("--lesson", words->lesson, "The lesson whose checks hold")->type_name("NN")->required();
    command->add_option("--out", words->out, "Folder for the results; kept and added to")->type_name("OUT")->required();
    command->add_option("--checks", words->checks, "Folder with your own checks (*.lua), which students never see")
        ->type_name("FOLDER");
    add_secret_option(*command, words->secret);
    command
        ->add_option("--roster", words->roster,
                     "CSV with the columns id, name, group (also language: en or fr): a row of marks a student")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--owners", words->owners,
                     "CSV with the columns submission and group (or id): whose those are that no name tells")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command->add_option("--keep", words->keep, "Which counts where somebody handed in several times")
        ->type_name("best|newest")
        ->capture_default_str()
        ->check(CLI::IsMember({"best", "newest"}));
    command
        ->add_option("--deadlines", words->deadlines,
                     "CSV with the columns submission (a group, an id, or *), deadline, extra, grace, ...")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option(
            "--times", words->times,
            "When each was submitted: Moodle's grading worksheet or another CSV (column id, identifier, group, "
            "name or mail, and time). Default: the times of the files")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--timezone", words->timezone,
                     "Time zone of deadlines and of times in zips. Default: this machine's")
        ->type_name("ZONE");
    command->add_flag("--accept-late", words->accept_late, "Apply penalties of half the points or more");
    command
        ->add_option("--only", words->only,
                     "Grade this submission only, by its name, group, id or student; may be repeated")
        ->type_name("NAME");
    command->add_flag("--again", words->again, "Grade all with these inputs where OUT was made with others");
    command->add_flag("--regrade", words->regrade, "Grade those again that have a result; your own marks stay");
    command->add_option("--jobs", words->jobs, "So many at once; as many as there are cores unless given")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    add_share_options(*command, words->on, words->spool, words->lease);
    add_timeout_option(*command, words->timeout);
    command->add_option("--isolation", words->isolation, "full: file system, network and processes of its own")
        ->type_name("full|process")
        ->capture_default_str()
        ->check(CLI::IsMember({"full", "process"}));
    command->add_flag(
        "--answers", words->answers,
        "Model answers for all, OUT/model_answers.pdf: the worked solution's text; dynlab hand-back adds them");
    command->add_flag("--no-pdf", words->no_pdf, "Feedback and summary as Markdown only");
    command->footer(
        "Every submission is run and checked alone in a box; what it breaks is its own. A run that was ended goes on\n"
        "where it was. Your own marks go into OUT/manual.csv (submission,check,points,reason) and survive every "
        "regrade.\n"
        "In OUT: gradebook.csv, summary.pdf, and for each submission results/NAME/results.json (Gradescope),\n"
        "feedback.md and feedback.pdf.\n"
        "Example:  dynlab grade handed-in --lesson 04 --out marks --secret secret.txt --roster roster.csv\n"
        "OUT remembers the lesson, checks, secret, roster and deadlines it was made with and refuses others unless\n"
        "--again is given (a roster may be mended, but not left out); what the scripts did is kept, so that --again\n"
        "with other checks or deadlines takes seconds.\n"
        "A script that uses more processor time than --timeout is ended, and one that takes five times as long by the\n"
        "clock; answers that it gave before count.\n"
        "Deadlines: submission, deadline, and where wanted extra (\"2 d\" beyond the deadline of *), received, grace\n"
        "(\"15 min\"), percent_per_day, most_percent; what a row leaves empty is as in the row of *.\n"
        "A penalty of half the points or more is not applied until --accept-late is given once, or the row received\n"
        "says when it came.\n"
        "What cannot be read (a PDF alone, a .rar, another lesson's script) is \"unreadable\": it has no marks until "
        "you\n"
        "give some in manual.csv. It is listed under \"need your eye\", as is what belongs to nobody in the roster.\n"
        "Exit codes: 0 all is graded, 1 something is left ungraded, unreadable, unconfirmed or nobody's, 2 wrong "
        "usage.");
    command->callback([words, &action] { action = [words] { return grade(*words); }; });
}

}  // namespace dynlab::inline cli
