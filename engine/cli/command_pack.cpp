#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "course/grading/hand_in.h"
#include "numerics/number_text.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct PackArguments {
    std::string subject, output;
};

/// A report that was not made, or not made again after a change, is easily forgotten: people read the PDF.
void tell_of_report(const fs::path& folder, const std::string& subject) {
    if (!fs::exists(folder / "report.md")) return;
    std::optional<fs::file_time_type> made;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().extension() == ".pdf")
            made = std::max(made.value_or(entry.last_write_time()), entry.last_write_time());
    bool older = false;
    for (const char* source : {"report.md", "analysis.lua"})
        older = older || (made && fs::exists(folder / source) && fs::last_write_time(folder / source) > *made);
    if (!made || older)
        std::cerr << terminal_text(fmt::format(
            "dynlab: {}: dynlab report {} -o {}, then pack again\n",
            made ? "the PDF in it is older than the report's text or script" : "there is no PDF of the report in it",
            subject, (fs::path(subject) / "report.pdf").string()));
}

int pack(const PackArguments& words) {
    fs::path folder = fs::absolute(words.subject).lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    const fs::path file = words.output.empty() ? fs::path(folder.filename().string() + ".zip") : fs::path(words.output);
    const Pack pack = pack_folder(folder, file);
    for (const std::string& name : pack.files) std::cout << terminal_text(name) << '\n';
    for (const std::string& name : pack.left_out)
        std::cerr << "dynlab: left out, because it is not a regular file: " << terminal_text(name) << '\n';
    std::cout << fmt::format("{}: {}, SHA-256 {}\n", file.string(), counted(pack.files.size(), "file"), pack.hash);
    tell_of_report(folder, words.subject);
    return kDone;
}

int bundle(const PackArguments& words) {
    const Lesson lesson = find_lesson(words.subject);
    const fs::path file = words.output.empty() ? fs::path(lesson.slug + ".zip") : fs::path(words.output);
    for (const std::string& name : bundle_lesson(lesson, file)) std::cout << terminal_text(name) << '\n';
    std::cout << file.string() << '\n';
    return kDone;
}

}  // namespace

void add_pack(CLI::App& app, Action& action) {
    auto words = std::make_shared<PackArguments>();
    CLI::App* command = app.add_subcommand("pack", "Make one file of your folder, to hand in");
    command->add_option("DIR", words->subject, "The folder that dynlab new made")
        ->required()
        ->check(CLI::ExistingDirectory);
    command->add_option("-o,--output", words->output, "The zip to make; DIR.zip here unless given")
        ->type_name("FILE.zip");
    command->footer(
        "The data link is left out. Equal folders give equal files, byte by byte.\nExample:  dynlab pack my-work");
    command->callback([words, &action] { action = [words] { return pack(*words); }; });
}

void add_bundle(CLI::App& app, Action& action) {
    auto words = std::make_shared<PackArguments>();
    CLI::App* command = app.add_subcommand("bundle", "Make the students' zip of a lesson, without solutions");
    command->add_option("LESSON", words->subject, "The lesson's number or name")->required();
    command->add_option("-o,--output", words->output, "The zip to make; NN_name.zip here unless given")
        ->type_name("FILE.zip");
    command->footer("Example:  dynlab bundle 04 -o lesson-4.zip");
    command->callback([words, &action] { action = [words] { return bundle(*words); }; });
}

}  // namespace dynlab::inline cli
