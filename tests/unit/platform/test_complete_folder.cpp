#include "platform/locks/complete_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_complete_folder {

namespace fs = std::filesystem;

// Oracle: the folder around it.
std::size_t entries_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(complete_folder, is_there_with_all_its_files_or_not_at_all) {
    const TemporaryFolder around;
    const fs::path folder = around.path() / "mine";
    const auto fill = [](const fs::path& growing) {
        for (const char* name : {"a", "b"}) std::ofstream(growing / name) << name;
    };
    EXPECT_THROW(make_complete_folder(folder,
                                      [&](const fs::path& growing) {
                                          fill(growing);
                                          throw EnvironmentError("the disk is full");
                                      }),
                 EnvironmentError);
    EXPECT_EQ(entries_in(around.path()), 0u);
    const pid_t killed = ::fork();
    if (killed == 0)
        make_complete_folder(folder, [](const fs::path& growing) {
            std::ofstream(growing / "a") << "a" << std::flush;
            ::raise(SIGKILL);
        });
    ::waitpid(killed, nullptr, 0);
    EXPECT_FALSE(fs::exists(folder));
    fs::create_directory(folder);  // an empty one may be there
    make_complete_folder(folder, fill);
    EXPECT_EQ(entries_in(around.path()), 1u);
    EXPECT_EQ(entries_in(folder), 2u);
    EXPECT_THROW(make_complete_folder(folder, fill), EnvironmentError);
    EXPECT_EQ(entries_in(folder), 2u);
}

// Oracle: the folder around it. Each call fills while the other does, as two commands at once would.
TEST(complete_folder, of_two_calls_at_once_is_the_work_of_the_first_to_end) {
    const TemporaryFolder around;
    const fs::path folder = around.path() / "mine";
    EXPECT_THROW(make_complete_folder(folder,
                                      [&](const fs::path& slow) {
                                          std::ofstream(slow / "a") << "slow" << std::flush;
                                          make_complete_folder(folder, [](const fs::path& quick) {
                                              for (const char* name : {"a", "b"})
                                                  std::ofstream(quick / name) << "quick";
                                          });
                                          std::ofstream(slow / "c") << "slow";
                                      }),
                 EnvironmentError);
    EXPECT_EQ(entries_in(around.path()), 1u);
    EXPECT_EQ(entries_in(folder), 2u);
    EXPECT_EQ(read_file(folder / "a"), "quick");
}

TEST(complete_folder, of_a_killed_call_leaves_nothing_behind_the_next_call_for_any_folder) {
    const TemporaryFolder around;
    const pid_t killed = ::fork();
    if (killed == 0)
        make_complete_folder(around.path() / "mine", [](const fs::path& growing) {
            std::ofstream(growing / "a") << "a" << std::flush;
            ::raise(SIGKILL);
        });
    ::waitpid(killed, nullptr, 0);
    make_complete_folder(around.path() / "other", [](const fs::path&) {});
    EXPECT_EQ(entries_in(around.path()), 1u);
    EXPECT_EQ(fs::status(around.path() / "other").permissions(), [&] {
        fs::create_directory(around.path() / "ordinary");
        return fs::status(around.path() / "ordinary").permissions();
    }());
}

}  // namespace test_complete_folder
}  // namespace dynlab
