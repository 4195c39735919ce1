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

TEST(programs, dynlab_course_has_all_commands) {
    const test::Workbench work;
    const std::set<std::string> all = commands_of(work, "dynlab-course");
    EXPECT_EQ(commands_of(work, "dynlab"), all);  // whose help it is
    EXPECT_GE(all.size(), 30u);
}

// oracle: what the lesson program does alone
TEST(programs, lesson_program_alone_runs_lessons_and_reports_how_to_build_other_commands) {
    const test::Workbench work;
    put(work, {"dynlab"});
    fs::create_directories(work.path("own/lessons"));
    for (const std::string command : {"run -e 'print(93)'", "lessons", "--course own lessons", "help tf",
                                      "report --help", "hint --help", "lsp --help", "--version"})
        EXPECT_EQ(work.shell("bin/dynlab " + command).exit_code, 0) << command;
    EXPECT_EQ(work.shell("echo 'print(93)' | bin/dynlab").output, "93\n");
    work.write("checks.lua", "check { id = 'a' }\n");
    for (const std::string command : {"grade --help", "check --help", "course --help", "study --help", "preview x",
                                      "site x", "kernel --help", "--help", "--view", "nonsense", "lint checks.lua"}) {
        const ChildResult missing = work.shell("bin/dynlab " + command);
        EXPECT_EQ(missing.exit_code, 3) << command;
        EXPECT_EQ(missing.error_output,
                  "dynlab: cannot start " + work.path("bin/dynlab-course").string() +
                      " (No such file or directory), the program of this command. Reinstall dynlab.\n");
    }
    work.write("share/dynlab/source", std::string(DYNLAB_SOURCE_DIR) + "\n");
    const ChildResult missing = work.shell("bin/dynlab grade --help");
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_EQ(missing.error_output,
              "dynlab: this command is not built yet (dynlab-course is missing). Build it with:\n  " DYNLAB_SOURCE_DIR
              "/scripts/start\n");
}

// oracle: the loader's reason
TEST(programs, pdf_without_the_module_that_reads_it_is_refused_with_the_missing_file) {
    const test::Workbench work;
    put(work, {"dynlab", "dynlab-course"});
    work.write("report.pdf", "%PDF-1.5\n%%EOF\n");
    const std::string missing = "PDF files cannot be read: " + work.path("lib/dynlab/libdynlab_poppler.so").string();
    const std::string check = "DYNLAB_HOME=" DYNLAB_SOURCE_DIR " bin/dynlab check report.pdf";
    const ChildResult refused = work.shell(check);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.error_output, HasSubstr(missing + ": cannot open shared object file"));
    fs::create_directories(work.path("lib"));
    fs::copy(kFolder.parent_path() / "lib/dynlab", work.path("lib/dynlab"));
    const ChildResult read = work.shell(check);
    EXPECT_THAT(read.output, HasSubstr("The file is damaged: it contains no pages."));
}

TEST(programs, lesson_program_is_linked_without_course_pages_and_cluster) {
    const test::Workbench work;
    const auto libraries = [&](const std::string& program) {
        return work.shell("ldd " + (kFolder / program).string()).output;
    };
    const char* const of_other_commands[] = {"qpdf", "sqlite", "zmq"};
    EXPECT_THAT(libraries("dynlab"), HasSubstr("liblua"));
    for (const char* library : of_other_commands) {
        EXPECT_THAT(libraries("dynlab"), Not(HasSubstr(library)));
        EXPECT_THAT(libraries("dynlab-course"), HasSubstr(library));
    }
    EXPECT_THAT(libraries("dynlab"), Not(HasSubstr("poppler")));
    EXPECT_THAT(libraries("dynlab-course"), Not(HasSubstr("poppler")));  // loaded with the first PDF
    const std::string symbols = work.shell("nm -C " + (kFolder / "dynlab").string()).output;
    EXPECT_THAT(symbols, HasSubstr("dynlab::workflow::make_report"));
    for (const char* layer : {"dynlab::course::", "dynlab::app::", "Coordinator"})
        EXPECT_THAT(symbols, Not(HasSubstr(layer))) << layer;
}

}  // namespace test_programs
}  // namespace dynlab
