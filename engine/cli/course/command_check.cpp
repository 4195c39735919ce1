#include <fmt/format.h>

#include <cstdlib>
#include <iostream>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/options/script_options.h"
#include "cli/say.h"
#include "course/grading/folder_check.h"
#include "course/issues/issues_report.h"
#include "course/issues/lesson_reader.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/activity_line.h"
#include "platform/terminal/progress.h"
#include "platform/terminal/terminal_output.h"
#include "platform/terminal/terminal_text.h"
#include "platform/text/small_letters.h"
#include "workflow/given_script.h"
#include "workflow/notebooks/notebook.h"
#include "workflow/script_folder.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct CheckArguments {
    std::string subject, template_name, roster;
    int pages = 0;
    bool as_json = false, document_only = false;
};

/// The people of the roster, and the owner of this account.
std::shared_ptr<const IdentityMatcher> matcher_for(const CheckArguments& args) {
    auto names = std::make_shared<IdentityMatcher>();
    if (!args.roster.empty()) {
        const Roster roster(args.roster);
        if (const Message too_short = numbers_too_short(roster.students()); !too_short.empty())
            std::cerr << terminal_text(fmt::format("dynlab: {}: {}\n", args.roster, message_text(too_short)));
        *names = IdentityMatcher(roster.students());
        names->add_cited(cited_authors());
    }
    if (const char* home = std::getenv("HOME")) names->add_account(home);
    return names;
}

/// Checks a single script as its folder would be checked.
CheckResult check_script(const fs::path& script, const CheckOptions& check_options) {
    const TemporaryFolder folder;
    make_script_folder(script, folder.path());
    CheckResult result = check_folder(folder.path(), running_program(), check_options);
    result.subject = script.string();
    const std::string name = script.filename().string(), pdf = fs::path(name).replace_extension(".pdf").string();
    const std::string source = is_notebook(script) ? read_file(folder.path() / "analysis.lua") : "";
    const auto placed = [&](const auto& text) {
        return source.empty() ? text : with_places_in_notebook(text, "analysis.lua", name, source);
    };
    const auto renamed = [&](const std::string& text) {
        return replaced(replaced(replaced(text, "analysis.lua", name), "report.pdf", pdf), "FOLDER", name);
    };
    for (Message& part : result.checked) part = with_changed_text(part, renamed);
    for (Issue& issue : result.findings) {
        issue.place = renamed(placed(issue.place));
        issue.what = with_changed_text(placed(issue.what), renamed);
        issue.remedy = with_changed_text(placed(issue.remedy), renamed);
    }
    return result;
}

bool is_script(const fs::path& subject) {
    return fs::is_regular_file(subject) && (subject.extension() == ".lua" || is_notebook(subject));
}

/// Findings are read in the language of the work.
LessonReader reader_for(const fs::path& subject, const CheckResult& result) {
    std::string language = result.language;
    if (fs::is_directory(subject)) language = language_of_work(subject);
    if (is_script(subject)) language = read_script_or_notebook(subject).header.language;
    return LessonReader(language, result.lesson);
}

Message words_of(CheckStep step) {
    if (step == CheckStep::kAnalysis) return Message("running the analysis");
    return step == CheckStep::kLessonChecks ? Message("running the lesson's checks") : Message("reading the report");
}

CheckResult check_work(const fs::path& subject, CheckOptions check_options) {
    if (!fs::is_directory(subject) && !is_script(subject)) return check_pdf(subject, check_options);
    constexpr std::size_t kSteps = 3;
    ActivityLine activity;
    check_options.begins = [&activity](CheckStep step) {
        activity.begin_step(message_text(words_of(step), user()));
        write_progress(static_cast<std::size_t>(step), kSteps);
    };
    return fs::is_directory(subject) ? check_folder(subject, running_program(), check_options)
                                     : check_script(subject, check_options);
}

int check(const CheckArguments& args) {
    CheckOptions check_options;
    if (args.pages > 0) check_options.pages = args.pages;
    check_options.lesson_checks = !args.document_only;
    const auto misuse = [](const Message& sentence) {
        complain(sentence);
        return kUsage;
    };
    try {
        check_options.names = matcher_for(args);
        if (!args.template_name.empty()) check_options.standard = standard_of(args.template_name);
    } catch (const std::runtime_error& error) {
        return misuse(message_of(error));
    }
    if (!fs::exists(args.subject)) return misuse(no_such_work(args.subject));
    CheckResult result = check_work(args.subject, check_options);
    if (args.subject == ".") result.subject = fs::current_path().filename().string();
    std::cout << (args.as_json ? issues_as_json(result)
                               : issues_as_text(result, in_color(), reader_for(args.subject, result).reader()));
    return result.passed() ? kDone : kFailed;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
    auto args = std::make_shared<CheckArguments>();
    CLI::App* command = app.add_subcommand("check", "Check a report for problems before submission");
    command->add_option("FOLDER|FILE.lua|FILE.ipynb|FILE.pdf", args->subject,
                        "Folder created by dynlab new, a script or notebook, or any PDF. Default: the current folder "
                        "if it contains analysis.lua.");
    command->add_option("--template", args->template_name, "Template to check against, such as lab_report or slides")
        ->type_name("NAME|FILE.md");
    command->add_option("--roster", args->roster, "People to search for as well: columns id, name, email, group")
        ->type_name("CSV");
    command->add_option("--pages", args->pages, "Maximum number of pages, instead of the template's")
        ->type_name("N")
        ->check(CLI::Range(1, 1000));
    command->add_flag("--document-only", args->document_only, "Skip the lesson's checks of the answers");
    command->add_flag("--json", args->as_json, "Print the issues found as JSON");
    command->footer(
        "dynlab runs the analysis in a clean copy of the folder and does not write into the folder. A single script, "
        "such\nas a session of dynlab app, is checked as a folder with the files that it names.\nThe template that "
        "analysis.lua specifies sets the rules. For a PDF alone, dynlab uses slides for wide pages,\npeer_review for "
        "the headings of a review, and lab_report for other documents. dynlab checks pages, sections, figures "
        "that\nthe text does not mention, placeholder text, languages, text size and margins. It searches for the "
        "members in\ngroup.toml and the people of a roster, and for home folders: in the text, bookmarks, link "
        "targets, document\ninformation and the file name (see dynlab help names).\nExamples:  dynlab check my-crane   "
        "  dynlab check report.pdf     dynlab check talk.pdf --template slides --json\nExit codes: 0 no rule is "
        "violated (there may be hints), 1 a rule is violated, 2 wrong usage.\nJSON: {subject, template, language, "
        "pages, passed, checked: [text],\n       findings: [{id, severity: \"rule\"|\"hint\", page, place, what, "
        "remedy}]}; unknown values are null.");
    command->callback([args, &action] {
        use_current_folder_by_default(args->subject, "check");
        if (ending_of(args->subject) != ".pdf") expect_script(args->subject, "check");
        action = [args] { return check(*args); };
    });
}

}  // namespace dynlab::inline cli
