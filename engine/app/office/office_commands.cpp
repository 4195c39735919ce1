#include "app/office/office_commands.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "base/reader.h"
#include "platform/child_process.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline app {
namespace {

using Words = std::vector<std::string>;
using Names = std::set<std::string, std::less<>>;

/// A command that the page may run, and its options; a "=" after the name marks an option with a value.
struct AllowedCommand {
    Words words;
    Names options;
    std::string needed = {};  ///< an option without which the command does something else
};

const std::vector<AllowedCommand>& allowed_commands() {
    static const std::vector<AllowedCommand> all = {
        {{"mark"}, {"--reason=", "--after="}},
        {{"withdraw"}, {"--mark=", "--after=", "--stage=", "--of=", "--part=", "--version=", "--reason="}},
        {{"restore"}, {"--stage=", "--of=", "--part=", "--version=", "--reason="}},
        {{"extend"}, {"--stage=", "--reason=", "--end"}},
        {{"set-received"}, {"--stage=", "--part=", "--of=", "--version=", "--reason="}},
        {{"withhold"}, {"--stage=", "--of=", "--reason=", "--end"}},
        {{"drop"}, {"--reason=", "--end"}},
        {{"remind"}, {"--only=", "--out="}},
        {{"submit"}, {"--kept", "--assignment=", "--from=", "--stage="}, "--kept"},
        {{"review", "assign"}, {}},
        {{"review", "send"}, {"--accept=", "--reason="}},
        {{"review", "release"}, {"--accept=", "--reason="}},
        {{"scores"}, {"--drop", "--reason="}, "--drop"},
        {{"export"}, {"--out=", "--worksheet=", "--column="}, "--out="},
    };
    return all;
}

const AllowedCommand* command_of(const Words& words) {
    for (const AllowedCommand& one : allowed_commands())
        if (words.size() > one.words.size() && words.front() == "course" &&
            std::equal(one.words.begin(), one.words.end(), words.begin() + 1))
            return &one;
    return nullptr;
}

/// "--reason=" of "--reason=illness".
std::string name_of_option(const std::string& word) {
    const std::size_t end = word.find('=');
    return end == word.npos ? word : word.substr(0, end + 1);
}

void refuse_foreign_file(const std::string& word) {
    static const Names files = {"--out=", "--worksheet="};
    const std::string name = name_of_option(word);
    if (!files.contains(name)) return;
    const std::filesystem::path file = word.substr(name.size());
    const std::string last = file.filename().string();
    if (file.parent_path() != kExchangeFolder || last.empty() || last.starts_with('.'))
        throw EnvironmentError("this page can read and write only files in {}, not \"{}\"", kExchangeFolder,
                               file.string());
}

}  // namespace

OfficeCommand office_command(const Words& words) {
    constexpr std::size_t kMaxWords = 20, kMaxBytes = 4000;
    const AllowedCommand* const allowed = command_of(words);
    if (words.size() > kMaxWords)
        throw EnvironmentError(
            "a command can have at most {} words on this page, but {} were given; run the command in a terminal",
            kMaxWords, words.size());
    if (allowed == nullptr) {
        const bool of_course = words.size() > 1 && words[0] == "course";
        throw EnvironmentError("the command \"{}\" is not available on this page; run the command in a terminal",
                               of_course       ? "course " + words[1]
                               : words.empty() ? std::string()
                                               : words[0]);
    }
    OfficeCommand command{{}, kProgram};
    Names given;
    for (const std::string& word : words) {
        if (word.size() > kMaxBytes || word.empty() || terminal_text(word) != word ||
            word.find_first_of("\n\t") != word.npos)
            throw EnvironmentError(
                "the command was not run: each value must have 1 to {} bytes, "
                "without line breaks or other control characters",
                kMaxBytes);
        if (word.starts_with('-')) {
            const std::string name = name_of_option(word);
            if (!allowed->options.contains(name))
                throw EnvironmentError(
                    "the option \"{}\" is not available on this page; to use the option, run the command in a terminal",
                    name);
            given.insert(name);
            refuse_foreign_file(word);
        }
        command.words.push_back(word);
        command.line += " " + shell_word(word);
    }
    if (!allowed->needed.empty() && !given.contains(allowed->needed))
        throw EnvironmentError("on this page, the command \"{}\" requires the option {}", "course " + words[1],
                               allowed->needed);
    return command;
}

OfficeResult run_office_command(const OfficeCommand& command, const std::filesystem::path& course,
                                const std::string& language) {
    ChildOptions child;
    child.command = command.words;
    child.command.insert(child.command.begin(), running_program().string());
    child.folder = course;
    child.environment = {{"LC_ALL", language + ".UTF-8"}};
    child.heeds_interrupt = false;  // what is begun must be whole
    const ChildResult result = run_child(child, "dynlab");
    return {command.line, result.exit_code, terminal_text(result.output + result.error_output)};
}

}  // namespace dynlab::inline app
