// The language of what commands print. Oracle: the header of the script, --lang and the environment, as POSIX reads it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command_line.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

namespace dynlab::test {
namespace test_language {
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kFrench = "-- ---\n-- title: T\n-- language: fr\n-- answers:\n--   x: number\n-- ---\n";

std::string script(const TemporaryFolder& folder, const char* name, const std::string& text) {
    write_file_atomically(folder.path() / name, text);
    return (folder.path() / name).string();
}

TEST(language, of_a_script_is_that_of_lint_and_its_errors) {
    const TemporaryFolder folder;
    const std::string french = script(folder, "french.lua", kFrench + std::string("prinnt(1)\n"));
    const std::string english = script(folder, "english.lua", "prinnt(1)\n");
    EXPECT_THAT(command_line({"lint", french}).output, HasSubstr("fonction ou variable inconnue\u202F: «"));
    EXPECT_THAT(command_line({"lint", english}).output, HasSubstr("unknown function or variable 'prinnt'"));
    const std::string broken = script(folder, "broken.lua", "-- ---\n-- titel: T\n-- language: fr\n-- ---\n");
    EXPECT_THAT(command_line({"run", broken}).error_output, HasSubstr("la clé «"));
    EXPECT_THAT(command_line({"lint", broken}).output, HasSubstr("broken.lua:2:1: en-tête du script"));
}

TEST(language, of_the_option_is_that_of_errors) {
    EXPECT_THAT(command_line({"hint", "03_crane", "99", "--lang", "fr"}).error_output,
                StartsWith("dynlab: la leçon 03_crane n'a pas d'indices pour la question 99"));
    EXPECT_THAT(command_line({"hint", "03_crane", "99"}).error_output, StartsWith("dynlab: lesson 03_crane has no"));
    EXPECT_THAT(command_line({"raport", "a"}).error_output, StartsWith("dynlab: unknown command 'raport'"));
}

TEST(language, of_the_environment_is_that_of_commands_without_another) {
    {
        const EnvironmentVariable french("LC_ALL", "fr_FR.UTF-8");
        EXPECT_THAT(command_line({"hint", "03_crane", "99"}).error_output, StartsWith("dynlab: la leçon 03_crane"));
    }
    const EnvironmentVariable plain("LC_ALL", "C.UTF-8");
    EXPECT_THAT(command_line({"hint", "03_crane", "99"}).error_output, StartsWith("dynlab: lesson 03_crane"));
}

}  // namespace test_language
}  // namespace dynlab::test
