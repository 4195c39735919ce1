#include <re2/re2.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "base/languages.h"
#include "cli/commands.h"
#include "cli/options/script_options.h"
#include "cli/say.h"
#include "course/export/bundle.h"
#include "course/grading/submission_files.h"
#include "course/intake/roster.h"
#include "documents/pdf/pdf_layout.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/terminal_text.h"
#include "workflow/given_script.h"
#include "workflow/make_report.h"
#include "workflow/script_folder.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct PackArguments {
    std::string subject, output, roster, language;
    std::optional<std::uint32_t> group_seed;
};

/// Whether the PDF is a draft, which contains ?? for missing results.
bool is_draft(const fs::path& pdf) {
    // Beside signs and units, not behind a word as a doubled question mark is.
    static const RE2 kGap(R"((^|[^A-Za-z?])\?\?([^?]|$))", RE2::Latin1);
    try {
        for (const PdfPage& page : read_pdf_layout(pdf).pages)
            for (const PdfWord& word : page.words)
                if (!word.fixed_width && RE2::PartialMatch(word.text, kGap)) return true;
    } catch (const PdfRefusal&) {  // then it was not made here
    }
    return false;
}

/// A report that was not made, or not made again after a change, is easily forgotten: people read the PDF.
void complain_about_report(const fs::path& folder, const std::string& subject) {
    if (!fs::exists(folder / "report.md")) return;
    std::optional<fs::file_time_type> made;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!entry.is_regular_file() || entry.path().extension() != ".pdf") continue;
        made = std::max(made.value_or(entry.last_write_time()), entry.last_write_time());
        if (is_draft(entry.path()))
            complain(Message("{} is a draft and contains \"??\"; to list the missing parts, run dynlab check {}",
                             entry.path().filename().string(), shell_word(subject)));
    }
    bool older = false;
    for (const char* source : {"report.md", "analysis.lua", "analysis.ipynb"})
        older = older || (made && fs::exists(folder / source) && fs::last_write_time(folder / source) > *made);
    if (!made)
        complain(
            Message("the pack has no PDF of the report; run dynlab report {}, then pack again", shell_word(subject)));
    else if (older)
        complain(Message(
            "the PDF in the pack is older than the report's text or script; run dynlab report {}, then pack again",
            shell_word(subject)));
}

int pack(const PackArguments& words) {
    fs::path folder = fs::absolute(words.subject).lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    const std::string own_name = (fs::is_directory(folder) ? folder.filename() : folder.stem()).string();
    const fs::path file = words.output.empty() ? fs::path(own_name + ".zip") : fs::path(words.output);
    const TemporaryFolder made;
    if (!fs::is_directory(folder)) {
        make_script_folder(folder, made.path());
        folder = made.path();
    }
    const Pack pack = pack_folder(folder, file);
    for (const std::string& name : pack.files) say(Message::verbatim(name));
    for (const std::string& name : pack.left_out) complain(Message("{} is not a regular file and was left out", name));
    const Message files = plural(static_cast<std::int64_t>(pack.files.size()), "{} file", "{} files");
    say(Message("{}: {}, SHA-256 {}", file.string(), files, pack.hash));
    complain_about_report(folder, words.subject);
    return kDone;
}

/// The task sheet in this language, or the lesson's own; nothing where it cannot be made, which is said once.
fs::path task_sheet(const Lesson& lesson, const std::string& language, const fs::path& folder) {
    const bool translated = !language.empty() && fs::exists(lesson.tasks(language));
    fs::create_directories(folder / language);
    const fs::path sheet = folder / language / (lesson.slug + "_sheet.pdf");
    if (fs::exists(sheet)) return sheet;
    try {
        const ReportResult made = make_report(sheet_of(lesson.folder.string(), sheet, translated ? language : ""));
        if (!made.error) return sheet;
        complain(Message("the task sheet is left out: {}", *made.error));
    } catch (const std::runtime_error& error) {
        complain(Message("the task sheet is left out: {}", message_of(error)));
    }
    return {};
}

