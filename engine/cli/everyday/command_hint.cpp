#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "cli/commands.h"
#include "cli/options/script_options.h"
#include "cli/say.h"
#include "platform/error.h"
#include "platform/terminal/terminal_output.h"
#include "platform/terminal/terminal_text.h"
#include "scripting/runtime/help.h"
#include "scripting/runtime/help_layout.h"
#include "workflow/given_script.h"
#include "workflow/hints.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline cli {
namespace {

struct HintArguments {
    std::string lesson, language;
    int question = 0;
    bool next = false, all = false;
};

/// The named lesson, or the lesson of the copy in this folder, whose report also determines the language.
Lesson lesson_to_help(HintArguments& args) {
    const std::filesystem::path folder = args.lesson;
    if (!std::filesystem::is_regular_file(folder / "analysis.lua")) return find_lesson(args.lesson);
    if (args.language.empty()) args.language = language_of_work(folder);
    speak(args.language);
    const std::string name = read_percent_script(folder / "analysis.lua").header.lesson;
    if (name.empty())
        throw EnvironmentError("{} does not specify a lesson; add a line \"lesson: NAME\" to its header",
                               (folder / "analysis.lua").string());
    args.lesson = name;
    return find_lesson(name);
}

Hints hints_of(const Lesson& lesson, const std::string& language) {
    for (const std::string& requested : {language, std::string("en")})
        if (!requested.empty() && std::filesystem::is_regular_file(lesson.hints(requested)))
            return read_hints(lesson.hints(requested));
    throw EnvironmentError("lesson {} has no hints, because the file {} does not exist", lesson.slug,
                           lesson.hints("en").string());
}

int list_hints(const Lesson& lesson, const Hints& hints, const std::string& name) {
    say(Message("Lesson {}\n", lesson.slug));
    for (const auto& [question, stages] : hints)
        say(Message("question {}   hints: {}, seen: {}", fmt::format("{:>2}", question), stages.size(),
                    std::min(HintsSeen(lesson.slug, question).count(), stages.size())));
    say(Message("\nTo show the first hint for a question, run, for example:  dynlab hint {} {}", name,
                hints.begin()->first));
    return kDone;
}

void show_stages(const std::vector<std::string>& stages, std::size_t shown) {
    const std::size_t width = columns_of_text(kHelpWidth);
    for (std::size_t i = 0; i < shown; ++i) {
        say(Message("\nHint {} of {}", i + 1, stages.size()));
        std::cout << laid_out(stages[i], width);
    }
}

int give_hint(HintArguments args) {
    const std::string name = shell_word(args.lesson);
    const Lesson lesson = lesson_to_help(args);
    const Hints hints = hints_of(lesson, args.language);
    if (hints.empty()) throw EnvironmentError("lesson {} has a hint file without hints", lesson.slug);
    if (args.question == 0) return list_hints(lesson, hints, name);
    const auto found = hints.find(args.question);
    if (found == hints.end()) {
        std::vector<std::string> known;
        for (const auto& [question, texts] : hints) known.push_back(std::to_string(question));
        throw EnvironmentError("lesson {} has no hints for question {}. Questions with hints: {}", lesson.slug,
                               args.question, listed(known));
    }
    const std::vector<std::string>& stages = found->second;
    const HintsSeen seen(lesson.slug, args.question);
    if (args.next && !seen.lasting())
        throw EnvironmentError("--next is not available, because dynlab cannot store which hints were seen; use --all");
    const std::size_t before = std::min(seen.count(), stages.size());
    const std::size_t shown = args.all    ? stages.size()
                              : args.next ? std::min(before + 1, stages.size())
                                          : std::max<std::size_t>(before, 1);
    say(Message("Lesson {}, question {}", lesson.slug, args.question));
    show_stages(stages, shown);
    seen.save_entry(std::max(shown, before));
    if (const std::size_t left = stages.size() - shown; left > 0)
        say(Message("\nHints remaining: {}. To show the next hint, run:  dynlab hint {} {} --next", left, name,
                    args.question));
    else
        say(args.language.empty() || args.language == "en"
                ? Message("\nThis is the last hint. To create the reference solution, run:  dynlab report {}",
                          lesson.slug)
                : Message("\nThis is the last hint. To create the reference solution, run:  dynlab report {} --lang {}",
                          lesson.slug, args.language));
    return kDone;
}

}  // namespace

void add_hint(CLI::App& app, Action& action) {
    auto args = std::make_shared<HintArguments>();
    CLI::App* command = app.add_subcommand("hint", "Show hints for a question of a lesson, one at a time");
    command->add_option("LESSON", args->lesson, "Number or name of the lesson, or your folder")->required();
    command->add_option("QUESTION", args->question, "Number of the question. Default: list the questions with hints.")
        ->check(CLI::Range(1, 999));
    CLI::Option* next = command->add_flag("--next", args->next, "Show one hint beyond those already seen");
    command->add_flag("--all", args->all, "Show all hints for the question")->excludes(next);
    add_language(*command, args->language, "Language of the hints, if the lesson has hints in this language");
    command->footer("Examples:  dynlab hint 04 4     dynlab hint 04 4 --next     dynlab hint my-work");
    command->callback([args, &action] { action = [args] { return give_hint(*args); }; });
}

}  // namespace dynlab::inline cli
