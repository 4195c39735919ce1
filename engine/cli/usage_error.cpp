#include "cli/usage_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <re2/re2.h>

#include <vector>

#include "base/message.h"
#include "base/reader.h"
#include "cli/say.h"
#include "platform/spelling.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

/// A sentence of the parser as a message of ours.
Message in_our_words(const std::string& theirs) {
    std::string option, value;
    if (RE2::FullMatch(theirs, RE2(R"(Could not convert: (\S+) = (.*))", RE2::Latin1), &option, &value))
        return Message("{} requires a number, but '{}' was given", option, value);
    if (RE2::PartialMatch(theirs, R"(^(\S+): At Most 1 required but received )", &option))
        return Message("{} was given more than once; give the option only once", option);
    if (RE2::PartialMatch(theirs, R"(^(\S+): 1 required )", &option)) return Message("{} requires a value", option);
    return Message::verbatim(theirs);
}

/// The command that the words reached: a command's own command where it has some.
const CLI::App* reached_command(const CLI::App* app) {
    while (!app->get_subcommands().empty()) app = app->get_subcommands().back();
    return app;
}

/// As it is typed: "dynlab course review".
std::string whole_name(const CLI::App* command) {
    if (command->get_parent() == nullptr) return "dynlab";
    return whole_name(command->get_parent()) + " " + command->get_name();
}

std::vector<std::string> command_names(const CLI::App* of) {
    std::vector<std::string> names;
    for (const CLI::App* command : of->get_subcommands([](const CLI::App*) { return true; }))
        if (!command->get_group().empty()) names.push_back(command->get_name());
    return names;
}

/// The long option names with their dashes, without options that the help does not show.
std::vector<std::string> option_names(const CLI::App* of) {
    std::vector<std::string> names;
    for (const CLI::Option* option : of->get_options())
        if (!option->get_group().empty())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

Message unknown_option(const std::string& command, const std::string& option, const std::vector<std::string>& names) {
    const auto near = nearest_word(option, names);
    return near ? Message("{} has no option '{}'; did you mean '{}'?", command, option, *near)
                : Message("{} has no option '{}'", command, option);
}

Message unknown_command(const CLI::App* command, const std::string& word, const std::vector<std::string>& names) {
    const auto near = nearest_word(word, names);
    if (command->get_parent() == nullptr)
        return near ? Message("unknown command '{}'; did you mean '{}'?", word, *near)
                    : Message("unknown command '{}'", word);
    return near ? Message("{} has no command '{}'; did you mean '{}'?", whole_name(command), word, *near)
                : Message("{} has no command '{}'", whole_name(command), word);
}

/// What is said of words that no command and no option takes, the first of them above all.
Message unknown_words(const CLI::App* command, const std::vector<std::string>& args, bool required) {
    const std::string option = args.front().substr(0, args.front().find('='));
    if (option.size() > 1 && option.starts_with('-'))
        return unknown_option(whole_name(command), option, option_names(command));
    const std::vector<std::string> names = command_names(command);
    if (args.front().ends_with(".lua") && command->get_parent() == nullptr)
        return Message("to run a script, use: dynlab run {}", shell_word(args.front()));
    if (!names.empty()) return unknown_command(command, args.front(), names);
    return required ? Message() : Message("too many arguments: {}", fmt::format("{}", fmt::join(args, " ")));
}

}  // namespace

std::string usage_message(const CLI::App* app, const CLI::Error& error) {
    // The parser gives unknown words backwards, and reports a missing argument before a misspelled word.
    const bool required = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    Message message;
    if (const std::vector<std::string> args = app->remaining(true);
        !args.empty() && (required || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr))
        message = unknown_words(reached_command(app), args, required);
    if (message.empty()) message = in_our_words(error.what());
    const Message help =
        Message("For more information, run {} {}.", whole_name(reached_command(app)), app->get_help_ptr()->get_name());
    return terminal_text(message_text(Message("dynlab: {}\n{}\n", message, help), user()));
}

}  // namespace dynlab::inline cli
