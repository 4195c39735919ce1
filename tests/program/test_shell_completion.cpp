// Completion in shells. Oracles: the folders of lessons and data, the commands that --help lists, and the shells
// themselves, which are given the scripts that the package installs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "platform/program_lookup.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_shell_completion {
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

namespace fs = std::filesystem;

const std::string kScripts = DYNLAB_SOURCE_DIR "/scripts/packaging/completions/";

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
}

/// Names of the folders of the project's `folder` that hold such a file.
std::vector<std::string> folders_with(const std::string& folder, const std::string& file) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / folder))
        if (fs::exists(entry.path() / file)) names.push_back(entry.path().filename());
    EXPECT_GE(names.size(), 5u);
    return names;
}

class shell_completion : public testing::Test {
  protected:
    /// The words that are offered for the last one.
    std::vector<std::string> offered(std::vector<std::string> words) const {
        words.insert(words.begin(), {"complete", "--"});
        const ChildResult answer = bench_.dynlab(words);
        EXPECT_EQ(answer.exit_code, 0) << answer.error_output;
        std::vector<std::string> names;
        for (const std::string& line : lines(answer.output)) names.push_back(line.substr(0, line.find('\t')));
        return names;
    }
    /// A shell with dynlab in its PATH.
    std::vector<std::string> shell(const std::string& command) const {
        const std::string path = "PATH=" + fs::path(DYNLAB_PROGRAM).parent_path().string() + ":$PATH; export PATH; ";
        const ChildResult answer = bench_.shell(path + command);
        EXPECT_THAT(answer.error_output, IsEmpty()) << command;
        return lines(answer.output);
    }
    Workbench bench_;
};

TEST_F(shell_completion, offers_every_command_and_no_hidden_one) {
    std::set<std::string> listed;
    bool below = false;
    for (const std::string& line : lines(bench_.dynlab({"--help"}).output)) {
        if (below && !line.starts_with("  ")) break;
        if (below && line[2] != ' ') listed.insert(line.substr(2, line.find(' ', 2) - 2));
        below = below || line == "Subcommands:";
    }
    const std::vector<std::string> words = offered({""});
    EXPECT_GE(words.size(), 20u);
    EXPECT_EQ(std::set<std::string>(words.begin(), words.end()), listed);
}

TEST_F(shell_completion, offers_names_of_lessons_data_functions_and_demonstrations) {
    EXPECT_THAT(offered({"report", ""}), IsSupersetOf(folders_with("lessons", "lesson.lua")));
    EXPECT_THAT(offered({"inspect", ""}), IsSupersetOf(folders_with("data", "SOURCE.md")));
    EXPECT_THAT(offered({"help", "srivc"}), IsSupersetOf({"srivc", "srivcstruc"}));
    EXPECT_THAT(offered({"help", "guide-"}), Contains("guide-report"));
    EXPECT_THAT(offered({"demo", "getting"}), ElementsAre("getting_started"));
}

TEST_F(shell_completion, knows_what_stands_where) {
    EXPECT_THAT(offered({"report", "02"}), ElementsAre("02_least_squares", ":files"));
    EXPECT_THAT(offered({"grade", "in", "--lesson", "04"}), ElementsAre("04_estimators"));
    EXPECT_THAT(offered({"report", "--lang", ""}), ElementsAre("en", "fr"));
    EXPECT_THAT(offered({"grade", "in", "--keep", "n"}), ElementsAre("newest"));
    EXPECT_THAT(offered({"report", "--ti"}), ElementsAre("--timings"));
    EXPECT_THAT(offered({"report", "--stay"}), IsEmpty()) << "a hidden option";
    EXPECT_THAT(offered({"course", "review", "rel"}), ElementsAre("release"));
    EXPECT_THAT(offered({"course", "status", "--cou"}), ElementsAre("--course")) << "of the command above";
    EXPECT_THAT(offered({"new", "02", "x", ""}), IsEmpty()) << "there is no third word";
    EXPECT_THAT(offered({"run", "-e", ""}), IsEmpty()) << "code";
    EXPECT_THAT(offered({"no-such-command", "-"}), Not(Contains(":files")));
}

TEST_F(shell_completion, bash_completes_names_and_files) {
    bench_.write("reports/a b.lua", "");
    const std::string script = "source " + kScripts + "dynlab.bash; ";
    const auto answer = [&](const std::string& words, int at) {
        return shell(script + "COMP_WORDS=(dynlab " + words + "); COMP_CWORD=" + std::to_string(at) +
                     "; _dynlab; printf '%s\\n' \"${COMPREPLY[@]}\"");
    };
    EXPECT_THAT(answer("rep", 1), ElementsAre("report"));
    EXPECT_THAT(answer("report 02", 2), ElementsAre("02_least_squares"));
    EXPECT_THAT(answer("report 'reports/a'", 2), ElementsAre("reports/a b.lua"));
}

TEST_F(shell_completion, zsh_gets_names_and_the_positions_of_files) {
    if (!find_program("zsh")) GTEST_SKIP() << "zsh is not installed";
    // Completion needs a terminal; the functions that show words are replaced by some that print them.
    const auto answer = [&](const std::string& words) {
        return shell("zsh -fc '_describe() { print -l -- $offered }; _files() { print files }; words=(dynlab " + words +
                     "); CURRENT=$#words; source " + kScripts + "dynlab.zsh; true'");
    };
    EXPECT_THAT(answer("lessons \"\""), ElementsAre(""));
    EXPECT_THAT(answer("rep"), ElementsAre(HasSubstr("report:")));
    EXPECT_THAT(answer("report 02"),
                ElementsAre(AllOf(HasSubstr("02_least_squares:"), HasSubstr("Straight")), "files"));
}

TEST_F(shell_completion, fish_completes_names_and_files) {
    if (!find_program("fish")) GTEST_SKIP() << "fish is not installed";
    bench_.write("02_mine.lua", "");
    const auto answer = shell("export HOME=$PWD; fish --no-config -c 'source " + kScripts +
                              "dynlab.fish; complete -C \"dynlab report 02\"'");
    EXPECT_THAT(answer, AllOf(Contains(HasSubstr("02_least_squares\t")), Contains(HasSubstr("02_mine.lua"))));
}

}  // namespace test_shell_completion
}  // namespace dynlab::test
