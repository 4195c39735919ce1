// What the Debian package holds beside programs and data. Oracles: --help, groff's own warnings, desktop-file-validate,
// and the texts that must agree with each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "platform/atomic_file.h"
#include "platform/program_lookup.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_package_files {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kPackaging = DYNLAB_SOURCE_DIR "/scripts/packaging/";

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::set<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) found.insert((*it)[1]);
    return found;
}

TEST(package_files, each_command_has_a_page_of_the_manual_with_all_its_options) {
    if (!find_program("groff")) GTEST_SKIP() << "groff is not installed";
    const Workbench bench;
    const ChildResult made = bench.shell(
        "$DYNLAB man-pages man && cd man && "
        "for p in *.1; do groff -man -Kutf8 -Tutf8 -rLL=500n -ww -P-cbou $p >${p%.1}.txt; done");
    ASSERT_EQ(made.exit_code, 0);
    EXPECT_THAT(made.error_output, IsEmpty()) << "groff's warnings";
    const std::string list = bench.dynlab({"--help"}).output;
    const std::set<std::string> commands = matches(list.substr(list.find("Subcommands:")), "\n  ([a-z-]+) +[A-Z]");
    ASSERT_GE(commands.size(), 20u);
    for (const std::string& command : commands) {
        const std::string page = bench.read("man/dynlab-" + command + ".txt");
        EXPECT_THAT(page, HasSubstr("dynlab-" + command + " - ")) << "what apropos(1) reads";
        EXPECT_THAT(bench.read("man/dynlab.txt"), HasSubstr("dynlab-" + command + "(1)"));
    }
    for (const char* command : {"run", "report", "grade", "identify"}) {  // those with most options
        const std::string help = bench.dynlab({command, "--help"}).output;
        const std::string page = bench.read(std::string("man/dynlab-") + command + ".txt");
        const std::set<std::string> options = matches(help, "(--[a-z-]+)");
        EXPECT_GE(options.size(), 4u);
        for (const std::string& option : options) EXPECT_THAT(page, HasSubstr(option)) << command;
    }
    const std::string course = bench.read("man/dynlab-course.txt");
    EXPECT_THAT(course, HasSubstr("dynlab course import"));
    EXPECT_THAT(course, HasSubstr("--grace"));
}

TEST(package_files, the_desktop_entry_is_valid) {
    if (!find_program("desktop-file-validate")) GTEST_SKIP() << "desktop-file-validate is not installed";
    const Workbench bench;
    EXPECT_EQ(bench.shell("desktop-file-validate " + kPackaging + "dynlab.desktop 2>&1").output, "");
    EXPECT_THAT(read_file(kPackaging + "dynlab.desktop"), HasSubstr("\nExec=dynlab app %f\n"));
}

TEST(package_files, version_licence_and_packages_are_those_of_the_project) {
    const Workbench bench;
    const std::string version = bench.dynlab({"--version"}).output;
    EXPECT_EQ(read_file(kPackaging + "changelog").find("dynlab (" + version.substr(7, version.size() - 8) + ")"), 0u);
    const std::string guide = read_file(DYNLAB_SOURCE_DIR "/engine/scripting/reference/guides/guide-package.md");
    EXPECT_THAT(matches(guide, "dynlab_([0-9.]+)_amd64[.]deb"), ElementsAre(version.substr(7, version.size() - 8)));
    // The recipe's option is the one that the package is tried with.
    const std::string option = "--path-include='/usr/share/doc/libslicot-doc/*'";
    EXPECT_THAT(guide, HasSubstr(option));
    EXPECT_THAT(read_file(DYNLAB_SOURCE_DIR "/tests/package/try_package"),
                HasSubstr(std::regex_replace(option, std::regex("'"), "")));
    // The file contains the license with an indent, and with a dot for an empty line.
    std::string licence = std::regex_replace(read_file(kPackaging + "copyright"), std::regex("\n ([.](?=\n))?"), "\n");
    const std::string terms = read_file(DYNLAB_SOURCE_DIR "/LICENSE");
    EXPECT_THAT(licence, HasSubstr(terms.substr(terms.find("Permission"))));
    const std::string run = read_file(DYNLAB_SOURCE_DIR "/scripts/packages.txt");
    const std::string cmake = read_file(kPackaging + "packaging.cmake");
    const std::set<std::string> recommended = matches(cmake, "set\\(recommended ([^)]+)\\)");
    ASSERT_EQ(recommended.size(), 1u);
    for (const std::string& name : matches(*recommended.begin(), "([a-z0-9-]+)"))
        EXPECT_THAT(run, HasSubstr(name)) << "it would be recommended and needed, too";
}

}  // namespace test_package_files
}  // namespace dynlab::test
