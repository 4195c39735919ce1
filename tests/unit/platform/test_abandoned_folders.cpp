#include "platform/locks/abandoned_folders.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

namespace dynlab {
namespace test_abandoned_folders {
namespace fs = std::filesystem;

// oracle: a process that is killed removes nothing, and one that lives is not disturbed
TEST(abandoned_folders, what_a_killed_process_left_is_removed_and_nothing_else) {
    const TemporaryFolder parent;
    const test::EnvironmentVariable tmpdir("TMPDIR", parent.path());
    const TemporaryFolder in_use;
    fs::create_directories(parent.path() / "dynlab-mine");
    fs::create_directories(parent.path() / "others-ABCDEF");
    const pid_t child = ::fork();
    if (child == 0) {
        const TemporaryFolder left;
        write_file_atomically(left.path() / "work", "x");
        ::_exit(0);  // no destructors, as when it is killed
    }
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    EXPECT_EQ(std::distance(fs::directory_iterator(parent.path()), {}), 4);
    EXPECT_EQ(remove_abandoned_folders().size(), 1u);
    EXPECT_TRUE(fs::exists(in_use.path()));
    EXPECT_TRUE(fs::exists(parent.path() / "dynlab-mine"));
    EXPECT_EQ(std::distance(fs::directory_iterator(parent.path()), {}), 3);
}

}  // namespace test_abandoned_folders
}  // namespace dynlab
