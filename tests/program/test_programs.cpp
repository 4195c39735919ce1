#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>

#include "support/program.h"

namespace dynlab {
namespace test_programs {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSubsetOf;
using ::testing::Not;

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(DYNLAB_PROGRAM).parent_path();

/// The commands that a program's help lists.
std::set<std::string> commands_of(const test::Workbench& work, const std::string& program) {
    std::istringstream help(work.shell((kFolder / program).string() + " --help").output);
    std::set<std::string> commands;
    bool listed = false;
    for (std::string line; std::getline(help, line);) {
        if (line.starts_with("Subcommands:")) listed = true;
        if (line.starts_with("First steps:")) break;
        if (listed && line.starts_with("  ") && !line.starts_with("   "))
            commands.insert(line.substr(2, line.find(' ', 2) - 2));
    }
    return commands;
}

/// dynlab with some of the programs beside it only.
void put(const test::Workbench& work, const std::vector<std::string>& programs) {
    fs::create_directories(work.path("bin"));
    for (const std::string& name : programs) fs::copy_file(kFolder / name, work.path("bin/" + name));
}

TEST(programs, that_of_pages_knows_the_commands_of_all) {
    const test::Workbench work;
    const std::set<std::string> all = commands_of(work, "dynlab-pages");
    EXPECT_EQ(commands_of(work, "dynlab"), all);  // whose help it is
    EXPECT_THAT(commands_of(work, "dynlab-course"), IsSubsetOf(all));
    EXPECT_GE(all.size(), 30u);
}

// oracle: what each does where the others are missing
TEST(programs, each_command_is_done_by_the_program_with_the_fewest_libraries_that_has_it) {
    const test::Workbench work;
    const std::set<std::string> of_course = commands_of(work, "dynlab-course");
    ASSERT_THAT(of_course, Not(IsEmpty()));
    put(work, {"dynlab", "dynlab-course"});
    for (const std::string& command : of_course)
        EXPECT_EQ(work.shell("bin/dynlab " + command + " --help").exit_code, 0) << command;
    for (const std::string command : {"run", "report", "hint", "lsp", "--version"})
        EXPECT_EQ(work.shell("bin/dynlab " + command + " --help").exit_code, 0) << command;
    fs::remove(work.path("bin/dynlab-course"));
    fs::create_directories(work.path("own/lessons"));
    for (const std::string command : {"run -e 'print(93)'", "lessons", "--course own lessons", "help tf"})
        EXPECT_EQ(work.shell("bin/dynlab " + command).exit_code, 0) << command;
    EXPECT_EQ(work.shell("echo 'print(93)' | bin/dynlab").output, "93\n");
    for (const std::string& command : of_course)
        EXPECT_EQ(work.shell("bin/dynlab " + command + " --help").exit_code, 3) << command;
}

TEST(programs, one_that_is_missing_is_told) {
    const test::Workbench work;
    put(work, {"dynlab"});
    for (const auto& [words, missing] : {std::pair{"grade --help", "dynlab-course"},
                                         {"--help", "dynlab-pages"},
                                         {"preview x", "dynlab-pages"},
                                         {"--view", "dynlab-pages"},
                                         {"nonsense", "dynlab-pages"}}) {
        const ChildResult told = work.shell(std::string("bin/dynlab ") + words);
        EXPECT_EQ(told.exit_code, 3) << words;
        EXPECT_THAT(
            told.error_output,
            HasSubstr(
                missing +
                std::string(
                    ", a part of dynlab, cannot be started (No such file or directory): install dynlab again\n")));
    }
}

TEST(programs, each_is_linked_with_what_its_commands_need) {
    const test::Workbench work;
    const auto libraries = [&](const std::string& program) {
        return work.shell("ldd " + (kFolder / program).string()).output;
    };
    EXPECT_THAT(libraries("dynlab"), HasSubstr("liblua"));
    for (const char* of_others : {"poppler", "qpdf", "sqlite", "httplib", "zmq"})
        EXPECT_THAT(libraries("dynlab"), Not(HasSubstr(of_others)));
    for (const char* of_pages : {"httplib", "zmq"}) {
        EXPECT_THAT(libraries("dynlab-course"), Not(HasSubstr(of_pages)));
        EXPECT_THAT(libraries("dynlab-pages"), HasSubstr(of_pages));
    }
}

}  // namespace test_programs
}  // namespace dynlab