/// One zip for each group of the roster, in the folder that is named, and the roster with the seeds that were drawn.
int bundle_groups(const Lesson& lesson, const PackArguments& words) {
    const fs::path folder = words.output.empty() ? fs::path(lesson.slug) : fs::path(words.output);
    const fs::path copy = folder / "roster.csv";
    std::vector<Student> students = Roster(words.roster).students(), earlier;
    const bool complete = std::ranges::all_of(students, [](const Student& one) { return one.seed.has_value(); });
    if (fs::exists(copy)) earlier = Roster(copy).students();
    std::vector<BundleOwner> owners;
    try {
        owners = bundle_owners(students, earlier);
    } catch (const EnvironmentError& error) {
        throw EnvironmentError("{}: {}", words.roster, error.message());
    }
    fs::create_directories(folder);
    if (!complete) write_file_atomically(copy, roster_text(students));  // first: keeps each group's data sets
    const TemporaryFolder sheets;
    std::map<std::string, fs::path> sheet_in;
    for (const BundleOwner& owner : owners) {
        const std::string& language = words.language.empty() ? owner.language : words.language;
        if (!sheet_in.contains(language)) sheet_in[language] = task_sheet(lesson, language, sheets.path());
        const fs::path file = folder / (lesson.slug + "-" + owner.name + ".zip");
        bundle_lesson(lesson, file, {owner.seed, language, sheet_in[language]});
        say(Message::verbatim(file.string()));
    }
    if (!complete)
        note(
            Message("new seeds were drawn for groups without a seed; use {} as the roster from now on", copy.string()));
    return kDone;
}

int bundle(const PackArguments& words) {
    const Lesson lesson = find_lesson(words.subject);
    if (!words.roster.empty()) return bundle_groups(lesson, words);
    const fs::path file = words.output.empty() ? fs::path(lesson.slug + ".zip") : fs::path(words.output);
    const TemporaryFolder sheets;
    const BundleOptions options{words.group_seed, words.language, task_sheet(lesson, words.language, sheets.path())};
    for (const std::string& name : bundle_lesson(lesson, file, options)) say(Message::verbatim(name));
    say(Message::verbatim(file.string()));
    return kDone;
}

}  // namespace

void add_pack(CLI::App& app, Action& action) {
    auto words = std::make_shared<PackArguments>();
    CLI::App* command = app.add_subcommand("pack", "Pack your folder into one file for submission");
    command
        ->add_option("DIR|FILE.lua", words->subject,
                     "Folder created by dynlab new, or a script, which becomes analysis.lua in the pack")
        ->required()
        ->check(CLI::Validator(
            [](std::string& given) {
                return std::filesystem::exists(given) ? std::string() : message_text(no_such_work(given), user());
            },
            ""));
    command
        ->add_option("-o,--output", words->output,
                     "Zip file to create. Default: DIR.zip or FILE.zip in the current folder.")
        ->type_name("FILE.zip");
    command->footer(
        "The data link and the figures that dynlab run saved (analysis_out) are left out. Equal folders give identical "
        "files, byte for byte.\nExample:  dynlab pack my-work");
    command->callback([words, &action] {
        expect_script(words->subject, "pack");
        action = [words] { return pack(*words); };
    });
}

void add_bundle(CLI::App& app, Action& action) {
    auto words = std::make_shared<PackArguments>();
    CLI::App* command = app.add_subcommand("bundle", "Create the students' zip file of a lesson, without solutions");
    command->add_option("LESSON", words->subject, "Number, name or folder of the lesson")->required();
    command
        ->add_option("-o,--output", words->output,
                     "Zip file to create or, with --roster, the folder. Default: NN_name.")
        ->type_name("FILE.zip|FOLDER");
    CLI::Option* seed = command
                            ->add_option("--group-seed", words->group_seed,
                                         "Seed of the group's own data: another unit of each plant, and other noise")
                            ->type_name("N")
                            ->check(CLI::Range(1u, 4294967295u));
    command
        ->add_option("--roster", words->roster,
                     "Create a zip file for each group, with data from the roster's column seed, in the language of "
                     "its column language")
        ->type_name("CSV")
        ->check(CLI::ExistingFile)
        ->excludes(seed);
    command
        ->add_option("--lang", words->language, "Language of tasks and report. Default: the lesson's, or the roster's")
        ->check(CLI::IsMember(languages()));
    command->footer(
        "A zip file contains the starter, the visible checks, the data, the task sheet and a file with the first "
        "steps.\nGroups without a seed get a random seed: FOLDER/roster.csv is the roster with all seeds, for dynlab "
        "grade.\nExamples:  dynlab bundle 04 -o lesson-4.zip     dynlab bundle 03_crane --roster roster.csv -o "
        "bundles");
    command->callback([words, &action] { action = [words] { return bundle(*words); }; });
}

}  // namespace dynlab::inline cli
