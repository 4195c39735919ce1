// Wrong words of the command line. Oracle: the README's exit codes, and the names of commands and options.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command_line.h"

namespace dynlab::test {
namespace test_usage_message {
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

void expect_wrong_usage(const std::vector<std::string>& words, const std::string& message) {
    const CommandResult result = command_line(words);
    EXPECT_EQ(result.exit_code, kUsage) << testing::PrintToString(words);
    EXPECT_THAT(result.error_output, HasSubstr(message)) << testing::PrintToString(words);
    EXPECT_THAT(result.output, IsEmpty()) << testing::PrintToString(words);
}

TEST(usage_message, of_a_misspelt_command_or_option_suggests_the_nearest) {
    expect_wrong_usage(
        {"raport", "my-work"},
        "dynlab: unknown command 'raport'; did you mean 'report'?\nFor more information, run dynlab --help");
    expect_wrong_usage({"report", "02", "--outputt", "a.pdf"},
                       "dynlab: dynlab report has no option '--outputt'; did you mean '--output'?\n");
    expect_wrong_usage({"xyzzy", "a"}, "dynlab: unknown command 'xyzzy'\n");
    expect_wrong_usage({"report", "a", "b", "c"}, "dynlab: too many arguments: b c\n");
    expect_wrong_usage({"mine.lua"},
                       "dynlab: to run a script, use: dynlab run mine.lua\nFor more information, run dynlab --help");
}

TEST(usage_message, of_missing_and_excluding_words_is_an_error_of_usage) {
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"run"},
                                               {"report"},
                                               {"inspect"},
                                               {"lint"},
                                               {"run", "-e", "print(1)", "--seed", "many"},
                                               {"run", "-e", "print(1)", "--seed", "-1"},
                                               {"run", "a.lua", "--set", "k=much"},
                                               {"inspect", "a.csv", "--delimiter", "ab"},
                                               {"inspect", "a.csv", "-o", "a.gif"},
                                               {"demo", "--list", "delays"},
                                               {"demo", "--wrong"},
                                               {"help", "lsim", "--sheet", "cheat.pdf"},
                                               {"sheet", "05", "--answers"}})
        expect_wrong_usage(words, "dynlab: ");
}

TEST(usage_message, of_identify_names_the_option_and_the_wanted_word) {
    const auto wrong = [](const std::vector<std::string>& options, const std::string& message) {
        std::vector<std::string> words = {"identify", "d.csv", "--input", "u", "--output", "x"};
        words.insert(words.end(), options.begin(), options.end());
        expect_wrong_usage(words, message);
    };
    wrong({}, "--poles");
    wrong({"--poles", "two"}, "expected a whole number or the word auto, not 'two'");
    wrong({"--poles", "2", "--delay", "soon"}, "expected a number of seconds or the word auto, not 'soon'");
    wrong({"--poles", "2", "--zeros", "a"}, "dynlab: --zeros requires a number, but 'a' was given\n");
    wrong({"--poles", "2", "--zeros", "3"},
          "from 0 to the number of poles, 2, but it is 3");  // IdentifyRequest::validate
    wrong({"--poles", "2", "--time", "t", "--time", "u"},
          "dynlab: --time was given more than once; give the option only once\n");
    wrong({"--poles", "2", "--wrong", "1"}, "--wrong");
    wrong({"--poles", "2", "-o", "a.pdf", "--script"}, "--script");
    expect_wrong_usage({"identify", "d.csv", "extra", "--input", "u", "--output", "x", "--poles", "2"},
                       "dynlab: too many arguments: extra\n");
}

TEST(usage_message, every_command_has_a_help_that_starts_with_its_usage) {
    const CommandResult all = command_line({"--help"});
    EXPECT_EQ(all.exit_code, kDone);
    for (const char* command : {"run", "inspect", "identify", "report", "sheet", "hint", "weave", "new", "lessons",
                                "demo", "help", "notebook", "lint"}) {
        const CommandResult help = command_line({command, "--help"});
        EXPECT_EQ(help.exit_code, kDone) << command;
        EXPECT_THAT(help.output, HasSubstr(std::string("dynlab ") + command)) << command;
        EXPECT_THAT(help.error_output, IsEmpty()) << command;
        EXPECT_THAT(all.output, HasSubstr(std::string("\n  ") + command + " ")) << command;
    }
    EXPECT_THAT(command_line({"--version"}).output, testing::MatchesRegex("dynlab [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

}  // namespace test_usage_message
}  // namespace dynlab::test
