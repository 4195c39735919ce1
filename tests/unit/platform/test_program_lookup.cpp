#include "platform/program_lookup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

namespace dynlab {
namespace test_program_lookup {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(program_lookup, finds_the_first_program_in_path_that_can_be_run) {
    const TemporaryFolder a, b;
    write_file_atomically(a.path() / "tool", "");
    write_file_atomically(b.path() / "tool", "");
    fs::create_directory(a.path() / "folder");
    fs::permissions(b.path() / "tool", fs::perms(0755));
    const test::EnvironmentVariable path("PATH", a.path().string() + ":" + b.path().string());
    EXPECT_EQ(find_program("tool"), b.path() / "tool");
    EXPECT_EQ(find_program((b.path() / "tool").string()), b.path() / "tool");
    EXPECT_FALSE(find_program((a.path() / "tool").string()));
    EXPECT_FALSE(find_program("folder"));
    EXPECT_FALSE(find_program("sh"));
}

TEST(program_lookup, installed_program_finds_the_share_of_its_prefix) {
    const TemporaryFolder prefix;
    fs::create_directories(prefix.path() / "share/dynlab/data");
    EXPECT_EQ(shared_folder_of(prefix.path() / "bin/dynlab"), prefix.path() / "share/dynlab");
}

TEST(program_lookup, built_program_finds_the_source_tree_above_it) {
    const TemporaryFolder tree;
    for (const char* name : {"data", "lessons", "report_templates", "build/bin"}) {
        fs::create_directories(tree.path() / name);
    }
    EXPECT_EQ(shared_folder_of(tree.path() / "build/bin/dynlab"), tree.path());
    fs::remove(tree.path() / "lessons");
    try {
        shared_folder_of(tree.path() / "build/bin/dynlab");
        FAIL();
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr((tree.path() / "build/share/dynlab").string()));
        EXPECT_THAT(error.what(), HasSubstr("DYNLAB_HOME"));
    }
}

TEST(program_lookup, dynlab_home_comes_first_and_must_be_right) {
    const TemporaryFolder home;
    const test::EnvironmentVariable variable("DYNLAB_HOME", home.path().string());
    EXPECT_THROW(shared_folder(), EnvironmentError);
    fs::create_directory(home.path() / "data");
    EXPECT_EQ(shared_folder(), home.path());
}

TEST(program_lookup, every_needed_program_has_a_package_and_a_purpose) {
    ASSERT_FALSE(needed_programs().empty());
    for (const NeededProgram& needed : needed_programs()) {
        EXPECT_FALSE(needed.program.empty() || needed.package.empty() || needed.purpose.empty());
    }
}

}  // namespace test_program_lookup
}  // namespace dynlab
